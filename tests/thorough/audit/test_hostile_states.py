"""A state of an audit with any other value in any place is refused, or it works."""

from __future__ import annotations

import json
from collections.abc import Iterator
from copy import deepcopy
from typing import Any

from sleec_runtime.audit.auditor import Auditor
from sleec_runtime.audit.observation import Entered, Executed, Observation, Occurred, Reported
from sleec_runtime.audit.state import restore, save
from sleec_runtime.errors import SnapshotRefused
from sleec_runtime.language import parse

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
HOSTILE: tuple[Any, ...] = (
    None, True, False, 0, 1, -1, 10**400, 1.5, 1e308, "", "x", "Ring", "home", "lox", "1/3", "1/0", "\ud800",
    [], ["Ring"], [[]], [[1, 2]], {}, {"Dark": 1}, {"x": 1},
)  # fmt: skip


def places(state: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The paths to all values of the state."""
    if path:
        yield path
    for key, value in state.items() if isinstance(state, dict) else enumerate(state) if isinstance(state, list) else ():
        yield from places(value, (*path, key))


def changed(state: Any, path: tuple[Any, ...], value: Any) -> Any:
    state = deepcopy(state)
    place = state
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = value
    return state


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
        for path in places(state):
            for value in HOSTILE:
                broken = changed(state, path, value)
                try:
                    restored = restore(RULES, broken)
                except SnapshotRefused:
                    refused += 1
                    continue
                accepted += 1
                json.dumps(save(restored))
                finish(restored)
    assert refused > 10_000
    assert accepted > 1_000
