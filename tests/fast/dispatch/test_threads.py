"""Many threads, one changing context: every executed set is one that some whole context justifies."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator

import pytest

from sleec_runtime import Sleec
from sleec_runtime.language import parse
from tests.support.paths import ROOT
from tests.support.robots import running

RULES = """
RULE r1 WHEN a THEN o1 UNLESS c IN WHICH CASE o2
RULE r2 WHEN a THEN o3 UNLESS c IN WHICH CASE o4
RULE r3 WHEN b THEN o5 UNLESS d IN WHICH CASE o6 UNLESS c IN WHICH CASE o7
"""
JUSTIFIED: dict[str, set[tuple[str, ...]]] = {
    "a": {("o1", "o3"), ("o2", "o4")},
    "b": {("o5",), ("o6",), ("o7",)},
}
WHOLE = ({"c": False, "d": False}, {"c": True, "d": True}, {"c": False, "d": True}, {"c": True, "d": False})
THREADS = 8
UNTRACED = """
import sys
from tests.fast.dispatch.test_threads import dispatches
sys.setswitchinterval(1e-5)
dispatches(int(sys.argv[1]))
"""


@pytest.fixture(autouse=True)
def hasty_threads() -> Iterator[None]:
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)
    yield
    sys.setswitchinterval(interval)


def in_threads(work: Callable[[int], None], meanwhile: Callable[[], object]) -> None:
    """Runs `work` in each thread and `meanwhile` again and again in another, until all work is done."""
    failures: list[BaseException] = []
    finished = threading.Event()

    def guarded(number: int) -> None:
        try:
            work(number)
        except BaseException as failure:  # noqa: BLE001 - told in the thread of the test
            failures.append(failure)

    def change() -> None:
        while not finished.is_set():
            meanwhile()

    threads = [threading.Thread(target=guarded, args=(number,)) for number in range(THREADS)]
    changer = threading.Thread(target=change)
    for thread in (changer, *threads):
        thread.start()
    for thread in threads:
        thread.join()
    finished.set()
    changer.join()
    assert not failures


class Executed(threading.local):
    """What the current thread executed."""

    def __init__(self) -> None:
        self.log: list[str] = []


def logging_robot(sleec: Sleec) -> Executed:
    executed = Executed()
    names = sorted(sleec.ruleset.obligations)
    sleec.implement({name: lambda name=name: executed.log.append(name) for name in names})
    return executed


def changes() -> Iterator[dict[str, bool]]:
    while True:
        yield from WHOLE


def dispatches(total: int) -> None:
    sleec = running(RULES)
    executed = logging_robot(sleec)
    contexts = changes()
    seen: list[set[tuple[str, tuple[str, ...]]]] = [set() for _ in range(THREADS)]

    def work(number: int) -> None:
        own, mine, trigger = executed, seen[number], sleec.trigger
        for count in range(total // THREADS):
            name = "ab"[count & 1]
            own.log = []
            done = trigger(name)
            answer = tuple(own.log)
            assert answer == done.obligations
            mine.add((name, answer))

    in_threads(work, lambda: sleec.update(next(contexts)))
    union = set().union(*seen)
    for name, justified in JUSTIFIED.items():
        assert {answer for trigger, answer in union if trigger == name} <= justified
    assert len(union) > len(JUSTIFIED), "the context changed under way"


def test_no_dispatch_sees_half_of_a_change() -> None:
    dispatches(200_000)


@pytest.mark.slow
@pytest.mark.timeout(600)
def test_ten_million_dispatches_see_no_half_of_a_change() -> None:
    dispatches_untraced(10_000_000)


@pytest.mark.long
@pytest.mark.timeout(3600)
def test_a_hundred_million_dispatches_see_no_half_of_a_change() -> None:
    dispatches_untraced(100_000_000)


def dispatches_untraced(total: int) -> None:
    """`dispatches` in a process of its own, where no coverage is measured: that would take many times as long."""
    run = subprocess.run(
        [sys.executable, "-c", UNTRACED, str(total)],
        cwd=ROOT,
        env={name: value for name, value in os.environ.items() if not name.startswith("COVERAGE")},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (run.returncode, run.stderr) == (0, "")


def test_triggers_together_see_one_context() -> None:
    sleec = running(RULES)
    executed = logging_robot(sleec)
    contexts = changes()
    whole = {("o1", "o3", "o5"), ("o2", "o4", "o7"), ("o1", "o3", "o6"), ("o2", "o4", "o5")}

    def work(_: int) -> None:
        for _ in range(1500):
            executed.log = []
            sleec.trigger_all(["a", "b"])
            assert tuple(executed.log) in whole

    in_threads(work, lambda: sleec.update(next(contexts)))


def test_changes_from_many_threads_are_all_made() -> None:
    names = [f"c{number}" for number in range(THREADS)]
    sleec = running(
        "\n".join(f"RULE r{n} WHEN t{n} THEN o1 UNLESS {name} IN WHICH CASE o2" for n, name in enumerate(names))
    )

    def work(number: int) -> None:
        for count in range(1001):
            sleec.update({names[number]: count % 2 == 0})

    in_threads(work, lambda: sleec.due("t0"))
    assert dict(sleec.conditions) == dict.fromkeys(names, True)
    assert all(sleec.due(f"t{number}").obligations == ("o2",) for number in range(THREADS))


def test_a_replaced_ruleset_is_seen_whole() -> None:
    """In the second ruleset the rules say the opposite: no dispatch mixes the two, or sees a context of neither."""
    first = parse("RULE r1 WHEN a THEN o1\nRULE r2 WHEN a THEN o3")
    second = parse("RULE r1 WHEN a THEN o2\nRULE r2 WHEN a THEN o4")
    sleec = Sleec(first)
    executed = Executed()
    sleec.prepare(second)
    sleec.implement({name: lambda name=name: executed.log.append(name) for name in ("o1", "o3")})
    sleec.replace(second, implement={name: lambda name=name: executed.log.append(name) for name in ("o2", "o4")})
    rulesets = [first, second]

    def work(_: int) -> None:
        for _ in range(1500):
            executed.log = []
            sleec.trigger("a")
            assert executed.log in (["o1", "o3"], ["o2", "o4"])

    def replace() -> None:
        rulesets.reverse()
        sleec.replace(rulesets[0])

    in_threads(work, replace)


def test_the_same_on_global_activation_shows_the_race() -> None:
    """By chance, so tried until it shows; test_global_activation.py has the same by design."""
    sleec = running(RULES)
    executed = Executed()
    namespace = {"sleec": sleec, "executed": executed}
    exec(
        """
import contextpy3 as cop

@sleec.rule("r1")
@cop.base
def one(): executed.log.append("o1")

@cop.around(sleec.layers["r1.hc1"])
def one(): executed.log.append("o2")

@sleec.rule("r2")
@cop.base
def two(): executed.log.append("o3")

@cop.around(sleec.layers["r2.hc1"])
def two(): executed.log.append("o4")
""",
        namespace,
    )
    unjustified = threading.Event()
    contexts = changes()

    def work(_: int) -> None:
        for _ in range(200_000):
            if unjustified.is_set():
                return
            executed.log = []
            namespace["one"]()  # type: ignore[operator]
            namespace["two"]()  # type: ignore[operator]
            if tuple(executed.log) not in JUSTIFIED["a"]:
                unjustified.set()

    with sleec.activate_globally():
        in_threads(work, lambda: sleec.update(next(contexts)))
    assert unjustified.is_set()
