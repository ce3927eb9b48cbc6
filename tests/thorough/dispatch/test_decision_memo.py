"""Kept decisions are those of the interpreter, whatever was reported before."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.dispatch.rule_index import RuleIndex
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.evaluation.hedge_chain import decide
from sleec_runtime.model import Ruleset, Value
from tests.support.small_rulesets import MEASURES, small_rulesets

VALUES: dict[str, st.SearchStrategy[Value | None]] = {
    **dict.fromkeys(("c1", "c2", "c3"), st.sampled_from((True, False, None))),
    "x": st.one_of(st.none(), st.integers(-2, 3), st.fractions(-2, 3, max_denominator=4)),
    "y": st.one_of(st.none(), st.integers(-2, 3)),
    "s": st.sampled_from((None, *MEASURES[2].values)),
}


@settings(deadline=None)
@given(small_rulesets(measures=True, constraints=False, assumptions=False), st.data())
def test_a_kept_decision_is_that_of_the_interpreter(ruleset: Ruleset, data: st.DataObject) -> None:
    snapshot = Snapshot.first(RuleIndex(ruleset), {})
    names = sorted(snapshot.index.vocabulary)
    for _ in range(6):
        chosen = data.draw(st.lists(st.sampled_from(names), max_size=3, unique=True)) if names else []
        snapshot, _ = snapshot.changed({name: data.draw(VALUES[name]) for name in chosen})
        for rule in ruleset.rules:
            context = snapshot.context((rule.trigger,))
            assert snapshot.outcome(rule) == decide(rule, context, ruleset.reading, ruleset.measures)


@pytest.mark.slow
@settings(deadline=None)
@given(small_rulesets(measures=True, constraints=False, assumptions=False), st.data())
def test_equal_contexts_share_their_outcomes(ruleset: Ruleset, data: st.DataObject) -> None:
    """Also after other changes in between: a plan is made once for the same decisions."""
    first = Snapshot.first(RuleIndex(ruleset), {})
    conditions = sorted(set(first.index.vocabulary) & set(ruleset.conditions))
    if not conditions:
        return
    name = data.draw(st.sampled_from(conditions))
    there, _ = first.changed({name: True})
    back, _ = there.changed({name: False})
    again, _ = back.changed({name: True})
    for number in range(len(first.index.by_trigger)):
        assert again.of_trigger(number) is there.of_trigger(number)
