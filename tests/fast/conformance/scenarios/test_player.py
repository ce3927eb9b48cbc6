"""The player: what happens when, in scenarios of robots of every kind."""

from __future__ import annotations

import asyncio

import pytest

from sleec_runtime import AsyncioClock, Sleec, obligation
from sleec_runtime.language import parse
from sleec_verify.conformance import Bench
from sleec_verify.conformance.scenarios.course import Course
from sleec_verify.conformance.scenarios.player import play
from sleec_verify.conformance.scenarios.scenario import Completion, Scenario, Step

RULES = parse("""
RULE fall WHEN UserFell THEN CallNurse WITHIN 5 minutes OTHERWISE CallAmbulance
RULE rest WHEN UserSleeps THEN NOT Vacuum WITHIN 1 hour
RULE dust WHEN DustSeen THEN Vacuum
RULE walk WHEN MorningComes THEN OfferWalk WITHIN 10 TO 60 minutes
""")


def make(clock, walk=lambda: None, asynchronous=False):
    sleec = Sleec(RULES, clock=AsyncioClock() if asynchronous else clock)
    sleec.implement({"CallNurse": obligation("CallNurse", completes=False)(lambda: None)})
    sleec.implement({"CallAmbulance": lambda: None, "Vacuum": lambda: None, "OfferWalk": walk})
    return sleec


async def slow_walk() -> None:
    await asyncio.sleep(90)


def told(course: Course) -> list[str]:
    return [f"{one.at}: {', '.join(one.names)} {one.kind}" for one in course.happenings]


def scenario(*steps: Step, end: int = 5000, completions: tuple[Completion, ...] = ()) -> Scenario:
    return Scenario("a scenario", steps, end, completions)


def test_a_completion_at_the_last_second_is_in_time_and_one_later_is_not() -> None:
    call = ["0: UserFell occurs", "0: CallNurse starts"]
    in_time = scenario(Step(0, ("UserFell",)), completions=(Completion("CallNurse", 0, 300),))
    assert told(play(Bench(make), in_time)) == [*call, "300: CallNurse done"]
    late = scenario(Step(0, ("UserFell",)), completions=(Completion("CallNurse", 0, 301),))
    ambulance = ["300: CallAmbulance starts", "300: CallAmbulance done"]
    assert told(play(Bench(make), late)) == [*call, *ambulance, "301: CallNurse done"]
    never = scenario(Step(0, ("UserFell",)), completions=(Completion("CallNurse", 0, None),))
    assert told(play(Bench(make), never)) == [*call, *ambulance]


def test_a_rejected_trigger_did_not_occur() -> None:
    course = play(Bench(make), scenario(Step(0, ("UserSleeps",)), Step(3600, ("DustSeen",)), Step(3601, ("DustSeen",))))
    assert told(course) == [
        "0: UserSleeps occurs",
        "3600: DustSeen rejected",
        "3601: DustSeen occurs",
        "3601: Vacuum starts",
        "3601: Vacuum done",
    ]
    assert [(instant.time, set(instant.events)) for instant in course.trace()] == [
        (0, {"UserSleeps"}),
        (3600, set()),
        (3601, {"DustSeen", "Vacuum"}),
        (5000, set()),
    ]


def test_a_callable_that_completes_at_its_return_is_made_to_fail() -> None:
    course = play(Bench(make), scenario(Step(0, ("MorningComes",)), completions=(Completion("OfferWalk", 0, None),)))
    assert told(course) == ["0: MorningComes occurs", "600: OfferWalk starts", "600: OfferWalk fails"]


@pytest.mark.parametrize("asynchronous", [False, True], ids=["the given clock", "AsyncioClock"])
def test_coroutines_wait_in_virtual_time(asynchronous: bool) -> None:
    bench = Bench(lambda clock: make(clock, slow_walk, asynchronous))
    course = play(bench, scenario(Step(0, ("MorningComes",)), Step(30, ("UserFell",))))
    assert told(course) == [
        "0: MorningComes occurs",
        "30: UserFell occurs",
        "30: CallNurse starts",
        "30: CallNurse done",
        "600: OfferWalk starts",
        "690: OfferWalk done",
    ]
