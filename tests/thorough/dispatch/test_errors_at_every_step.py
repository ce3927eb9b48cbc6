"""An error at every step of a dispatch."""

from __future__ import annotations

import inspect
import sys
from collections import deque
from collections.abc import Callable
from functools import partial
from types import FrameType

import pytest

from sleec_runtime import Sleec, VirtualClock, errors, obligation
from sleec_runtime.concurrency.critical_section import CriticalSection
from sleec_runtime.language import parse
from sleec_runtime.timed.clock import CheckedClock
from sleec_runtime.timed.ledger import Action, Ledger
from tests.support.reentrancy import ACTS, RUNTIME, Robot, Ticking, lines, prepared


def raises_at(number: int, act: Callable[[], object]) -> bool:
    """Does `act`, and raises an error where it calls something for the `number`-th time: when a function is entered,
    or when one written in C returns. There, and where a loop goes back, is where Python runs signal handlers. False if
    it does not call so often."""
    count = 0

    def profile(frame: FrameType, event: str, argument: object) -> None:
        nonlocal count
        # Not where a generator is closed, in which nothing can be raised.
        closes = frame.f_lasti >= 0 and event == "call" and frame.f_code.co_flags & inspect.CO_GENERATOR
        if event in ("call", "c_return") and not closes and frame.f_code.co_filename.startswith(RUNTIME):
            count += 1
            if count == number:
                sys.setprofile(None)
                raise Raised

    sys.setprofile(profile)
    try:
        act()
    except Raised:
        pass
    finally:
        sys.setprofile(None)
    return count >= number


class Raised(Exception):
    """What a handler raises, such as a time limit."""


def test_an_error_between_any_two_steps_of_a_trigger_leaves_all_of_it_or_nothing():
    before = prepared()
    asked = before.asked()
    before.sleec.trigger_all(["T1", "T2", "T3"])
    whole = before.asked()
    for number in lines():
        robot = prepared()
        if not raises_at(number, lambda: robot.sleec.trigger_all(["T1", "T2", "T3"])):  # noqa: B023
            break
        # Whether B of this trigger has been begun depends on where the error came.
        assert begun(robot.asked()) in (begun(asked), begun(whole)), number
        robot.clock.time = 3
        robot.sleec.tick()
        # A and C of before are served, and the trigger works.
        assert {"A", "C"} <= set(robot.log)
        robot.sleec.trigger_all(["T1", "T2", "T3"])
        robot.clock.time = 50
        robot.sleec.tick()
        assert robot.asked() == []
    assert number > 100


def begun(asked: list[str]) -> list[str]:
    return sorted(one.replace("waiting", "under way") for one in asked)


def test_an_error_between_any_two_steps_of_a_tick_loses_no_obligation():
    for number in lines():
        robot = prepared()
        if not raises_at(number, robot.sleec.tick):
            break
        robot.sleec.tick()
        # Begun, or reported.
        assert "A" in robot.log + robot.told, number
        assert "C" in robot.log + robot.told, number
        robot.sleec.trigger("T3")
        robot.clock.time = 3
        robot.sleec.tick()
        assert "D" in robot.log
    assert number > 100


class Waking(Ticking):
    """A clock that calls when the test says so."""

    def __init__(self) -> None:
        super().__init__()
        self.alarms: dict[object, tuple[int, Callable[[], object]]] = {}

    def wake(self, at, call):
        key = object()
        self.alarms[key] = at, call
        return lambda: self.alarms.pop(key, None)

    def call(self) -> None:
        """Makes the calls that are due."""
        while due := [key for key, (at, _) in self.alarms.items() if at <= self.time]:
            self.alarms.pop(due[0])[1]()


def test_an_error_between_any_two_steps_of_a_tick_leaves_the_rest_to_the_clock():
    """The clock is to wake again for what is not done, at the latest after the next call."""
    for number in lines():
        clock = Waking()
        robot = prepared(clock=clock)
        ((_, tick),) = clock.alarms.values()
        clock.alarms.clear()
        if not raises_at(number, tick):
            break
        robot.sleec.pending()
        clock.call()
        assert {"A", "C"} <= {*robot.log, *robot.told}, number
    assert number > 100


