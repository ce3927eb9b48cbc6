"""A call at every step of a dispatch, and real signals."""

from __future__ import annotations

import signal
import sys
import time
from collections.abc import Callable, Iterator
from functools import partial
from types import FrameType

import pytest

import sleec_runtime
from sleec_runtime import Monitor, Sleec, VirtualClock, errors
from sleec_runtime.language import parse
from tests.support.reentrancy import ACTS, ISSUE, RUNTIME, Robot, Ticking, lines, prepared

UNTIMED = parse("""
RULE a WHEN T1 THEN A UNLESS Calm IN WHICH CASE C
RULE b WHEN T2 THEN B AND D
""")


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
