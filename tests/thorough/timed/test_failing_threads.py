"""Code that fails on a thread."""

from __future__ import annotations

import asyncio
import threading
import time
from collections.abc import Callable, Iterator

import pytest

from sleec_runtime import Failure, MonotonicClock, Sleec, errors
from sleec_runtime.language import parse
from sleec_runtime.timed import executor
from tests.support.failing_code import HASTE, PATIENCE, QUICK, Robot, raising, slow

pytestmark = pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")


NOT_EXCEPTIONS = (SystemExit, KeyboardInterrupt, GeneratorExit, asyncio.CancelledError)


class Hasty(MonotonicClock):
    """Windows on it are shorter than their seconds."""

    def now(self):
        return super().now() * HASTE

    def wake(self, at, call):
        return super().wake(at / HASTE, call)


@pytest.fixture
def never() -> Iterator[threading.Event]:
    """What is waited for until the test ends, so that no thread outlives it."""
    event = threading.Event()
    yield event
    event.set()


def test_whatever_code_does_other_deadlines_are_kept_and_later_triggers_watched(never):
    raised = (*NOT_EXCEPTIONS, OSError)
    codes = [*map(raising, raised), lambda: never.wait(PATIENCE)]
    robots = [Robot(code) for code in (*codes, *codes)]
    for number, robot in enumerate(robots):
        if number < len(codes):
            robot.sleec.trigger_all(["T1", "T2", "T3"])
        else:
            for trigger in ("T1", "T2", "T3"):
                robot.sleec.trigger(trigger)
    for robot in robots:
        assert robot.does("C")
        assert robot.does("D")
        robot.done["C"].clear()
        robot.sleec.trigger("T2")
    for robot in robots:
        assert robot.does("C"), "the clock still watches"
    started = time.monotonic()
    for robot in robots:
        robot.sleec.close()
    assert time.monotonic() - started < PATIENCE
    for error, robot in zip((*raised, None, *raised), robots):
        assert error is None or robot.errors()[0] is error
        assert all(failure.obligations == ("A",) for failure in robot.sleec.failures)
        assert robot.told == list(robot.sleec.failures)


def test_code_that_does_not_return_is_reported_and_the_end_does_not_wait_for_it(never):
    told: list[Failure] = []
    reported = threading.Event()

    def on_error(failure: Failure) -> None:
        told.append(failure)
        reported.set()

    clock = Hasty(limit=0.2)
    sleec = Sleec(parse(QUICK), clock=clock, on_error=on_error)
    sleec.implement({"X": lambda: never.wait(PATIENCE), "Y": slow})
    sleec.trigger("A")
    assert reported.wait(PATIENCE)
    (failure,) = told
    assert isinstance(failure.error, errors.StillRunning)
    assert (failure.rule, failure.obligations, failure.error.seconds) == ("a", ("X",), 0.2)
    assert "its code has not returned after 0.2 seconds (mark slow code with completes=False" in str(failure)
    sleec.close()
    clock.close()
    assert sleec.failures == (failure,)


def test_the_end_waits_for_code_that_is_about_to_return():
    began, ended = threading.Event(), threading.Event()

    def takes_a_moment() -> None:
        began.set()
        time.sleep(0.2)
        ended.set()

    clock = Hasty(limit=PATIENCE)
    sleec = Sleec(parse(QUICK), clock=clock)
    sleec.implement({"X": takes_a_moment, "Y": slow})
    sleec.trigger("A")
    assert began.wait(PATIENCE)
    sleec.close()
    clock.close()
    assert ended.is_set()
    assert sleec.failures == ()


def test_code_may_close_the_clock():
    clock = Hasty(limit=PATIENCE)
    closed = threading.Event()

    def close() -> None:
        clock.close()
        closed.set()

    sleec = Sleec(parse(QUICK), clock=clock)
    sleec.implement({"X": close, "Y": slow})
    started = time.monotonic()
    sleec.trigger("A")
    assert closed.wait(PATIENCE)
    assert time.monotonic() - started < PATIENCE / 2, "it does not wait for itself"


def test_an_error_handler_that_does_not_return_holds_up_nothing(never, caplog):
    entered: list[Failure] = []

    def on_error(failure: Failure) -> None:
        entered.append(failure)
        never.wait(PATIENCE)

    done = threading.Event()
    clock = Hasty(limit=0.2)
    sleec = Sleec(parse(QUICK), clock=clock, on_error=on_error)
    sleec.implement({"X": raising(OSError), "Y": done.set})
    sleec.trigger("A")
    sleec.trigger("B")
    assert done.wait(PATIENCE)
    while "on_error: its code has not returned after 0.2 seconds" not in caplog.text:
        time.sleep(0.01)
    sleec.close()
    clock.close()
    assert [type(failure.error) for failure in sleec.failures] == [OSError]
    assert entered == list(sleec.failures)


