"""What rules oblige in one situation, and whether this is a conflict, by the evaluator."""

from __future__ import annotations

from typing import NamedTuple

from sleec_runtime.evaluation.conflicts import forbidding, has_conflict
from sleec_runtime.evaluation.due import broken_assumptions, due
from sleec_runtime.evaluation.formula_truth import Situation
from sleec_runtime.model import Context, Obligation, Ruleset


class Required(NamedTuple):
    """The literals that rules oblige in a situation, and whether those without a window conflict there."""

    literals: tuple[Obligation, ...]
    is_conflict: bool


def required_at_once(ruleset: Ruleset, context: Context) -> Required | None:
    """What the rules oblige in a context; None if the assumptions exclude it. O(size of the rules), plus the search of
    `has_conflict`."""
    if broken_assumptions(ruleset, context):
        return None
    literals = due(ruleset, context).literals
    at_once = [literal for literal in literals if literal.timing is None]
    conflict = has_conflict(at_once, forbidding(ruleset), Situation(context, ruleset.measures))
    return Required(literals, conflict)
