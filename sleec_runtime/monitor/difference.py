"""Differences between what is due in a dispatch and what it executes."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeVar

from sleec_runtime.dispatch.recording import Recording
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.evaluation.due import Due
from sleec_runtime.evaluation.hedge_chain import Decision, decide
from sleec_runtime.model import Context, Obligation
from sleec_runtime.support.messages import listed

T = TypeVar("T")


@dataclass(frozen=True)
class Difference:
    """A dispatch that did not execute what was due.

    `due` and `executed` are in order, with a name once for each rule that obliges it. An implementation that raises
    counts as not executed; if it is prohibited, it counts as `prohibited`.
    """

    context: Context
    due: tuple[str, ...]
    executed: tuple[str, ...]
    missing: tuple[str, ...]
    unexpected: tuple[str, ...]
    prohibited: tuple[str, ...]

    def __str__(self) -> str:
        parts = [
            f"{what}: {listed(names)}"
            for what, names in (
                ("not executed", self.missing),
                ("executed but not due", self.unexpected),
                ("executed but prohibited", self.prohibited),
            )
            if names
        ]
        order = f"executed {listed(self.executed)} where {listed(self.due)} was due"
        return f"{' and '.join(sorted(self.context.triggers))}: {'; '.join(parts) or order}"


def difference(
    triggers: tuple[str, ...],
    snapshot: Snapshot,
    seen: Recording,
    chained: Collection[str] = (),
    fulfilled: Sequence[tuple[str, Obligation]] = (),
) -> Difference | None:
    """The difference between what is due for `triggers` and what was `seen`; None if there is none.

    `chained` are the responses that trigger rules when they are done. `fulfilled` are the obligations, with the labels
    of their rules, that another execution fulfils.
    """
    decisions = list(_decided(triggers, snapshot, fulfilled))
    happened = set(triggers)
    for decision in decisions:
        for literal in decision.obligations:
            if literal.name in chained and literal.name not in happened and not literal.negated:
                happened.add(literal.name)
                decisions += _decided((literal.name,), snapshot, fulfilled, triggers)
    due = Due(tuple(decisions))
    in_order = tuple(o.name for decision in due.decisions for o in decision.obligations if not o.negated)
    executed = _without(seen.executed, seen.failed)
    prohibited = tuple(name for name in dict.fromkeys(seen.executed) if name in due.prohibitions)
    if executed == in_order and not prohibited:
        return None
    return Difference(
        snapshot.context(triggers),
        in_order,
        executed,
        missing=tuple(name for name in dict.fromkeys(in_order) if name not in executed),
        unexpected=tuple(name for name in dict.fromkeys(executed) if name not in in_order and name not in prohibited),
        prohibited=prohibited,
    )


def _decided(
    triggers: tuple[str, ...],
    snapshot: Snapshot,
    fulfilled: Sequence[tuple[str, Obligation]],
    others: tuple[str, ...] = (),
) -> Iterator[Decision]:
    """The decisions of the rules of `triggers` if `others` occur too, in rule order, without what is due later or is
    `fulfilled`."""
    index = snapshot.index
    context = snapshot.context((*triggers, *others))
    rules = sorted(
        (rule for trigger in triggers for rule in index.by_trigger[index.number_of[trigger]]),
        key=lambda rule: index.order[rule.label],
    )
    for rule in rules:
        decision = decide(rule, context, index.ruleset.reading, index.measures)
        if decision is not None:
            at_once = tuple(o for o in decision.obligations if _counts_at_once(o, snapshot.conditions))
            own = [(rule.label, o) for o in at_once]
            yield replace(decision, obligations=tuple(o for _, o in _without(own, fulfilled)))


def _counts_at_once(obligation: Obligation, conditions: Mapping[str, Any]) -> bool:
    window = None if obligation.timing is None else obligation.timing.window
    return window is None or window.start is None or window.start.seconds_where(conditions) == 0


def _without(items: Iterable[T], others: Iterable[T]) -> tuple[T, ...]:
    """The multiset difference of `items` and `others`, in order."""
    rest = list(others)
    kept = []
    for item in items:
        if item in rest:
            rest.remove(item)
        else:
            kept.append(item)
    return tuple(kept)
