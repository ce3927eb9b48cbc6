"""On missions without time, the auditor finds what the solver derives from Equation 1."""

from __future__ import annotations

from collections import Counter

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.audit.observation import Executed, Observation, Occurred, Reported
from sleec_runtime.model import Context, Ruleset
from sleec_verify.entailment.definition1 import Definition1
from tests.support.missions import audit
from tests.support.small_rulesets import small_rulesets
from tests.support.strategies import contexts

APART = 10


@pytest.mark.slow
@settings(max_examples=80)
@given(data=st.data(), ruleset=small_rulesets(measures=True), tolerance=st.sampled_from((0, 1)))
def test_obligations_and_prohibitions_are_those_that_the_solver_entails(
    data: st.DataObject, ruleset: Ruleset, tolerance: int
) -> None:
    rules = Definition1(ruleset)
    mission: list[Observation] = []
    expected: Counter[tuple[int, str, str]] = Counter()
    contradictory = set()
    for number, context in enumerate(data.draw(st.lists(contexts(ruleset), max_size=4)), 1):
        at = number * APART
        # In the closed world of Definition 1, a condition that is not reported is false.
        closed = {**dict.fromkeys(sorted(ruleset.conditions), False), **context.conditions}
        if not ruleset.measures.keys() <= closed.keys():
            continue
        executed = data.draw(st.sets(st.sampled_from(sorted(ruleset.obligations)))) if ruleset.obligations else set()
        later = data.draw(st.integers(0, tolerance))
        mission.append(Reported(at, closed))
        mission += [Occurred(at, trigger) for trigger in sorted(context.triggers & ruleset.triggers)]
        mission += [Executed(at + later, name) for name in sorted(executed)]
        entailed = rules.entailed(Context(context.triggers, closed))
        if entailed is None:
            contradictory.add(at)
            continue
        for literal in entailed:
            if literal.negated == (literal.name in executed):
                expected[at, "prohibited" if literal.negated else "missed", literal.name] = 1
    found: set[tuple[int, str, str]] = set()
    for deviation in audit(Auditor(ruleset, tolerance=tolerance, chains=False), mission):
        assert deviation.kind != "undetermined"
        if deviation.triggered is not None and deviation.obligation is not None:
            found.add((int(deviation.triggered.time), deviation.kind, deviation.obligation.name))
    assert {one for one in found if one[0] not in contradictory} == set(expected)
    assert contradictory <= {at for at, _, _ in found}
