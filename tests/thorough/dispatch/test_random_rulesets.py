"""Random rulesets: evaluation, conflicts and dispatch against brute force."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sleec_runtime import Sleec
from sleec_runtime.errors import ConflictInContext, UndeterminedDecision
from sleec_runtime.evaluation.conflicts import conflict
from sleec_runtime.evaluation.due import due
from sleec_runtime.evaluation.hedge_chain import decide
from sleec_runtime.model import READINGS
from tests.support import brute_force as brute
from tests.support.robots import Log, listing_2
from tests.support.strategies import contexts, rulesets


@pytest.mark.slow
@given(st.data())
def test_decisions_and_conflicts_are_those_of_brute_force(data: st.DataObject) -> None:
    ruleset = data.draw(rulesets(always=True))
    context = data.draw(contexts(ruleset))
    for reading in READINGS:
        for rule in ruleset.rules:
            decision = decide(rule, context, reading, ruleset.measures)
            assert (None if decision is None else decision.clause) == brute.active(rule, ruleset, context, reading)
    assert frozenset(due(ruleset, context).literals) == brute.due(ruleset, context)
    assert (conflict(ruleset, context) is not None) == brute.conflicts(ruleset, context)


@pytest.mark.slow
@given(st.data())
def test_a_robot_executes_what_is_due_whatever_the_changes_before(data: st.DataObject) -> None:
    ruleset = data.draw(rulesets(labels=False, always=True))
    sleec = Sleec(ruleset)
    robot = listing_2(sleec)
    composed = Sleec(ruleset)
    twin = Log()
    composed.implement({name: lambda name=name: twin.do(name) for name in ruleset.obligations})
    assert not sleec.missing()
    assert not composed.missing()
    for _ in range(data.draw(st.integers(1, 4))):
        context = data.draw(contexts(ruleset))
        forgotten = dict.fromkeys(sleec.conditions)
        sleec.update({**forgotten, **context.conditions})
        composed.update({**forgotten, **context.conditions})
        if brute.conflicts(ruleset, context):
            with pytest.raises(ConflictInContext):
                sleec.trigger_all(context.triggers)
            assert robot.taken() == []
            continue
        done = sleec.trigger_all(context.triggers)
        clauses = brute.active_clauses(ruleset, context)
        expected = [o.name for _, _, clause in clauses for o in clause.obligations if not o.negated]
        assert robot.taken() == expected
        assert list(done.clauses) == [(label, number) for label, number, _ in clauses]
        assert set(done.obligations) == set(expected)
        composed.trigger_all(context.triggers)
        assert twin.taken() == expected
        assert done.explain()


@given(st.data())
def test_a_strict_answer_is_that_of_every_completion(data: st.DataObject) -> None:
    ruleset = data.draw(rulesets(constraints=False, measures=False, max_rules=2))
    context = data.draw(contexts(ruleset))
    strict = Sleec(ruleset, strict=True)
    strict.update(context.conditions)
    absent = sorted(ruleset.conditions - context.conditions.keys())
    try:
        answer = strict.due(*context.triggers)
    except (UndeterminedDecision, ConflictInContext):
        return
    for bits in range(2 ** len(absent)):
        completion = {name: bool(bits >> place & 1) for place, name in enumerate(absent)}
        strict.update(completion)
        assert strict.due(*context.triggers).literals == answer.literals
