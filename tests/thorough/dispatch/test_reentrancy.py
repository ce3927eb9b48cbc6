"""Calls from signal handlers, which Python runs between any two steps of the main thread: each is right, or refused
before it changes anything. An error that a handler raises leaves no half of a change."""

from __future__ import annotations

import inspect
import os
import signal
import sys
import time
from collections import deque
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from types import FrameType

import contextpy3 as cop
import pytest

import sleec_runtime
from sleec_runtime import Monitor, Sleec, VirtualClock, errors, obligation
from sleec_runtime.concurrency.critical_section import CriticalSection
from sleec_runtime.language import parse
from sleec_runtime.timed.clock import CheckedClock
from sleec_runtime.timed.ledger import Action, Ledger

RUNTIME = str(Path(sleec_runtime.__file__).parent) + os.sep

ISSUE = parse("""
RULE a WHEN T1 THEN A WITHIN 1 TO 5 seconds
RULE b WHEN T2 THEN B WITHIN 2 seconds OTHERWISE C
RULE d WHEN T3 THEN D WITHIN 1 TO 3 seconds
RULE e WHEN T4 THEN NOT D WITHIN 9 seconds UNLESS Calm
""")
UNTIMED = parse("""
RULE a WHEN T1 THEN A UNLESS Calm IN WHICH CASE C
RULE b WHEN T2 THEN B AND D
""")
MILD = parse("RULE a WHEN T1 THEN A WITHIN 1 TO 5 seconds\nRULE b WHEN T2 THEN C UNLESS Calm IN WHICH CASE D")


class Ticking:
    """A clock that is moved by hand, and wakes nobody."""

    def __init__(self) -> None:
        self.time = 0

    def now(self) -> int:
        return self.time

    def wake(self, at, call):
        return lambda: None


class Robot:
    """The rules of the issue at work: `log` has what was executed."""

    def __init__(self, ruleset=ISSUE, clock: Ticking | None = None) -> None:
        self.clock = clock or Ticking()
        self.log: list[str] = []
        self.told: list[str] = []
        self.sleec = Sleec(ruleset, clock=self.clock, on_error=self.report)
        self.code = {name: self.callable(name) for name in "ABCD"}
        self.sleec.implement({name: self.code[name] for name in ruleset.obligations})
        self.triggers = sorted(ruleset.triggers - {"T4"})

    def callable(self, name: str):
        return obligation(name, completes=name != "B")(lambda: self.log.append(name))

    def report(self, failure: sleec_runtime.Failure) -> None:
        self.told += failure.obligations

    def bound(self) -> object:
        @self.sleec.rule("a")
        @cop.base
        def method() -> None:
            self.log.append("A")

        return method

    def asked(self) -> list[str]:
        return sorted(str(one) for one in self.sleec.pending())


def at_line(number: int, intrude: Callable[[], object], act: Callable[[], object]) -> bool:
    """Does `act`, and `intrude` before its line `number` in the runtime. False if it has not so many lines."""
    count = 0

    def trace(frame: FrameType, event: str, argument: object):
        nonlocal count
        if not frame.f_code.co_filename.startswith(RUNTIME):
            return None
        if event == "line":
            count += 1
            if count == number:
                sys.settrace(None)
                intrude()
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        act()
    finally:
        sys.settrace(before)
    return count >= number


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


def lines(stride: int = 1) -> Iterator[int]:
    return iter(range(1, 1_000_000, stride))


# A call at every step -------------------------------------------------------------------------------------

ACTS: dict[str, Callable[[Robot], object]] = {
    "trigger": lambda robot: robot.sleec.trigger_all(robot.triggers),
    "tick": lambda robot: robot.sleec.tick(),
    "completed": lambda robot: robot.sleec.completed("B"),
    "pending": lambda robot: robot.sleec.pending(),
    "update": lambda robot: robot.sleec.update({"Calm": True}),
    "bind": lambda robot: robot.sleec.bind(robot.bound()),
    "implement": lambda robot: robot.sleec.implement({"A": robot.code["A"]}),
    "replace": lambda robot: robot.sleec.replace(MILD),
    "close": lambda robot: robot.sleec.close(),
}


def prepared(ruleset=ISSUE, clock: Ticking | None = None) -> Robot:
    """Something is about to open and to close, and something can be completed."""
    robot = Robot(ruleset, clock)
    robot.sleec.trigger("T1")
    robot.sleec.trigger("T2")
    robot.clock.time = 2
    return robot


def seen(robot: Robot, served: bool) -> object:
    """What became of it; if `served`, once all has been served that was asked for, in whatever order."""
    if served:
        robot.clock.time = 50
        robot.sleec.tick()
        robot.log.sort()
        robot.told.sort()
    return robot.asked(), robot.log, robot.told, dict(robot.sleec.conditions), robot.sleec.ruleset.source.text


