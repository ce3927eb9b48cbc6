"""A counterexample of an assertion is replayed: the evaluator must find that it violates the assertion."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from sleec_runtime.evaluation.formula_truth import holds
from sleec_runtime.evaluation.hedge_chain import decide
from sleec_runtime.model import Formula, Measure, Obligation, Ruleset
from sleec_verify.changes.assertions.assertion import Assertion
from sleec_verify.changes.compare import DecidingClause
from sleec_verify.encoding.solver import Undecided
from sleec_verify.results.finding import Witness
from sleec_verify.wording.sentence import sentence


def replay(
    ruleset: Ruleset, assertion: Assertion, witness: Witness, given: Iterable[Formula], measures: Mapping[str, Measure]
) -> tuple[DecidingClause, ...]:
    """The clauses that decide in the situation. Raises Undecided if the assertion is not violated there."""
    context = witness.context()
    found = []
    for rule in ruleset.rules:
        decision = decide(rule, context, ruleset.reading, ruleset.measures)
        if decision is not None:
            span = list(rule.clauses())[decision.clause].span
            found.append(DecidingClause(rule.label, decision.clause, decision.obligations, span))
    due = [any(is_of(o, literal) for one in found for o in one.obligations) for literal in assertion.literals]
    broken = all(due) if assertion.kind == "never" else not all(due)
    if not (broken and all(holds(formula, context, measures) for formula in (assertion.when, *given))):
        raise Undecided(sentence("the replay rejected a situation; this is a bug in sleec-verify"))
    return tuple(found)


def is_of(one: Obligation, literal: Obligation) -> bool:
    """Whether both are of one name, and both obligations or both prohibitions, whatever their times."""
    return one.name == literal.name and one.negated == literal.negated
