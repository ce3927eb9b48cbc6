"""What an instance does in a process that `os.fork` has made."""

from __future__ import annotations

import json
import os
import select
import signal
import subprocess
import sys
import threading
import traceback
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from typing import Any

import pytest

from sleec_runtime import MonotonicClock, PolledClock, Sleec, VirtualClock, errors, obligation
from sleec_runtime.concurrency import fork as forks
from sleec_runtime.concurrency.critical_section import CriticalSection
from sleec_runtime.language import parse
from sleec_runtime.timed.executor import Executor
from tests.support.paths import ROOT

ISSUE = """
RULE a WHEN T1 THEN A WITHIN 1 TO 5 seconds
RULE b WHEN T2 THEN B WITHIN 2 seconds OTHERWISE C
RULE d WHEN T3 THEN D WITHIN 1 TO 3 seconds UNLESS Calm
"""
PATIENCE = 20

pytestmark = [
    pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no os.fork here"),
    # Python 3.12 and later warn of every fork of a process with threads.
    pytest.mark.filterwarnings("ignore:.*multi-threaded.*:DeprecationWarning"),
]


def in_child(work: Callable[[], object]) -> Any:
    """What `work` returns in a forked process. Fails if it does not return."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            answer: object = work()
        except BaseException:  # noqa: BLE001 - told in the parent
            answer = {"raised": traceback.format_exc()}
        with suppress(BaseException):
            os.write(writer, json.dumps(answer).encode())
        os._exit(0)
    os.close(writer)
    try:
        ready, _, _ = select.select([reader], [], [], PATIENCE)
        if not ready:
            raise AssertionError("the child hangs")
        answer = json.loads(os.read(reader, 100_000))
    finally:
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        os.close(reader)
    assert not (isinstance(answer, dict) and "raised" in answer), answer
    return answer


class Robot:
    def __init__(self, **options: Any) -> None:
        self.log: list[str] = []
        self.done = {name: threading.Event() for name in "ABCD"}
        self.sleec = Sleec(parse(ISSUE), **options)
        self.sleec.implement({name: self.callable(name) for name in "ABCD"})

    def callable(self, name: str) -> Callable[[], None]:
        def code() -> None:
            self.log.append(name)
            self.done[name].set()

        return obligation(name, completes=name != "B")(code)


def test_with_nothing_pending_the_instance_works_in_both_processes():
    robot = Robot()
    robot.sleec.trigger("T2")
    robot.sleec.completed("B")

    def work() -> object:
        robot.sleec.update({"Calm": False})
        for trigger in ("T1", "T2", "T3"):
            robot.sleec.trigger(trigger)
        done = [robot.done[name].wait(PATIENCE) for name in "ACD"]
        robot.sleec.close()
        return [done, [str(failure) for failure in robot.sleec.failures]]

    robot.log.clear()
    robot.sleec.trigger("T2")
    robot.sleec.completed("B")
    assert in_child(work) == [[True] * 3, []]
    robot.sleec.trigger("T1")
    assert robot.done["A"].wait(PATIENCE)
    assert robot.log == ["B", "A"]
    robot.sleec.close()


CALLS: dict[str, Callable[[Sleec], object]] = {
    "trigger": lambda sleec: sleec.trigger("T1"),
    "trigger_all": lambda sleec: sleec.trigger_all(["T1", "T3"]),
    "due": lambda sleec: sleec.due("T1"),
    "completed": lambda sleec: sleec.completed("B"),
    "tick": lambda sleec: sleec.tick(),
    "restore": lambda sleec: sleec.restore(sleec.pending_snapshot()),
}


@pytest.mark.parametrize("clock", [MonotonicClock, PolledClock, VirtualClock])
def test_what_is_pending_stays_with_the_process_that_was_forked(clock):
    robot = Robot(clock=clock())
    robot.sleec.trigger("T2")

    def work() -> object:
        outcomes = {}
        for name, call in CALLS.items():
            try:
                call(robot.sleec)
            except errors.SleecError as error:
                outcomes[name] = type(error).__name__
        robot.sleec.update({"Calm": True})
        seen = [one.obligation for one in robot.sleec.pending()]
        saved = [one["obligation"] for one in robot.sleec.pending_snapshot()["pending"]]
        robot.sleec.close()
        return [outcomes, seen, saved, robot.log]

    assert in_child(work) == [dict.fromkeys(CALLS, "Forked"), ["B"], ["B"], ["B"]]
    assert [one.obligation for one in robot.sleec.pending()] == ["B"]
    assert not robot.sleec.conditions
    robot.sleec.close()


def test_the_parent_goes_on_and_serves_once():
    robot = Robot()
    robot.sleec.trigger("T2")
    assert in_child(lambda: robot.done["C"].wait(3)) is False
    assert robot.done["C"].wait(PATIENCE)
    assert robot.log == ["B", "C"]
    robot.sleec.close()


def test_another_instance_goes_on_from_what_the_first_had():
    robot = Robot()
    robot.sleec.trigger("T2")

    def work() -> object:
        heir = Robot()
        heir.sleec.restore(robot.sleec.pending_snapshot())
        return [heir.done["C"].wait(PATIENCE), heir.log]

    assert in_child(work) == [True, ["C"]]
    robot.sleec.close()


# The same, without a fork ------------------------------------------------------------------------------------


def test_a_section_that_another_thread_has_is_renewed_and_its_change_undone():
    undone: list[str] = []
    section = CriticalSection(lambda: undone.append("undone"))
    entered, leave = threading.Event(), threading.Event()

    def change() -> None:
        entered.set()
        leave.wait(PATIENCE)

    section.after_fork()
    section.run(section.after_fork)
    assert undone == []
    thread = threading.Thread(target=section.run, args=(change,))
    thread.start()
    assert entered.wait(PATIENCE)
    section.after_fork()
    assert undone == ["undone"]
    assert section.run(lambda: 5) == 5
    leave.set()
    thread.join()
    assert section.run(lambda: 5) == 5


def test_what_is_renewed_is_what_still_exists():
    renewed: list[str] = []

    class Renewable:
        def after_fork(self) -> None:
            renewed.append("renewed")

    one, other = Renewable(), Renewable()
    forks.renew_after_fork(one)
    forks.renew_after_fork(other)
    del other
    robot = Robot(clock=VirtualClock())
    robot.sleec.trigger("T2")
    forks.renew()
    assert renewed == ["renewed"]
    with pytest.raises(errors.Forked, match="load the rules again in this process"):
        robot.sleec.trigger("T1")


# Locks that another thread holds at the fork ---------------------------------------------------------------


class Slow(Mapping[str, object]):
    """A change of context that takes its time to say what it is."""

    def __init__(self, pause: Callable[[], object]) -> None:
        self.pause = pause

    def __getitem__(self, name: str) -> object:
        return True

    def __iter__(self) -> Iterator[str]:
        self.pause()
        return iter(["Calm"])

    def __len__(self) -> int:
        return 1


class Pausing:
    """A clock that may stop within `wake`, at the end of a change."""

    def __init__(self) -> None:
        self.pause: Callable[[], object] = lambda: None

    def now(self) -> int:
        return 0

    def wake(self, at: object, call: object) -> Callable[[], None]:
        self.pause()
        return lambda: None


def forked_meanwhile(hold: Callable[[Callable[[], object]], object], work: Callable[[], object]) -> Any:
    """What `work` returns in a process that is forked while another thread is in `hold`."""
    entered, leave = threading.Event(), threading.Event()

    def pause() -> None:
        entered.set()
        leave.wait(PATIENCE)

    thread = threading.Thread(target=hold, args=(pause,))
    thread.start()
    assert entered.wait(PATIENCE)
    try:
        return in_child(work)
    finally:
        leave.set()
        thread.join()


def test_a_change_of_context_under_way_in_another_thread():
    robot = Robot()

    def work() -> object:
        robot.sleec.update({"Calm": False})
        robot.sleec.bind(marked(robot.sleec))
        return dict(robot.sleec.conditions)

    assert forked_meanwhile(lambda pause: robot.sleec.update(Slow(pause)), work) == {"Calm": False}
    assert dict(robot.sleec.conditions) == {"Calm": True}


def marked(sleec: Sleec) -> object:
    @sleec.rule("a")
    def method() -> None:
        """Does nothing."""

    return method


def test_a_trigger_under_way_in_another_thread_is_that_of_the_other_process():
    clock = Pausing()
    robot = Robot(clock=clock)

    def hold(pause: Callable[[], object]) -> None:
        clock.pause = pause
        robot.sleec.trigger("T1")

    def work() -> object:
        clock.pause = lambda: None
        before = len(robot.sleec.pending())
        robot.sleec.trigger("T3")
        return [before, [one.obligation for one in robot.sleec.pending()]]

    assert forked_meanwhile(hold, work) == [0, ["D"]]
    assert [one.obligation for one in robot.sleec.pending()] == ["A"]


@pytest.mark.parametrize("of_executor", [False, True])
def test_a_lock_of_the_clock_that_another_thread_holds(of_executor):
    clock = MonotonicClock()
    robot = Robot(clock=clock)
    holder: Any = clock
    if of_executor:
        (holder,) = (value for value in vars(clock).values() if isinstance(value, Executor))
    (held,) = (
        value for value in vars(holder).values() if isinstance(value, (threading.Condition, type(threading.RLock())))
    )

    def hold(pause: Callable[[], object]) -> None:
        with held:
            pause()

    def work() -> object:
        robot.sleec.trigger("T1")
        done = robot.done["A"].wait(PATIENCE)
        robot.sleec.close()
        clock.close()
        return done

    assert forked_meanwhile(hold, work) is True


def test_many_forks_while_threads_trigger_and_the_clock_runs():
    """In a process of its own, where no coverage is measured: that takes a lock that is not renewed in the child."""
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", "from tests.thorough.support.test_fork import fork_often; fork_often()"],
        cwd=ROOT,
        env={name: value for name, value in os.environ.items() if not name.startswith("COV")},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")


def fork_often() -> None:
    robot = Robot(clock=VirtualClock())
    finished = threading.Event()

    def work() -> None:
        while not finished.is_set():
            robot.sleec.trigger("T1")
            robot.sleec.update({"Calm": True})
            robot.sleec.update({"Calm": False})

    def child() -> object:
        robot.sleec.update({"Calm": True})
        robot.sleec.pending()
        robot.sleec.close()
        return len(robot.sleec.conditions)

    threads = [threading.Thread(target=work) for _ in range(3)]
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)
    try:
        for thread in threads:
            thread.start()
        for _ in range(30):
            assert in_child(child) == 1
    finally:
        finished.set()
        sys.setswitchinterval(interval)
        for thread in threads:
            thread.join()
