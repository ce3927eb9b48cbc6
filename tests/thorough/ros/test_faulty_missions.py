"""Random missions on random rules, with random faults: see `FaultyMission`."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime import language
from sleec_runtime.model import Ruleset
from sleec_runtime.ros.faults import Faults
from tests.support.faulty_mission import FaultyMission
from tests.support.paths import ROOT

RULESETS = [
    language.load(ROOT / "rulesets/care-robot.sleec"),
    language.parse("""
    READING priority
    MEASURE level: low < middle < high
    RULE one WHEN Ring AND NOT Silent THEN Open UNLESS level > low IN WHICH CASE NOT Open
    RULE two WHEN Ring THEN Look UNLESS Ring AND Night IN WHICH CASE (Wait UNLESS Alarm IN WHICH CASE Call)
    RULE three WHEN Dark THEN Shine UNLESS Night
    """),
]
PROBABILITIES = st.sampled_from([0.0, 0.1, 0.5, 0.9])


@pytest.mark.slow
@settings(max_examples=40)
@given(
    st.sampled_from(RULESETS),
    st.builds(Faults, PROBABILITIES, PROBABILITIES, PROBABILITIES, PROBABILITIES, st.sampled_from([0.1, 2.0, 10.0])),
    st.integers(0, 2**32),
)
def test_nothing_is_executed_that_no_true_context_justifies(ruleset: Ruleset, faults: Faults, seed: int) -> None:
    mission = FaultyMission(ruleset, faults, seed)
    mission.run(60)
