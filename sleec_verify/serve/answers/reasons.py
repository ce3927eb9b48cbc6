"""Why a rule requires something, step by step: sentences for the page."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import Atom, Comparison, Context, Formula, Rule, Ruleset
from sleec_verify.entailment.answer import ActiveClause, ConditionValue
from sleec_verify.report.explanation import due_of, truth_text
from sleec_verify.wording.phrases import occurring, quoted
from sleec_verify.wording.plain_language import condition_words
from sleec_verify.wording.sentence import joined, sentence


def decided_steps(ruleset: Ruleset, context: Context, because: ActiveClause) -> Iterator[str]:
    """From the trigger over the conditions to what the clause requires."""
    yield occurring([ruleset.by_label[because.rule].trigger])
    for decision in because.decisions:
        yield _truth(ruleset, context, decision)
    yield sentence("so {due}", due=due_of(because))


def guarded_steps(ruleset: Ruleset, context: Context, rule: Rule, guard: Formula) -> Iterator[str]:
    """Why a rule whose guard is false requires nothing."""
    yield occurring([rule.trigger])
    yield _truth(ruleset, context, ConditionValue(guard, False, None, guard.span))
    yield sentence("so the rule does not apply")


def _truth(ruleset: Ruleset, context: Context, decision: ConditionValue) -> str:
    """```user age is below 16` is true, as `UserAge` is 2 (line 3)``"""
    formula = decision.formula
    if isinstance(formula, Atom):
        words = quoted(formula.name)
    else:
        # What combines conditions has quotation marks inside.
        before, after = "``" if isinstance(formula, Comparison) else "()"
        words = joined("", [before, condition_words(formula), after])
    return truth_text(ruleset, context, words, decision)
