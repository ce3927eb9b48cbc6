"""The result of a dispatch."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

from sleec_runtime.dispatch.decisions import outcomes_of
from sleec_runtime.dispatch.plan import ActiveClause, Plan
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.evaluation.hedge_chain import Decision, Undetermined
from sleec_runtime.model import Context

if TYPE_CHECKING:
    from sleec_runtime.timed.pending import Pending


class Done:
    """What a dispatch did, and why. It keeps the context of the decision."""

    __slots__ = ("_pending", "_plan", "_results", "_snapshot")

    def __init__(
        self,
        plan: Plan,
        snapshot: Snapshot,
        results: Sequence[object],
        pending: Callable[[], tuple[Pending, ...]] | None = None,
    ) -> None:
        self._plan = plan
        self._snapshot = snapshot
        self._results = results
        self._pending = pending

    @property
    def triggers(self) -> tuple[str, ...]:
        return self._plan.triggers

    @property
    def obligations(self) -> tuple[str, ...]:
        """The obligations, which are done unless they are in `due`: each name once, in the order of rules and
        clauses."""
        return self._plan.obligations

    @property
    def prohibitions(self) -> tuple[str, ...]:
        """The prohibitions: each name once."""
        return self._plan.prohibitions

    @property
    def clauses(self) -> tuple[ActiveClause, ...]:
        """The active clause of each rule that applies, in rule order."""
        return self._plan.clauses

    @property
    def decisions(self) -> tuple[Decision, ...]:
        """The active clauses, with the conditions that decided them."""
        return self._plan.decisions

    @property
    def results(self) -> Mapping[str, object]:
        """The results of the variants, by rule label. A clause without code has no entry."""
        return {variant.label: result for variant, result in zip(self._plan.variants, self._results)}

    @property
    def context(self) -> Context:
        """The context χ of the decision."""
        return self._snapshot.context(self._plan.triggers)

    @property
    def change(self) -> int:
        """The number of the change that made this context."""
        return self._snapshot.number

    @property
    def due(self) -> tuple[Pending, ...]:
        """The obligations of the dispatch that are still to be done, and its prohibitions that are still in force.

        It shrinks over time.
        """
        return () if self._pending is None else self._pending()

    def explain(self) -> str:
        """For each rule of the triggers, the active clause, its obligations, and the conditions that decided it, as
        text."""
        from sleec_runtime.evaluation.explanation import outcome_in_words

        index = self._snapshot.index
        lines = [f"{' and '.join(self.triggers)}, in the context of change {self.change}:"]
        for rule, outcome in outcomes_of(self._snapshot, self.triggers):
            assert not isinstance(outcome, Undetermined), "refused before anything ran"
            lines.append(outcome_in_words(rule, outcome, self.context))
        if len(lines) == 1:
            where = "" if index.domain is None else f" in the domain {index.domain}"
            lines.append(f"no rule has this trigger{where}")
        return "\n".join([*lines, *map(str, self.due)])

    def __repr__(self) -> str:
        return f"Done(triggers={self.triggers}, obligations={self.obligations}, clauses={self.clauses})"
