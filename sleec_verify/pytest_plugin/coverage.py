"""Clause coverage: which clauses the tests made active, and which conditions they showed to decide.

It records every dispatch of every instance while it is on. Calls of layered methods without a trigger do not count.
"""

from __future__ import annotations

import os
import pickle
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

from sleec_runtime.dispatch.plan import Plan
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.evaluation.formula_truth import holds
from sleec_runtime.facade.dispatcher import Dispatcher
from sleec_runtime.model import Atom, Comparison, Rule, Ruleset
from sleec_verify.conformance.cases.goals import conditions_of
from sleec_verify.results.finding import ClauseRef

_paused = 0

Vector = tuple[bool, ...]


@contextmanager
def not_counted() -> Iterator[None]:
    """Dispatches in this block do not count, because they go through all contexts."""
    global _paused
    _paused += 1
    try:
        yield
    finally:
        _paused -= 1


class RuleCoverage:
    """The coverage of one ruleset."""

    def __init__(self, ruleset: Ruleset) -> None:
        self.ruleset = ruleset
        self.active: set[ClauseRef] = set()
        self.vectors: dict[str, dict[Vector, int | None]] = {}

    def add(self, other: RuleCoverage) -> None:
        """Add the coverage of the same ruleset from elsewhere."""
        self.active |= other.active
        for label, seen in other.vectors.items():
            self.vectors.setdefault(label, {}).update(seen)

    def undecided(self, rule: Rule) -> list[Atom | Comparison]:
        """The conditions of `rule` for which no two dispatches show that they decide alone: the two differ only in
        the condition, and in the active clause (MC/DC, with the rule as the decision)."""
        seen = self.vectors.get(rule.label, {})
        return [
            condition
            for place, condition in enumerate(conditions_of(rule))
            if not any(
                seen.get((*v[:place], not v[place], *v[place + 1 :]), outcome) != outcome for v, outcome in seen.items()
            )
        ]


class ClauseCoverage:
    """Records every dispatch from `start` to `stop`. `mcdc` also records the truth of each condition."""

    def __init__(self, mcdc: bool = False) -> None:
        self.mcdc = mcdc
        self._by_identity: dict[int, RuleCoverage] = {}
        # An identity is valid only while its object exists.
        self._alive: list[Ruleset] = []
        self._undo: list[Callable[[], None]] = []

    def start(self) -> None:
        original = Dispatcher.plan

        def noted(dispatcher: Dispatcher, snapshot: Snapshot, names: tuple[str, ...]) -> Plan:
            plan = original(dispatcher, snapshot, names)
            self.note(plan, snapshot)
            return plan

        self._replace(noted)
        self._undo.append(partial(self._replace, original))

    @staticmethod
    def _replace(plan: Callable[..., Plan]) -> None:
        Dispatcher.plan = plan  # type: ignore[method-assign]

    def stop(self) -> None:
        for undo in self._undo:
            undo()
        self._undo.clear()

    def about(self, ruleset: Ruleset) -> RuleCoverage:
        """The coverage of `ruleset`, or of an equal one from the same file."""
        known = self._by_identity.get(id(ruleset))
        if known is None:
            same = (c for c in self._by_identity.values() if _same(c.ruleset, ruleset))
            known = next(same, None) or RuleCoverage(ruleset)
            self._by_identity[id(ruleset)] = known
            self._alive.append(ruleset)
        return known

    def all(self) -> list[RuleCoverage]:
        """Every ruleset that was used, once, by its path."""
        return sorted({id(c): c for c in self._by_identity.values()}.values(), key=lambda c: c.ruleset.source.path)

    def packed(self) -> bytes:
        """Everything that was recorded, for `add` in another process of the same run."""
        return pickle.dumps(self.all())

    def add(self, packed: bytes) -> None:
        """Add the coverage of another process of this run."""
        for covered in pickle.loads(packed):
            self.about(covered.ruleset).add(covered)

    def note(self, plan: Plan, snapshot: Snapshot) -> None:
        if _paused:
            return
        index = snapshot.index
        covered = self.about(index.whole)
        covered.active.update(ClauseRef(*clause) for clause in plan.clauses)
        if self.mcdc:
            deciding = dict(plan.clauses)
            context = snapshot.context(plan.triggers)
            for trigger in plan.triggers:
                for rule in index.by_trigger[index.number_of[trigger]]:
                    vector = tuple(holds(leaf, context, index.measures) for leaf in conditions_of(rule))
                    covered.vectors.setdefault(rule.label, {})[vector] = deciding.get(rule.label)


def _same(one: Ruleset, other: Ruleset) -> bool:
    # A robot's path is relative to the working folder, and that of the command line to the root.
    paths = {os.path.realpath(ruleset.source.path) for ruleset in (one, other)}
    return len(paths) == 1 and one == other
