"""What the strategies draw: contexts that the assumptions allow, values on both sides of every bound."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import find, given, settings
from hypothesis import strategies as st

from sleec_runtime import Sleec
from sleec_runtime.evaluation.due import broken_assumptions
from sleec_runtime.language import load
from sleec_runtime.model import Context
from sleec_verify.conformance import strategies
from sleec_verify.conformance.feasible_contexts import Assumptions
from sleec_verify.conformance.oracle import Oracle
from sleec_verify.conformance.regions import contexts, givens, number_values, size
from tests.support import brute_force as brute
from tests.support.small_rulesets import small_rulesets
from tests.support.strategies import contexts as any_contexts
from tests.support.strategies import rulesets

WARD = load("rulesets/hospital-ward.sleec")


@given(strategies.contexts(WARD))
@settings(max_examples=50)
def test_contexts_keep_the_assumptions(context: Context) -> None:
    assert not broken_assumptions(WARD, context)
    assert context.triggers


@pytest.mark.slow
@given(st.data())
def test_contexts_of_any_ruleset(data: st.DataObject) -> None:
    ruleset = data.draw(small_rulesets(measures=True))
    context = data.draw(strategies.contexts(ruleset))
    if any(True for _ in brute.contexts(ruleset)):
        assert not broken_assumptions(ruleset, context)


@pytest.mark.slow
@given(st.data())
def test_the_nearest_context_is_the_context_itself_where_that_is_possible(data: st.DataObject) -> None:
    ruleset = data.draw(small_rulesets(measures=True))
    context = data.draw(strategies.contexts(ruleset, unreported=False))
    if any(True for _ in brute.contexts(ruleset)) and not broken_assumptions(ruleset, context):
        assert Assumptions(ruleset).nearest(context) == context


@given(st.data())
def test_fixed_names_stay(data: st.DataObject) -> None:
    ruleset = data.draw(small_rulesets())
    facts = data.draw(st.fixed_dictionaries({name: st.booleans() for name in sorted(ruleset.conditions)}))
    context = Context(frozenset(), facts)
    found = Assumptions(ruleset).nearest(context, facts)
    possible = [c for c in brute.contexts(ruleset) if all(c.conditions[n] == v for n, v in facts.items())]
    assert (found is not None) == bool(possible)
    assert found is None or dict(found.conditions) == facts


@pytest.mark.slow
@given(st.data())
def test_the_oracle_is_right(data: st.DataObject) -> None:
    ruleset = data.draw(rulesets())
    context = data.draw(any_contexts(ruleset))
    expected = Oracle(ruleset).expected(context)
    active = brute.active_clauses(ruleset, context)
    assert [(one.rule, one.clause) for one in expected.active] == [(label, number) for label, number, _ in active]
    assert expected.conflict == brute.conflicts(ruleset, context)
    assert expected.possible == (not broken_assumptions(ruleset, context))
    if not expected.conflict:
        assert list(expected.due) == [o.name for _, _, clause in active for o in clause.obligations if not o.negated]


def test_values_lie_on_both_sides_of_every_bound() -> None:
    ages = strategies.values(load("rulesets/care-robot.sleec"), "UserAge")
    assert find(ages, lambda age: 17 < age < 18) == Fraction(179, 10)
    assert find(ages, lambda age: age == 18) == 18
    assert find(ages, lambda age: 18 < age < 19)


@given(strategies.histories(WARD))
@settings(max_examples=20)
def test_changes_are_what_an_instance_takes(history) -> None:
    sleec = Sleec(WARD)
    for changes in history:
        sleec.update(changes)


def test_regions() -> None:
    assert number_values("number", [18]) == [17, 18, 19]
    assert number_values("number", [1, 2]) == [0, 1, Fraction(3, 2), 2, 3]
    assert number_values("number", [Fraction(73, 2)]) == [36, Fraction(73, 2), 37]
    assert number_values("integer", [Fraction(73, 2)]) == [36, 37]
    assert number_values("integer", [1, 5]) == [0, 1, 2, 4, 5, 6]
    assert number_values("integer", []) == [-1, 0, 1]


@given(st.data())
@settings(max_examples=60)
def test_the_regions_reach_every_clause_that_any_value_reaches(data: st.DataObject) -> None:
    ruleset = data.draw(small_rulesets(measures=True, constraints=False, assumptions=False, rules=1, nested=False))
    (rule,) = ruleset.rules
    from sleec_runtime.model import formulas_of

    formulas = list(formulas_of(rule))
    given_ = givens(formulas, ruleset.measures)
    triggers = frozenset({rule.trigger})
    tried = list(contexts(given_, triggers))
    assert len(tried) == size(given_)
    reached = {brute.active(rule, ruleset, context) for context in tried}
    assert reached >= {brute.active(rule, ruleset, c) for c in brute.contexts(ruleset) if rule.trigger in c.triggers}