@pytest.mark.parametrize("intruder", ACTS)
@pytest.mark.parametrize("act", ACTS)
@pytest.mark.parametrize("ruleset", [ISSUE, UNTIMED], ids=["timed", "untimed"])
def test_a_call_between_two_steps_is_right_or_refused(ruleset, act: str, intruder: str):
    intrude_everywhere(ruleset, act, intruder, stride=19)


@pytest.mark.long
@pytest.mark.parametrize("intruder", ACTS)
@pytest.mark.parametrize("act", ACTS)
@pytest.mark.parametrize("ruleset", [ISSUE, UNTIMED], ids=["timed", "untimed"])
def test_a_call_between_any_two_steps_is_right_or_refused(ruleset, act: str, intruder: str):
    intrude_everywhere(ruleset, act, intruder, stride=1)


def intrude_everywhere(ruleset, act: str, intruder: str, stride: int) -> None:
    """Right: what is seen afterwards is what is seen if one comes after the other. What takes several changes may have
    the other between them, and serves the same in the end; but not if the other ends or does some of it."""
    served = act in ("trigger", "tick")
    between = served and intruder in ("close", "completed")
    right = []
    for order in ((act, intruder), (intruder, act), (act,)):
        robot = prepared(ruleset)
        for one in order:
            attempted(ACTS[one], robot)
        right.append(seen(robot, served))
    for number in lines(stride):
        robot = prepared(ruleset)
        outcome: list[str] = []
        intrude = partial(note, outcome, ACTS[intruder], robot)
        if not at_line(number, intrude, partial(attempted, ACTS[act], robot)):
            break
        if outcome == ["Reentrant"]:
            assert seen(robot, served) == right[2]
        elif not between:
            assert seen(robot, served) in right[:2], number


def note(outcome: list[str], act: Callable[[Robot], object], robot: Robot) -> None:
    outcome.append(attempted(act, robot))


def attempted(act: Callable[[Robot], object], robot: Robot) -> str:
    """What it raised, if it was refused. Any other error is a defect."""
    try:
        act(robot)
    except errors.SleecError as error:
        return type(error).__name__
    return "done"


def test_without_a_handler_nothing_is_refused():
    """What the runtime does within a change of its own is no call from outside."""
    robot = prepared()
    with Monitor(robot.sleec, print, watch=[object()]):
        for act in ACTS.values():
            act(robot)
    assert robot.told == []


# Real signals ---------------------------------------------------------------------------------------------


@pytest.fixture
def every_millisecond() -> Iterator[Callable[[Callable[[], object]], None]]:
    """Calls something in a signal handler, again and again."""
    previous = signal.getsignal(signal.SIGALRM)

    def start(call: Callable[[], object]) -> None:
        signal.signal(signal.SIGALRM, lambda number, frame: call())
        signal.setitimer(signal.ITIMER_REAL, 0.001, 0.001)

    yield start
    signal.setitimer(signal.ITIMER_REAL, 0)
    signal.signal(signal.SIGALRM, previous)


@pytest.mark.parametrize("clock", [VirtualClock, Ticking, sleec_runtime.MonotonicClock])
def test_real_signals(clock, every_millisecond):
    log: list[str] = []
    told: list[sleec_runtime.Failure] = []
    sleec = Sleec(ISSUE, clock=clock(), on_error=told.append)
    code = {name: lambda name=name: log.append(name) for name in "ABCD"}
    sleec.implement(code)
    acts: list[Callable[[], object]] = [
        lambda: sleec.trigger("T2"),
        lambda: sleec.update({"Calm": len(log) % 2 == 0}),
        lambda: sleec.pending(),
        lambda: sleec.completed("B"),
        lambda: sleec.due("T1"),
        lambda: sleec.implement(code),
        lambda: sleec.tick(),
        lambda: sleec.trigger_all(["T1", "T3"]),
    ]
    outcomes: list[str] = []

    def call() -> None:
        try:
            acts[len(outcomes) % len(acts)]()
            outcomes.append("done")
        except errors.SleecError as error:
            outcomes.append(type(error).__name__)

    every_millisecond(call)
    deadline = time.monotonic() + 20
    triggers = 0
    while time.monotonic() < deadline and (outcomes.count("Reentrant") < 20 or outcomes.count("done") < 100):
        sleec.trigger("T2")
        triggers += 1
        sleec.update({"Calm": not sleec.conditions.get("Calm")})
        sleec.pending()
        sleec.tick()
    signal.setitimer(signal.ITIMER_REAL, 0)
    sleec.close()
    assert set(outcomes) == {"done", "Reentrant"}
    assert log.count("B") >= triggers
    assert told == []


# An error at every step -----------------------------------------------------------------------------------


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


# The ledger itself ----------------------------------------------------------------------------------------


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


# The section itself ---------------------------------------------------------------------------------------


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
