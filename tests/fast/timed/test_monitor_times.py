"""The monitor on rules with windows: what another execution fulfils is not missing."""

from __future__ import annotations

import asyncio
import sys
import threading
from collections.abc import Callable

import pytest

from sleec_runtime import Monitor, Sleec, VirtualClock, obligation
from sleec_runtime.language import parse
from sleec_runtime.monitor.difference import Difference

RULES = """
RULE first WHEN A THEN First
RULE a WHEN A THEN X WITHIN 5 seconds AND Y WITHIN 5 seconds
RULE b WHEN B THEN X
RULE c WHEN C THEN X WITHIN 5 seconds
RULE d WHEN D THEN Y WITHIN 5 seconds
RULE e WHEN E THEN X WITHIN 2 TO 3 seconds
"""

pytestmark = pytest.mark.filterwarnings("ignore::sleec_runtime.errors.NotEnforced")


class Watched:
    """Rules at work on a virtual clock, with what the monitor finds. `meanwhile` is what `First` runs: it comes after
    the trigger A is decided, and before `X` and `Y` of rule a begin."""

    def __init__(self, text: str = RULES, **options: object) -> None:
        self.clock = VirtualClock()
        self.sleec = Sleec(parse(text), clock=self.clock, on_error=lambda failure: None, **options)  # type: ignore[arg-type]
        self.meanwhile: Callable[[], object] = lambda: None
        self.executed: list[str] = []
        names = sorted(self.sleec.ruleset.obligations - {"First"})
        self.sleec.implement({name: lambda name=name: self.executed.append(name) for name in names})
        if "First" in self.sleec.ruleset.obligations:
            self.sleec.implement({"First": self.first})
        self.found: list[Difference] = []

    def first(self) -> None:
        self.meanwhile()

    def differences(self, *triggers: str) -> list[str]:
        with Monitor(self.sleec, self.found.append):
            self.sleec.trigger_all(triggers)
        return [str(difference) for difference in self.found]


def in_another_thread(work: Callable[[], object]) -> None:
    """Runs `work` while this thread waits in the middle of a dispatch."""
    errors: list[BaseException] = []

    def guarded() -> None:
        try:
            work()
        except BaseException as error:  # noqa: BLE001 - raised in the thread of the test
            errors.append(error)

    thread = threading.Thread(target=guarded)
    thread.start()
    thread.join(60)
    assert not thread.is_alive()
    assert not errors, errors


def in_this_thread(work: Callable[[], object]) -> None:
    work()


def by_the_clock(watched: Watched) -> None:
    watched.sleec.trigger("E")
    watched.clock.advance(2)


FULFILLING: dict[str, Callable[[Watched], object]] = {
    "a rule without a window": lambda w: w.sleec.trigger("B"),
    "a rule with a window": lambda w: w.sleec.trigger("C"),
    "several triggers": lambda w: w.sleec.trigger_all(["C", "D"]),
    "a report": lambda w: w.sleec.completed("X"),
    "the clock": by_the_clock,
    "a coroutine": lambda w: asyncio.run(w.sleec.trigger_async("C")),
}


@pytest.mark.parametrize("place", [in_another_thread, in_this_thread])
@pytest.mark.parametrize("how", FULFILLING)
def test_what_is_fulfilled_meanwhile_is_not_missing(how: str, place: Callable[[Callable[[], object]], None]) -> None:
    watched = Watched()
    watched.meanwhile = lambda: place(lambda: FULFILLING[how](watched))
    assert watched.differences("A") == []
    assert watched.executed.count("X") == (0 if how == "a report" else 1)
    assert watched.sleec.pending() == ()


def test_the_same_in_a_coroutine() -> None:
    watched = Watched()

    async def first() -> None:
        watched.sleec.completed("X")

    watched.sleec.implement({"First": first})
    with Monitor(watched.sleec, watched.found.append):
        asyncio.run(watched.sleec.trigger_async("A"))
    assert watched.found == []
    assert watched.executed == ["Y"]


def test_two_threads_with_one_rule_and_one_execution() -> None:
    """The trigger of the second thread is decided while the first is at `First`; each thread fulfils both."""
    watched = Watched()
    entered = threading.Barrier(2)
    watched.meanwhile = lambda: entered.wait(60)
    with Monitor(watched.sleec, watched.found.append):
        other = threading.Thread(target=watched.sleec.trigger, args=("A",))
        other.start()
        watched.sleec.trigger("A")
        other.join(60)
    assert watched.found == []


def test_one_execution_fulfils_several_rules_of_a_dispatch() -> None:
    watched = Watched("RULE a WHEN A THEN X WITHIN 5 seconds AND Y\nRULE b WHEN A THEN X WITHIN 3 seconds AND Z")
    assert watched.differences("A") == []
    assert watched.executed == ["X", "Y", "Z"]


def test_what_a_fulfilled_event_triggers_is_due_where_it_is_done() -> None:
    watched = Watched(RULES + "RULE x WHEN X THEN Z", chains=True)
    watched.meanwhile = lambda: watched.sleec.trigger("C")
    assert watched.differences("A") == []
    assert watched.executed == ["X", "Z", "Y"]


def test_what_the_other_thread_does_not_do_is_missing() -> None:
    watched = Watched()

    class Robot:
        @obligation("X")
        def x(self) -> None:
            raise OSError("stuck")

    def meanwhile() -> None:
        with pytest.raises(OSError, match="stuck"):
            watched.sleec.trigger("C")

    watched.sleec.implement(Robot())
    watched.meanwhile = lambda: in_another_thread(meanwhile)
    with Monitor(watched.sleec, watched.found.append), pytest.raises(OSError, match="stuck"):
        watched.sleec.trigger("A")
    assert [str(difference) for difference in watched.found] == ["C: not executed: X", "A: not executed: X, Y"]


def test_what_is_missed_meanwhile_is_missing() -> None:
    watched = Watched()
    watched.meanwhile = lambda: in_another_thread(lambda: watched.clock.advance(6))
    assert watched.differences("A") == ["A: not executed: X, Y"]
    assert len(watched.sleec.failures) == 2


def test_a_measure_says_that_a_window_opens_at_once() -> None:
    watched = Watched("MEASURE wait: integer\nRULE a WHEN A THEN X WITHIN wait TO 9 seconds")
    watched.sleec.update({"wait": 0})
    assert watched.differences("A") == []
    watched.sleec.update({"wait": 1})
    assert watched.differences("A") == []
    assert watched.executed == ["X"]


def test_many_triggers_in_two_threads_differ_in_nothing() -> None:
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)
    try:
        watched = Watched()
        with Monitor(watched.sleec, watched.found.append):
            threads = [
                threading.Thread(target=lambda: [watched.sleec.trigger(name) for name in "ABCD" * 100])
                for _ in range(2)
            ]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
        assert watched.found == []
        assert watched.sleec.pending() == ()
    finally:
        sys.setswitchinterval(interval)
