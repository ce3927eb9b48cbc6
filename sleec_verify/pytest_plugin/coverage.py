"""Clause coverage: which clauses the tests made active, which conditions they showed to decide, and which windows they
met and missed.

It records every dispatch of every instance while it is on, and the end of every window. Calls of layered methods
without a trigger do not count.
"""

from __future__ import annotations

import os
import pickle
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial, wraps
from typing import Any

from sleec_runtime.dispatch.plan import Plan
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.evaluation.formula_truth import holds
from sleec_runtime.facade.dispatcher import Dispatcher
from sleec_runtime.model import Atom, Comparison, Rule, Ruleset, obligation_text
from sleec_runtime.timed.admission import Admission
from sleec_runtime.timed.cascade import Stage
from sleec_runtime.timed.ledger import Ledger
from sleec_runtime.timed.task import State, Task
from sleec_verify.conformance.cases.goals import conditions_of
from sleec_verify.conformance.ruleset_replacement import CONTRADICTION
from sleec_verify.conformance.scenarios.windows import WindowRef
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
        self.windows: set[WindowRef] = set()
        self.vectors: dict[str, dict[Vector, int | None]] = {}

    def add(self, other: RuleCoverage) -> None:
        """Add the coverage of the same ruleset from elsewhere."""
        self.active |= other.active
        self.windows |= other.windows
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
        self._after(Dispatcher, "plan", self._note_plan)
        self._after(Admission, "admit", self._note_stages)
        self._after(Ledger, "end", self._note_end)

    def _after(self, owner: type, name: str, note: Callable[..., None]) -> None:
        """Calls `note` after each call of a method, with its result and its arguments."""
        original = getattr(owner, name)

        @wraps(original)
        def noted(*arguments: Any, **named: Any) -> Any:
            result = original(*arguments, **named)
            if not _paused:
                note(result, *arguments[1:])
            return result

        setattr(owner, name, noted)
        self._undo.append(partial(setattr, owner, name, original))

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

    def _note_plan(self, plan: Plan, snapshot: Snapshot, names: object) -> None:
        self._note(snapshot, plan.triggers, dict(plan.clauses))

    def _note_stages(self, admitted: None, stages: Sequence[Stage], *rest: object) -> None:
        """A dispatch of rules with time."""
        for stage in stages:
            if stage.triggers:
                clauses = {one.rule.label: one.clause for one in stage.decisions}
                self._note(stage.snapshot, stage.triggers, clauses)

    def _note(self, snapshot: Snapshot, triggers: Sequence[str], clauses: Mapping[str, int]) -> None:
        index = snapshot.index
        if index.whole.source.path == CONTRADICTION:
            return
        covered = self.about(index.whole)
        covered.active.update(ClauseRef(*clause) for clause in clauses.items())
        if self.mcdc:
            context = snapshot.context(tuple(triggers))
            for trigger in triggers:
                for rule in index.by_trigger[index.number_of[trigger]]:
                    vector = tuple(holds(leaf, context, index.measures) for leaf in conditions_of(rule))
                    covered.vectors.setdefault(rule.label, {})[vector] = clauses.get(rule.label)

    def _note_end(self, ended: None, task: Task, state: State) -> None:
        """The end of a window: it was met, or missed or broken, so that an alternative is due."""
        window = None if task.literal.timing is None else task.literal.timing.window
        whole = task.origin.snapshot.index.whole
        if window is None or state == "withdrawn" or whole.source.path == CONTRADICTION:
            return
        met = state == "done" or (state == "over" and not task.broken)
        clause = task.origin.rule.label, task.origin.decision.clause
        self.about(whole).windows.add(WindowRef(*clause, obligation_text(task.literal), missed=not met))


def _same(one: Ruleset, other: Ruleset) -> bool:
    # A robot's path is relative to the working folder, and that of the command line to the root.
    paths = {os.path.realpath(ruleset.source.path) for ruleset in (one, other)}
    # A file of cases may state another reading of the same text.
    return len(paths) == 1 and one == other.read_as(one.reading)
