"""The questions that lead to the clause that decides: the flow of a rule, for pages and pictures."""

from __future__ import annotations

from typing import NamedTuple

from sleec_runtime.model import Clause, Formula, Reading, Rule


class Question(NamedTuple):
    """A condition, and the clause that decides if the condition is `deciding`; None: nothing is required."""

    condition: Formula
    deciding: bool
    response: Clause | None


def questions(rule: Rule, reading: Reading) -> tuple[list[Question], Clause]:
    """The conditions in the order in which they decide, and the clause that decides if no condition does."""
    asked, last = _chain(rule.default, rule.hedges, reading)
    return [*([] if rule.guard is None else [Question(rule.guard, False, None)]), *asked], last


def nested_questions(clause: Clause, reading: Reading) -> tuple[list[Question], Clause]:
    """The same for a clause with exceptions of its own, where it is the one of its chain that decides."""
    return _chain(clause, clause.hedges, reading)


def _chain(default: Clause, hedges: tuple[Clause, ...], reading: Reading) -> tuple[list[Question], Clause]:
    """The cascade ends at the first false condition. By priority, the last true condition decides."""
    chain = [default, *hedges]
    if reading == "cascade":
        return [Question(_condition(hedge), False, before) for before, hedge in zip(chain, hedges)], chain[-1]
    return [Question(_condition(hedge), True, hedge) for hedge in reversed(hedges)], default


def _condition(hedge: Clause) -> Formula:
    assert hedge.condition is not None, "every hedge has a condition"
    return hedge.condition
