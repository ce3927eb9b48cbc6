"""Which clauses decide in the responses to a situation, for rules whose conditions name acts.

The response decides whether the acts that such a rule names occur. Each set of them is a variant of the rule
(`sleec_verify.traces.act_conditions`), in which one clause decides, or none.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import NamedTuple

from sleec_runtime.model import Context, Reading
from sleec_runtime.model import Measure as Measured
from sleec_verify.encoding.equation import implications
from sleec_verify.encoding.formula_truth import truth_in
from sleec_verify.traces.act_conditions import Variant
from sleec_verify.traces.continuations import Continuations
from sleec_verify.traces.trace import TraceInstant


class Decisions(NamedTuple):
    """For each variant that some response has that complies with the other rules of a conflict: its number, and the
    number of the clause that decides, or None. `refused` are the acts of the variants that no such response has, and
    the clauses that would decide."""

    allowed: tuple[tuple[int, int | None], ...]
    refused: tuple[tuple[Mapping[str, bool], int | None], ...]

    @property
    def clause(self) -> int | None:
        """The clause that decides in all these responses; None if that is not one."""
        clauses = {clause for _, clause in self.allowed}
        return clauses.pop() if len(clauses) == 1 else None


def decisions(
    continuations: Continuations, others: Collection[str], label: str, variants: Sequence[Variant]
) -> Decisions:
    """The decisions of a rule in the responses that comply with `others`. Raises `Undecided`."""
    s = continuations.situations
    allowed: list[tuple[int, int | None]] = []
    refused: list[tuple[Mapping[str, bool], int | None]] = []
    for number, (variant, guards) in enumerate(zip(variants, s.variant_guards[label])):
        clause = next((clause for clause, guard in enumerate(guards) if s.holds(guard)), None)
        if continuations.complies(others, (), *acts_now(continuations, variant.acts)):
            allowed.append((number, clause))
        else:
            refused.append((variant.acts, clause))
    return Decisions(tuple(allowed), tuple(refused))


def acts_now(continuations: Continuations, acts: Mapping[str, bool]) -> Iterator[int]:
    """Literals that together say which of some acts occur now."""
    now = continuations.model.instants[continuations.now]
    return (now.event(act) if occurs else -now.event(act) for act, occurs in acts.items())


def clause_at(
    moment: TraceInstant, variants: Sequence[Variant], reading: Reading, measures: Mapping[str, Measured]
) -> int | None:
    """The clause of a rule that decides at an instant of a history; None if none does."""
    variant = next(v for v in variants if all((act in moment.events) == occurs for act, occurs in v.acts.items()))
    every = list(implications(variant.rule, reading))
    truths = truth_in(Context(moment.events, moment.conditions), [one.guard for one in every], measures)
    return next((one.number for one, truth in zip(every, truths) if truth), None)