@pytest.mark.parametrize("error", [*NOT_EXCEPTIONS, OSError])
def test_an_error_handler_may_raise_anything(error, caplog):
    done = threading.Event()
    clock = Hasty()
    sleec = Sleec(parse(QUICK), clock=clock, on_error=lambda failure: raising(error)())
    sleec.implement({"X": raising(OSError), "Y": done.set})
    sleec.trigger("A")
    sleec.trigger("B")
    assert done.wait(PATIENCE)
    sleec.close()
    clock.close()
    assert [type(failure.error) for failure in sleec.failures] == [OSError]
    assert "on_error failed at" in caplog.text


def test_what_the_clock_starts_at_one_time_begins_in_the_order_of_the_rules(monkeypatch):
    monkeypatch.setattr(executor, "OVERLAP", PATIENCE)
    count = 200
    text = "\n".join(f"RULE r{i} WHEN T THEN X{i} WITHIN 1 TO 1000 seconds" for i in range(count))
    log: list[int] = []
    ended = threading.Event()

    def code(number: int):
        def run() -> None:
            log.append(number)
            if number == count - 1:
                ended.set()

        return run

    clock = Hasty()
    sleec = Sleec(parse(text), clock=clock)
    sleec.implement({f"X{i}": code(i) for i in range(count)})
    sleec.trigger("T")
    assert ended.wait(PATIENCE)
    assert log == list(range(count))
    sleec.close()
    clock.close()


def test_a_missing_thread_is_reported(monkeypatch):
    start = threading.Thread.start

    def refuse(thread: threading.Thread) -> None:
        if thread.name == "sleec code":
            raise RuntimeError("can't start new thread")
        start(thread)

    told: list[str] = []
    clock = MonotonicClock()
    monkeypatch.setattr(threading.Thread, "start", refuse)
    clock.execute(lambda: None, lambda error: told.append(str(error)))
    assert told == ["no thread can be started for it: can't start new thread (end code that does not return)"]
    monkeypatch.undo()
    done = threading.Event()
    clock.execute(done.set, lambda error: told.append(str(error)))
    assert done.wait(PATIENCE)
    clock.close()


class Alarms:
    """Alarms that go off when the test says so; without threads, none can be set."""

    def __init__(self) -> None:
        self.calls: list[Callable[[], object]] = []
        self.threads = True

    def wake(self, at: float, call: Callable[[], object]) -> Callable[[], None]:
        if not self.threads:
            raise RuntimeError("can't start new thread")
        self.calls.append(call)
        return lambda: None


def test_an_alarm_that_comes_after_the_job_does_nothing():
    alarms = Alarms()
    one = executor.Executor(alarms.wake, limit=1)
    told: list[object] = []
    began, go_on = threading.Event(), threading.Event()

    threads: list[threading.Thread] = []

    def job() -> None:
        threads.append(threading.current_thread())
        began.set()
        go_on.wait(PATIENCE)

    one.execute(job, told.append)
    assert began.wait(PATIENCE)
    alarms.calls[-1]()
    assert len(alarms.calls) == 2, "the job may run until its limit"
    go_on.set()
    threads[0].join(PATIENCE)
    assert not threads[0].is_alive()
    for call in tuple(alarms.calls):
        call()
    assert told == []
    assert len(alarms.calls) == 2


def test_a_job_waits_while_no_thread_can_watch_it():
    alarms = Alarms()
    alarms.threads = False
    one = executor.Executor(alarms.wake, limit=1)
    done: list[str] = []
    ended = threading.Event()

    def second() -> None:
        done.append("second")
        ended.set()

    with pytest.raises(RuntimeError):
        one.execute(lambda: done.append("first"), print)
    alarms.threads = True
    one.execute(second, print)
    assert ended.wait(PATIENCE)
    assert done == ["first", "second"]


@pytest.mark.parametrize("error", [*NOT_EXCEPTIONS, OSError])
def test_a_call_by_the_clock_may_raise_anything(error, caplog):
    clock = MonotonicClock()
    done = threading.Event()
    clock.wake(clock.now(), raising(error))
    clock.wake(10**1000, slow)
    clock.wake(clock.now(), done.set)
    assert done.wait(PATIENCE)
    clock.close()
    assert error.__name__ in caplog.text


@pytest.mark.parametrize("limit", [0, -1, "1", True, None, float("inf")])
def test_a_limit_is_a_number_of_seconds(limit):
    with pytest.raises(errors.WrongType, match="limit is a number of seconds above 0"):
        MonotonicClock(limit=limit)
