"""A state of an audit with any other value in any place is refused, or it works."""

from __future__ import annotations

import json

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.audit.observation import Entered, Executed, Observation, Occurred, Reported
from sleec_runtime.audit.state import restore, save
from sleec_runtime.errors import SnapshotRefused
from sleec_runtime.language import parse
from tests.support.hostile_json import HOSTILE, places, replaced

RULES = parse("""
MEASURE Age: integer
MEASURE Risk: low < high
CONDITION Dark
EXCLUSIVE Open, Close
NEVER Open AND Dark
RELATION Ring PRECEDES Close
RULE door WHEN Ring THEN Open UNLESS Risk > low IN WHICH CASE Close UNLESS Age < 6 IN WHICH CASE NOT Open
RULE fall WHEN Fall THEN Call WITHIN Age minutes OTHERWISE Shout WITHIN 3 seconds
DOMAIN home
RULE walk WHEN Fall THEN Close
""")
MISSION = (
    Reported(0, {"Dark": False, "Age": 36, "Risk": "low"}),
    Occurred(1, "Ring"),
    Executed(1, "Open"),
    Entered(2, "home"),
    Occurred(3, "Fall"),
    Executed(4, "Call"),
    Occurred(5, "Ring"),
    Occurred(5, "Fall"),
    Occurred(6, "nothing"),
)
AFTERWARDS: tuple[Observation, ...] = (
    Reported(7, {"Age": 3, "Dark": True}),
    Occurred(8, "Fall"),
    Executed(8, "Close"),
    Entered(9, None),
    Occurred(9, "Ring"),
    Executed(9, "Call"),
)


def finish(auditor: Auditor) -> None:
    for observation in AFTERWARDS:
        auditor.observe(observation)
    auditor.finish(10**6)


def test_every_place_of_a_state() -> None:
    auditor = Auditor(RULES, domain=None)
    refused = accepted = 0
    for observation in MISSION:
        auditor.observe(observation)
        state = json.loads(json.dumps(save(auditor)))
        for place in places(state):
            for new in HOSTILE:
                try:
                    restored = restore(RULES, json.loads(replaced(state, place, new)))
                except SnapshotRefused:
                    refused += 1
                    continue
                accepted += 1
                json.dumps(save(restored))
                finish(restored)
    assert refused > 10_000
    assert accepted > 1_000
