"""The clocks, and what the runtime starts by them."""

from __future__ import annotations

import asyncio
import threading
import time

import pytest

from sleec_runtime import AsyncioClock, MonotonicClock, PolledClock, Sleec, VirtualClock, errors, obligation
from sleec_runtime.language import parse

RULES = "MEASURE wait: integer\nRULE a WHEN A THEN X WITHIN wait seconds OTHERWISE Y\nRULE b WHEN B THEN X"

pytestmark = pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")


def running(wait: int = 0, **options):
    sleec = Sleec(parse(RULES), **options)
    # Whole seconds are long; a window of no length closes as soon as it is looked at.
    sleec.update({"wait": wait})
    return sleec


def slow(function):
    return obligation("X", completes=False)(function)


def clock_threads() -> list[str]:
    return [thread.name for thread in threading.enumerate() if thread.name == "sleec clock"]


# By itself ------------------------------------------------------------------------------------------------


def test_a_virtual_clock_goes_from_call_to_call():
    clock = VirtualClock(10)
    called: list[object] = []
    clock.wake(12.5, lambda: called.append(clock.now()))
    clock.wake(11, lambda: clock.wake(5, lambda: called.append(clock.now())))
    cancel = clock.wake(11, lambda: called.append("never"))
    cancel()
    clock.advance(1)
    clock.advance(0.5)
    assert called == [11]
    clock.advance(1)
    assert called == [11, 12.5]
    assert clock.now() == 12.5
    assert repr(clock) == "VirtualClock(12.5)"
    for wrong in (-1, "1", float("nan")):
        with pytest.raises(errors.WrongType, match="the time that passes"):
            clock.advance(wrong)  # type: ignore[arg-type]


def test_a_virtual_clock_may_start_at_a_float():
    clock = VirtualClock(0.25)
    clock.advance(0.5)
    assert clock.now() == 0.75


def test_a_monotonic_clock_has_a_thread_while_there_is_something_to_wait_for():
    clock = MonotonicClock()
    assert clock_threads() == []
    woken = threading.Event()
    cancel = clock.wake(clock.now() + 1_000, lambda: None)
    clock.wake(clock.now() + 0.01, woken.set)
    assert woken.wait(10)
    assert len(clock_threads()) == 1
    cancel()
    clock.close()
    assert clock_threads() == []
    clock.close()


def test_a_monotonic_clock_may_be_closed_by_what_it_calls():
    clock = MonotonicClock()
    closed = threading.Event()

    def close() -> None:
        clock.close()
        closed.set()

    clock.wake(clock.now(), close)
    assert closed.wait(10)
    clock.close()
    assert clock_threads() == []


# At work --------------------------------------------------------------------------------------------------


def test_by_default_a_thread_watches_and_is_gone_after_the_end():
    done = threading.Event()
    with running(wait=1) as sleec:
        sleec.implement({"X": slow(lambda: None), "Y": done.set})
        assert clock_threads() == []
        sleec.trigger("A")
        assert clock_threads() == ["sleec clock"]
        assert done.wait(10)
        sleec.trigger("A")
    assert clock_threads() == []
    assert sleec.failures == ()


def test_what_is_done_needs_no_thread():
    with running(wait=100) as sleec:
        sleec.implement({"X": lambda: None, "Y": lambda: None})
        sleec.trigger("A")
        deadline = time.monotonic() + 10
        while clock_threads() and time.monotonic() < deadline:
            time.sleep(0.001)
        assert clock_threads() == []


def test_what_blocks_longer_than_its_window_is_late():
    other = threading.Event()
    with running(wait=1) as sleec:
        sleec.implement({"X": lambda: other.wait(10), "Y": other.set})
        sleec.trigger("A")
        assert other.is_set(), "the clock did it meanwhile"
        assert sleec.pending() == ()


def test_a_clock_that_is_polled_wakes_nobody():
    log: list[str] = []
    sleec = running(wait=0, clock=PolledClock())
    sleec.implement({"X": lambda: log.append("X"), "Y": lambda: log.append("Y")})
    sleec.replace(parse("RULE a WHEN A THEN X WITHIN 1 TO 1000 seconds"))
    sleec.trigger("A")
    sleec.tick()
    assert log == []
    time.sleep(1.05)
    assert log == []
    sleec.tick()
    assert log == ["X"]
    sleec.trigger("A")
    sleec.close()
    sleec.tick()


def test_in_an_event_loop_what_the_clock_starts_may_be_a_coroutine():
    log: list[str] = []

    async def robot() -> None:
        assert AsyncioClock().now() <= AsyncioClock(asyncio.get_running_loop()).now()
        sleec = running(wait=1, clock=AsyncioClock())
        done = asyncio.Event()

        async def y() -> None:
            await asyncio.sleep(0)
            log.append("Y")
            done.set()

        sleec.implement({"X": slow(lambda: log.append("X")), "Y": y})
        sleec.trigger("A")
        await asyncio.wait_for(done.wait(), 10)

        def plain() -> None:
            log.append("plain")
            done.set()

        sleec.implement({"Y": plain})
        done.clear()
        sleec.trigger("A")
        await asyncio.wait_for(done.wait(), 10)
        sleec.close()
        assert sleec.failures == ()

    asyncio.run(robot())
    assert log == ["X", "Y", "X", "plain"]


def test_what_is_awaited_is_done_when_it_has_been():
    clock = VirtualClock()
    log: list[str] = []

    async def x() -> None:
        clock.advance(3)
        await asyncio.sleep(0)
        log.append("X")

    async def fails() -> None:
        raise OSError("gone")

    async def robot() -> None:
        sleec = running(wait=5, clock=clock)
        sleec.implement({"X": x, "Y": x})
        done = await sleec.trigger_async("A")
        assert (done.obligations, done.due) == (("X",), ())
        done = await sleec.trigger_all_async(["A", "B"])
        assert done.due == ()
        # Known to be a coroutine only when it returns one.
        sleec.implement({"X": lambda: x()})
        assert (await sleec.trigger_async("A")).due == ()
        sleec.implement({"X": fails})
        with pytest.raises(OSError, match="gone"):
            await sleec.trigger_async("A")
        assert len(sleec.pending()) == 1

    asyncio.run(robot())
    assert log == ["X"] * 4


def test_coroutines_that_nobody_would_await_are_refused():
    async def coroutine() -> None:
        raise AssertionError

    clock = VirtualClock()
    sleec = running(wait=5, clock=clock)
    sleec.implement({"X": coroutine, "Y": coroutine})
    with pytest.raises(errors.NeedsAwait, match="code of a is a coroutine function"):
        sleec.trigger("A")
    assert sleec.pending() == ()
    sleec.implement({"X": slow(lambda: None)})
    sleec.trigger("A")
    clock.advance(5)
    (failure,) = sleec.failures
    assert isinstance(failure.error, errors.NeedsAwait)
    sleec.implement({"X": lambda: coroutine()})
    with pytest.raises(errors.NeedsAwait, match="returned a coroutine"):
        sleec.trigger("A")


@pytest.mark.parametrize("given", [object(), 5, VirtualClock, "now"])
def test_what_is_no_clock_is_refused_at_once(given):
    with pytest.raises(errors.WrongType, match="clock is a clock"):
        Sleec(parse("WHEN A THEN B"), clock=given)
