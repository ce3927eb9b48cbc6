"""Atomic changes of context: triggers during a change, and after a rejected one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from sleec_runtime.model import Context
from sleec_verify.conformance.distinguishing_pairs import ContextPair, pairs
from sleec_verify.conformance.exhaustive import tried
from sleec_verify.conformance.failure import Nonconformance, difference, situation_text
from sleec_verify.conformance.feasible_contexts import Assumptions
from sleec_verify.conformance.subject import Bench, Observation, Running

PAIRS = 12


class _Looking(Mapping[str, object]):
    """Changes during which triggers occur: one between each two of their values."""

    def __init__(self, changes: Mapping[str, object], look: Callable[[], object]) -> None:
        self._changes = changes
        self._look = look

    def __getitem__(self, name: str) -> object:
        self._look()
        return self._changes[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._changes)

    def __len__(self) -> int:
        return len(self._changes)


def whole_changes(bench: Bench) -> int:
    """Raises `Nonconformance` if a part of a change is visible. Returns the number of tested changes."""
    oracle = bench.oracle()
    found = pairs(oracle, Assumptions(oracle.ruleset))[:PAIRS]
    for pair in found:
        with bench.running() as running:
            _in_the_midst(running, pair)
            _refused(running, pair)
    return len(found)


def justified_by_one(pair: ContextPair, observed: Observation, running: Running, when: str) -> None:
    """Raises `Nonconformance` unless the observation is due in one of the two contexts."""
    whole = running.oracle.whole
    contexts = (pair.before, pair.after)
    expected = [running.oracle.expected(context) for context in contexts]
    if all(difference(context, due, observed, whole) for context, due in zip(contexts, expected)):
        raise Nonconformance(
            pair.before,
            expected[0],
            observed,
            f"{when}, did what neither the context before nor the context after requires",
            [
                f"a change to: {situation_text(pair.after)}",
                f"which requires: {', '.join(expected[1].due) or 'nothing'}",
            ],
        )


def _in_the_midst(running: Running, pair: ContextPair) -> None:
    running.enter(pair.before)
    looking = False

    def look() -> None:
        nonlocal looking
        if not looking:
            looking = True
            justified_by_one(pair, running.observe(pair.triggers), running, "during a change of context")
            looking = False

    changes = running.way_to(pair.after)
    running.subject.update(_Looking(changes, look))
    running.note(changes)
    _must_be(running, pair.after, "after that change")


def _refused(running: Running, pair: ContextPair) -> None:
    """A change with one invalid part changes nothing."""
    running.enter(pair.before)
    changes = running.way_to(pair.after)
    *good, bad = changes
    try:
        running.subject.update({**{name: changes[name] for name in good}, bad: object()})
    except Exception:  # noqa: BLE001 - whatever it raises, it refused
        _must_be(running, pair.before, f"after a change that was rejected because of {bad}")
        return
    expected = running.oracle.expected(pair.before)
    observed = Observation(())
    raise Nonconformance(pair.before, expected, observed, f"accepted an object() as the value of {bad}")


def _must_be(running: Running, context: Context, when: str) -> None:
    failure = tried(running, context)
    if failure is not None:
        raise failure.after([when])