def test_what_is_decided_and_not_done_is_done_when_the_clock_wakes_next():
    left = 0
    for number in lines():
        clock = Waking()
        robot = Robot(clock=clock)
        robot.sleec.trigger("T1")
        clock.time = 2
        if not raises_at(number, robot.sleec.tick):
            break
        if "A" not in robot.log + robot.told:
            left += 1
            clock.call()
            assert "A" in robot.log + robot.told, number
    assert left > 1


def test_a_clock_that_cannot_wake_leaves_all_as_it_was_and_reports_once():
    clock = Waking()
    told: list[str] = []
    rules = parse("RULE a WHEN T1 THEN B WITHIN 2 seconds\nRULE b WHEN T1 THEN C WITHIN 9 seconds")
    sleec = Sleec(rules, clock=clock, on_error=lambda failure: told.append(failure.rule))
    sleec.implement({name: obligation(name, completes=False)(lambda: None) for name in "BC"})
    wake = clock.wake

    def broken(at: object, call: object) -> object:
        clock.wake = wake  # type: ignore[method-assign]
        raise OSError("no timer")

    clock.wake = broken  # type: ignore[method-assign]
    with pytest.raises(OSError, match="no timer"):
        sleec.trigger("T1")
    assert sleec.pending() == ()
    sleec.trigger("T1")
    clock.time = 3
    clock.wake = broken  # type: ignore[method-assign]
    with pytest.raises(OSError, match="no timer"):
        sleec.tick()
    assert (sleec.failures, told) == ((), [])
    assert [one.obligation for one in sleec.pending()] == ["B", "C"]
    sleec.tick()
    assert told == [failure.rule for failure in sleec.failures] == ["a"]


class Calling(Ticking):
    """A clock that calls the instance back the `at`-th time that it is asked, which clocks must not."""

    def __init__(self) -> None:
        super().__init__()
        self.call: Callable[[], object] = print
        self.at = 0

    def now(self) -> int:
        self.at -= 1
        if self.at == 0:
            self.call()
        return super().now()


@pytest.mark.parametrize("at", [1, 2, 3])
def test_a_refused_call_within_a_decision_of_the_clock_gives_up_no_obligation(at):
    clock = Calling()
    robot = Robot(clock=clock)
    robot.sleec.trigger("T1")
    clock.time = 2
    clock.call = robot.sleec.pending
    clock.at = at
    with pytest.raises(errors.Reentrant):
        robot.sleec.tick()
    assert robot.log == []
    robot.sleec.tick()
    assert robot.log == ["A"]
    assert robot.told == []


@pytest.mark.parametrize("act", ["update", "bind", "implement", "replace", "pending"])
def test_an_error_between_any_two_steps_of_a_change_leaves_all_of_it_or_nothing(act: str):
    right = []
    for acts in ((), (act,)):
        robot = prepared()
        for one in acts:
            ACTS[one](robot)
        right.append(behaviour(robot))
    for number in lines(stride=3):
        robot = prepared()
        if not raises_at(number, lambda: ACTS[act](robot)):  # noqa: B023
            break
        assert behaviour(robot) in right, number


def behaviour(robot: Robot) -> object:
    bound = "a" in {rule.label for rule in robot.sleec.ruleset.rules} and bool(robot.sleec.bound_objects())
    robot.sleec.trigger("T2")
    return bound, robot.log, dict(robot.sleec.conditions), robot.sleec.ruleset.source.text, robot.asked()


def test_an_act_that_another_thread_does_is_not_done_twice():
    ledger = Ledger(CheckedClock(VirtualClock()), lambda: None)

    class Contested(deque):  # type: ignore[type-arg]
        """Between looking at the first and taking it, another thread takes it."""

        def remove(self, act: object) -> None:
            self.clear()
            super().remove(act)

    done: list[str] = []
    ledger.actions = Contested([Action(lambda: done.append("done"), lambda: True)])
    assert ledger.do_next()
    assert not ledger.do_next()
    assert done == []


def test_a_section_is_left_whatever_is_raised():
    section = CriticalSection()
    for error in (OSError, KeyboardInterrupt):
        with pytest.raises(error):
            section.run(partial(raising, error))
    with pytest.raises(errors.Reentrant, match="in a signal handler, only record the signal"):
        section.run(lambda: section.run(lambda: None))
    assert section.run(lambda: 5) == 5


def raising(error: type[BaseException]) -> None:
    raise error
