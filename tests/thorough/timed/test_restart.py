"""What is pending goes on after a restart."""

from __future__ import annotations

from fractions import Fraction

import contextpy3 as cop
import pytest

from sleec_runtime import Sleec, VirtualClock, errors
from sleec_runtime.language import parse
from tests.support.restarts import RULES, SAVED_AT, SLOW, Robot, restarted

pytestmark = pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")


def test_what_is_under_way_stays_so_and_is_not_started_again() -> None:
    robot = Robot()
    robot.sleec.trigger("Fall", "bath", room=2)
    robot.clock.advance(10)
    other = restarted(robot)
    assert other.pending() == ["CallNurse (fall): under way, closes in 290 seconds"]
    other.clock.advance(289)
    assert other.log == []
    (done,) = other.sleec.completed("CallNurse")
    assert done.state == "done"
    other.clock.advance(1_000)
    assert other.log == []
    assert other.sleec.failures == ()


def test_otherwise_is_started_with_the_arguments_of_the_trigger() -> None:
    robot = Robot()
    robot.sleec.trigger("Fall", "bath", room=[2, None, {"floor": 1.5}])
    other = restarted(robot)
    other.clock.advance(300)
    assert other.log == [("CallAmbulance", "bath", ("room", [2, None, {"floor": 1.5}]))]
    assert other.sleec.failures == ()


def test_what_opens_later_is_started_then() -> None:
    robot = Robot()
    robot.sleec.trigger("Morning")
    robot.clock.advance(4)
    other = restarted(robot)
    other.clock.advance(5)
    assert other.log == []
    other.clock.advance(1)
    assert other.taken() == ["OfferWalk"]
    other = restarted(other)
    other.clock.advance(100)
    assert other.taken() == ["Open"]


def test_prohibitions_stay_in_force_and_come_into_force() -> None:
    robot = Robot()
    robot.sleec.trigger("Nap")
    robot.clock.advance(1)
    other = restarted(robot)
    assert other.pending() == ["NOT Vacuum (nap): in force, opens in 1 second, closes in 4 seconds"]
    other.sleec.trigger("Dust")
    other.clock.advance(2)
    other = restarted(other)
    with pytest.raises(errors.Prohibited, match="rule `nap` forbids it for 2 more seconds"):
        other.sleec.trigger("Dust")
    other.clock.advance(3)
    other.sleec.trigger("Dust")
    assert other.taken() == ["Vacuum"]


def test_a_prohibition_that_was_broken_has_its_otherwise_started() -> None:
    robot = Robot(slow=("Vacuum",))
    robot.sleec.trigger("Dust")
    robot.sleec.trigger("Nap")
    robot.clock.advance(3)
    robot.sleec.completed("Vacuum")
    other = restarted(robot, slow=("Vacuum",))
    other.clock.advance(2)
    assert other.taken() == ["Apologise"]
    assert restarted(other, slow=("Vacuum",)).taken() == [], "it is started once"


def test_what_raised_is_not_started_again() -> None:
    robot = Robot()
    robot.broken.add("Vacuum")
    with pytest.raises(OSError, match="Vacuum"):
        robot.sleec.trigger("Evening")
    other = restarted(robot)
    assert other.pending() == ["Vacuum (clean): waiting, closes in 3 seconds"]
    other.clock.advance(10)
    assert other.log == []
    assert other.failures() == ["Vacuum (clean): `Vacuum` was not done within 3 seconds of the trigger of rule `clean`"]


def test_what_is_held_back_is_started_when_it_is_not_forbidden() -> None:
    robot = Robot("RULE a WHEN A THEN X WITHIN 2 TO 9 seconds\nRULE b WHEN B THEN NOT X WITHIN 5 seconds")
    robot.sleec.trigger("A")
    robot.sleec.trigger("B")
    robot.clock.advance(3)
    assert robot.pending()[1] == "X (a): waiting, closes in 6 seconds"
    other = restarted(robot, text=robot.sleec.ruleset.source.text)
    other.clock.advance(2)
    assert other.log == []
    other.clock.advance(1)
    assert other.taken() == ["X"]


def test_what_is_due_in_place_of_another_goes_on() -> None:
    robot = Robot(slow=(*SLOW, "CallAmbulance", "Right"))
    robot.sleec.trigger("Fall")
    robot.clock.advance(330)
    robot.sleec.trigger("Choice")
    robot.clock.advance(5)
    other = restarted(robot, slow=(*SLOW, "CallAmbulance", "Right"))
    assert other.pending() == [
        "Right (either): under way, closes in 3 seconds",
        "CallAmbulance (fall): under way, closes in 25 seconds",
    ]
    other.clock.advance(100)
    assert other.taken() == ["CallPolice"]


def test_what_has_no_deadline_goes_on() -> None:
    robot = Robot(RULES + "RULE c WHEN C THEN CallNurse\n")
    robot.sleec.trigger_all(["Guest", "C"])
    other = restarted(robot, text=robot.sleec.ruleset.source.text)
    assert sorted(other.pending()) == [
        "CallNurse (c): under way, never closes",
        "Greet (some): under way, never closes",
    ]
    other.clock.advance(10_000)
    assert len(other.sleec.completed("CallNurse")) == len(other.sleec.completed("Greet")) == 1


def test_hedges_and_lengths_are_those_of_the_trigger() -> None:
    for age, expected in ((36.4, ["Apologise"]), (36.6, [])):
        robot = Robot()
        robot.sleec.update({"Awake": True, "Age": age, "Risk": "high", "wait": 7})
        robot.sleec.trigger("Ask")
        other = Robot(start=Fraction(1, 3))
        other.sleec.update({"Awake": False, "Age": 0, "wait": 99})
        other.sleec.restore(robot.saved(), SAVED_AT)
        assert other.pending() == ["Answer (ask): under way, closes in 7 seconds"]
        other.clock.advance(7)
        assert other.taken() == expected


def test_rules_with_methods_go_on_with_their_methods() -> None:
    def robot(start: int) -> tuple[Sleec, VirtualClock, list[str]]:
        clock = VirtualClock(start)
        log: list[str] = []
        sleec = Sleec(parse("RULE a WHEN A THEN X WITHIN 2 TO 5 seconds AND Y WITHIN 2 TO 9 seconds"), clock=clock)

        class Hand:
            @sleec.rule("a")
            @cop.base
            def both(self, what: str) -> None:
                log.append(what)

        sleec.bind(Hand())
        return sleec, clock, log

    sleec, _, _ = robot(0)
    sleec.trigger("A", "cup")
    other, clock, log = robot(50)
    other.restore(sleec.pending_snapshot(5), 6)
    clock.advance(1)
    assert log == ["cup"]
    assert other.pending() == ()


def test_a_response_that_is_an_event_triggers_after_a_restart() -> None:
    text = "RULE a WHEN A THEN X WITHIN 5 seconds\nRULE x WHEN X THEN Y WITHIN 3 seconds"
    robot = Robot(text, slow=("X",), chains=True)
    robot.sleec.trigger("A", 1)
    other = restarted(robot, text=text, slow=("X",), chains=True)
    other.sleec.completed("X")
    assert other.log == [("Y", 1)]
