"""Restarts in the middle of a dispatch, and after a while."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from sleec_runtime import errors
from sleec_runtime.concurrency.critical_section import CriticalSection
from tests.support.restarts import SAVED_AT, SLOW, Robot, restarted

pytestmark = pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")


def test_what_was_not_begun_yet_is_started() -> None:
    robot = Robot(
        "RULE a WHEN A THEN X WITHIN 5 seconds\nRULE b WHEN A THEN Y WITHIN 5 seconds AND NOT Z WITHIN 9 seconds"
    )
    taken: list[Any] = []
    robot.sleec.implement({"X": lambda: taken.append(robot.saved())})
    robot.sleec.trigger("A")
    other = Robot(robot.sleec.ruleset.source.text)
    other.sleec.restore(taken[0], SAVED_AT)
    assert other.taken() == ["Y"]
    assert other.pending() == [
        "X (a): under way, closes in 5 seconds",
        "NOT Z (b): in force, closes in 9 seconds",
    ]
    other.clock.advance(5)
    assert other.failures() == ["X (a): `X` was not done within 5 seconds of the trigger of rule `a`"]


def test_what_follows_from_an_event_that_has_not_happened_is_not_due() -> None:
    text = "RULE a WHEN A THEN X WITHIN 5 seconds\nRULE x WHEN X THEN Y WITHIN 3 seconds AND NOT Z WITHIN 9 seconds"
    robot = Robot(text, chains=True)
    taken: list[Any] = []
    robot.sleec.implement({"X": lambda: taken.append(robot.saved())})
    robot.sleec.trigger("A")
    assert robot.pending() == ["NOT Z (x): in force, closes in 9 seconds"]
    other = Robot(text, chains=True)
    other.sleec.restore(taken[0], SAVED_AT)
    assert other.pending() == ["X (a): under way, closes in 5 seconds"]
    other.sleec.completed("X")
    assert other.taken() == ["Y"]


CHAINS = {
    "otherwise": "RULE a WHEN A THEN X WITHIN 2 seconds OTHERWISE Y WITHIN 2 seconds OTHERWISE Z",
    "else": "RULE a WHEN A THEN X WITHIN 2 seconds ELSE Y WITHIN 5 seconds ELSE Z WITHIN 9 seconds",
    "a window that opens later": "RULE a WHEN A THEN X WITHIN 2 seconds OTHERWISE Y WITHIN 2 TO 3 seconds",
    "a moment": "RULE a WHEN A THEN X WITHIN 2 seconds OTHERWISE Y WITHIN 3 TO 3 seconds",
}


@pytest.mark.parametrize("name", CHAINS)
def test_whenever_a_snapshot_can_be_taken_something_of_a_chain_is_pending_until_it_ends(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    robot = Robot(CHAINS[name], slow=("X", "Y") if name == "otherwise" else ("X",))
    robot.broken |= {"Y"} if name == "else" else set()
    robot.sleec.trigger("A")
    last = sorted(robot.sleec.ruleset.obligations)[-1]
    seen: list[tuple[str, ...]] = []

    run = CriticalSection.run
    depth = 0

    def run_and_look(section: CriticalSection, change: Callable[[], Any]) -> Any:
        """Takes a snapshot after each change, when another thread could."""
        nonlocal depth
        depth += 1
        try:
            return run(section, change)
        finally:
            if depth == 1:
                names = tuple(one["obligation"] for one in robot.saved()["pending"])
                seen.append(names)
                assert len(names) == (last not in [entry[0] for entry in robot.log] or last in names)
            depth -= 1

    monkeypatch.setattr(CriticalSection, "run", run_and_look)
    robot.clock.advance(60)
    assert {("X",), ("Y",), ()} <= set(seen)
    assert robot.taken()[-1] == last


def test_what_is_due_at_once_in_place_of_another_is_pending_until_it_is_done() -> None:
    text = "RULE a WHEN A THEN X WITHIN 2 seconds OTHERWISE Y"
    robot = Robot(text, slow=("X",))
    taken: list[Any] = []
    robot.sleec.implement({"Y": lambda: taken.append(robot.saved())})
    robot.sleec.trigger("A")
    robot.clock.advance(2)
    assert robot.pending() == []
    other = Robot(text)
    other.sleec.restore(taken[0], SAVED_AT + 5)
    assert other.pending() == ["Y (a): under way, never closes"]
    assert other.log == []


def test_a_deadline_that_has_passed_is_missed_and_its_otherwise_starts() -> None:
    robot = Robot(slow=(*SLOW, "CallAmbulance"))
    robot.sleec.trigger("Fall", "bath")
    other = restarted(robot, down=310, slow=(*SLOW, "CallAmbulance"))
    assert other.log == [("CallAmbulance", "bath")]
    assert other.failures() == [
        "CallNurse (fall): `CallNurse` was not done within 300 seconds of the trigger of rule `fall`"
    ]
    assert isinstance(other.sleec.failures[0].error, errors.DeadlineMissed)
    assert other.pending() == ["CallAmbulance (fall): under way, closes in 50 seconds"]
    other.clock.advance(50)
    assert other.taken() == ["CallAmbulance", "CallPolice"]


def test_the_deadline_of_otherwise_may_have_passed_as_well() -> None:
    robot = Robot()
    robot.sleec.trigger("Fall")
    other = restarted(robot, down=10_000)
    assert other.taken() == ["CallAmbulance", "CallPolice"]
    assert other.pending() == []


def test_a_window_that_has_opened_is_made_use_of_and_one_that_has_closed_is_not() -> None:
    robot = Robot()
    robot.sleec.trigger("Morning")
    assert restarted(robot, down=15).taken() == ["OfferWalk"]
    assert restarted(robot, down=60).taken() == ["OfferWalk", "Open"]
    other = restarted(robot, down=61)
    assert other.taken() == []
    assert other.failures() == [
        "OfferWalk (walk): `OfferWalk` was not done within 60 seconds of the trigger of rule `walk`",
        "Open (walk): `Open` was not done within 60 seconds of the trigger of rule `walk`",
    ]


@pytest.mark.parametrize("slow", [(), ("Wash",)])
def test_a_moment_that_has_passed_is_missed(slow: tuple[str, ...]) -> None:
    robot = Robot(slow=slow)
    robot.sleec.trigger("Noon")
    assert restarted(robot, down=2, slow=slow).taken() == ["Wash"]
    other = restarted(robot, down=3, slow=slow)
    assert other.taken() == ["Apologise"]
    assert other.pending() == []
    assert other.failures() == ["Wash (wash): `Wash` was not done within 2 seconds of the trigger of rule `wash`"]


def test_a_prohibition_that_is_over_is_over() -> None:
    robot = Robot()
    robot.sleec.trigger("Sleep")
    other = restarted(robot, down=3_601)
    assert other.pending() == []
    other.sleec.trigger("Dust")
    assert other.taken() == ["Vacuum"]


def test_else_is_made_use_of_while_its_window_is_open() -> None:
    robot = Robot()
    robot.sleec.trigger("Choice")
    assert restarted(robot, down=6).taken() == ["Right"]
    other = restarted(robot, down=9)
    assert other.taken() == []
    assert other.failures() == ["Left (either): `Left` was not done within 4 seconds of the trigger of rule `either`"]
