"""Code that fails in the thread of the user, and interrupted dispatches."""

from __future__ import annotations

import asyncio
import time

import pytest

from sleec_runtime import AsyncioClock, Failure, PolledClock, Sleec, VirtualClock, obligation
from sleec_runtime.language import parse
from tests.support.failing_code import HASTE, ISSUE, PATIENCE, QUICK, Robot, raising, slow

pytestmark = pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")


class HastyLoop(AsyncioClock):
    """Windows on it are shorter than their seconds."""

    def now(self):
        return super().now() * HASTE

    def wake(self, at, call):
        return super().wake(at / HASTE, call)


@pytest.mark.parametrize("error", [SystemExit, GeneratorExit, asyncio.CancelledError])
def test_on_a_virtual_clock_a_failure_is_reported_and_not_raised(error):
    clock = VirtualClock()
    robot = Robot(raising(error), clock=clock)
    robot.sleec.trigger_all(["T1", "T2", "T3"])
    clock.advance(4)
    assert robot.done["C"].is_set()
    assert robot.done["D"].is_set()
    assert robot.errors() == [error]
    assert robot.told == list(robot.sleec.failures)
    assert [one.state for one in robot.sleec.pending()] == ["waiting"], "it can still be done"


def test_in_the_main_thread_an_interrupt_is_raised_once_all_that_is_due_is_served():
    clock = VirtualClock()
    robot = Robot(raising(KeyboardInterrupt), clock=clock)
    robot.sleec.trigger_all(["T1", "T2", "T3"])
    with pytest.raises(KeyboardInterrupt):
        clock.advance(4)
    assert clock.now() == 1
    assert robot.done["D"].is_set()
    assert robot.errors() == [KeyboardInterrupt]
    clock.advance(1)
    assert robot.done["C"].is_set()


def test_an_interrupt_of_an_error_handler_is_raised_in_the_main_thread(caplog):
    clock = VirtualClock()
    sleec = Sleec(parse(ISSUE), clock=clock, on_error=lambda failure: raising(KeyboardInterrupt)())
    sleec.implement({"A": raising(OSError), "B": slow, "C": slow, "D": slow})
    sleec.trigger("T1")
    with pytest.raises(KeyboardInterrupt):
        clock.advance(2)
    assert len(sleec.failures) == 1


@pytest.mark.parametrize("error", [SystemExit, GeneratorExit, OSError])
def test_a_polled_clock_raises_nothing(error, monkeypatch):
    now = [0.0]
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    robot = Robot(raising(error), clock=PolledClock())
    robot.sleec.trigger_all(["T1", "T2", "T3"])
    now[0] = 2.5
    robot.sleec.tick()
    assert robot.done["C"].is_set()
    assert robot.done["D"].is_set()
    assert robot.errors() == [error]


@pytest.mark.parametrize("coroutine", [False, True], ids=["function", "coroutine function"])
@pytest.mark.parametrize("error", [SystemExit, GeneratorExit, asyncio.CancelledError, OSError])
def test_an_event_loop_goes_on(error, coroutine):
    async def awaited() -> None:
        await asyncio.sleep(0)
        raise error

    async def main() -> None:
        robot = Robot(awaited if coroutine else raising(error), clock=HastyLoop())
        robot.sleec.trigger_all(["T1", "T2", "T3"])
        for name in "CD":
            assert await asyncio.to_thread(robot.does, name)
        assert robot.errors() == [error]
        assert robot.told == list(robot.sleec.failures)
        robot.sleec.close()

    asyncio.run(main())


def test_what_a_loop_cancels_at_its_end_is_reported():
    told: list[Failure] = []

    async def waits() -> None:
        await asyncio.sleep(PATIENCE)

    async def main() -> None:
        sleec = Sleec(parse(QUICK), clock=HastyLoop(), on_error=told.append)
        sleec.implement({"X": waits, "Y": slow})
        await sleec.trigger_async("A")
        while not any(one.state == "under way" for one in sleec.pending()):
            await asyncio.sleep(0.01)

    asyncio.run(main())
    (failure,) = told
    assert isinstance(failure.error, asyncio.CancelledError)
    assert str(failure).endswith("X (a): CancelledError")


CHAIN = "RULE a WHEN A THEN X\nRULE b WHEN A THEN Y\nRULE x WHEN Y THEN Z WITHIN 5 seconds OTHERWISE W"


def test_an_interrupted_trigger_asks_for_nothing_that_was_not_called_for():
    clock = VirtualClock()
    sleec = Sleec(parse(CHAIN), clock=clock, chains=True)
    sleec.implement(
        {"X": raising(KeyboardInterrupt), "Y": slow, "Z": obligation("Z", completes=False)(slow), "W": slow}
    )
    with pytest.raises(KeyboardInterrupt):
        sleec.trigger("A")
    assert sleec.pending() == ()
    clock.advance(10)
    assert sleec.failures == ()


def test_an_interrupted_asynchronous_trigger_asks_for_nothing_that_was_not_called_for():
    clock = VirtualClock()
    sleec = Sleec(parse(CHAIN), clock=clock, chains=True)
    sleec.implement({"X": raising(SystemExit), "Y": slow, "Z": obligation("Z", completes=False)(slow), "W": slow})

    async def main() -> None:
        with pytest.raises(SystemExit):
            await sleec.trigger_async("A")

    asyncio.run(main())
    assert sleec.pending() == ()


def test_what_fails_unattended_has_its_alternative_whatever_it_raised():
    clock = VirtualClock()
    log: list[str] = []
    sleec = Sleec(
        parse("RULE a WHEN A THEN X WITHIN 1 TO 1 seconds OTHERWISE Y\nRULE b WHEN A THEN X ELSE Y"), clock=clock
    )
    sleec.implement({"X": raising(SystemExit), "Y": lambda: log.append("Y")})
    with pytest.raises(SystemExit):
        sleec.trigger("A")
    clock.advance(2)
    assert log == ["Y"]
    assert [type(failure.error) for failure in sleec.failures] == [SystemExit]
