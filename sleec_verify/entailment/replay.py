"""Replay of situations that a person asked for by the evaluator of the runtime."""

from __future__ import annotations

from collections.abc import Iterable

from sleec_runtime.evaluation.formula_truth import holds
from sleec_runtime.evaluation.hedge_chain import decide
from sleec_runtime.model import Assume, Context, Ruleset


def applies(ruleset: Ruleset, context: Context, clauses: Iterable[tuple[str, int | None]]) -> bool:
    """Whether the assumptions allow a situation, and these clauses decide there; any clause of a rule for None."""
    for label, number in clauses:
        decision = decide(ruleset.by_label[label], context, ruleset.reading, ruleset.measures)
        if decision is None or number not in (None, decision.clause):
            return False
    assumed = (one for one in ruleset.constraints if isinstance(one, Assume))
    return all(holds(one.formula, context, ruleset.measures) for one in assumed)
