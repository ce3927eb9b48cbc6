"""Measure a dispatch and a change of context, and how they grow with the number of rules.

    python -m benchmarks.runtime_dispatch [--quick] [--json]

Each figure is for single calls, without the cost of the clock. Ratios are printed with their bounds. Calls that are
compared alternate within one run, so that a load on the machine affects all of them.
"""

# ruff: noqa: F811 - the variants of a method share its name
# mypy: disable-error-code="no-redef,untyped-decorator"

from __future__ import annotations

import argparse
import gc
import json
import sys
from collections.abc import Callable, Sequence
from functools import partial
from statistics import median, quantiles
from time import perf_counter_ns
from typing import Any, NamedTuple

import contextpy3 as cop

from sleec_runtime import Monitor, Sleec, VirtualClock
from sleec_runtime.language import parse
from sleec_runtime.model import Atom, Clause, Obligation, Rule, Ruleset

SIZES = (1, 10, 100, 1_000, 10_000)
MENTIONS = (1, 10, 100, 1_000)


class Timing(NamedTuple):
    """Microseconds."""

    median: float
    p90: float
    p99: float


class Bound(NamedTuple):
    """A ratio and its upper (or lower) bound."""

    what: str
    ratio: float
    sign: str
    limit: float

    @property
    def kept(self) -> bool:
        return self.ratio <= self.limit if self.sign == "<=" else self.ratio >= self.limit


def measured(calls: dict[str, Callable[[], object]], rounds: int, batch: int = 20) -> dict[str, Timing]:
    """Measure each of `calls` alternately, in `rounds` batches."""
    samples: dict[str, list[int]] = {name: [] for name in calls}
    gc.disable()
    for _ in range(rounds):
        for name, call in calls.items():
            into = samples[name].append
            call()
            for _ in range(batch):
                start = perf_counter_ns()
                call()
                into(perf_counter_ns() - start)
        gc.collect(0)
    gc.enable()
    clock = _cost_of_clock()
    return {name: _timing(values, clock) for name, values in samples.items()}


def _cost_of_clock() -> int:
    costs = []
    for _ in range(2_000):
        start = perf_counter_ns()
        costs.append(perf_counter_ns() - start)
    return int(median(costs))


def _timing(nanoseconds: Sequence[int], clock: int) -> Timing:
    cuts = quantiles(nanoseconds, n=100)
    return Timing(*((cut - clock) / 1000 for cut in (cuts[49], cuts[89], cuts[98])))


# What is measured -----------------------------------------------------------------------------------------


def rules(size: int, mentioning: int = 1) -> Ruleset:
    """`size` rules, each with its own trigger and two hedges. The first `mentioning` rules mention c0."""

    def clause(condition: str | None, obligation: str) -> Clause:
        return Clause(None if condition is None else Atom("condition", condition), (Obligation(obligation),))

    return Ruleset(
        tuple(
            Rule(
                f"r{i}",
                f"t{i}",
                None,
                clause(None, "base"),
                (clause("c0" if i < mentioning else f"c{i}", "one"), clause(f"d{i}", "two")),
            )
            for i in range(size)
        )
    )


def robot(sleec: Sleec) -> Any:
    """A class with the method of rule r0, in three variants that do nothing."""

    class Robot:
        @sleec.rule("r0")
        @cop.base
        def m0(self, message: object) -> None: ...

        @cop.around(sleec.layers["r0.hc1"])
        def m0(self, message: object) -> None: ...

        @cop.around(sleec.layers["r0.hc2"])
        def m0(self, message: object) -> None: ...

    return Robot


class IfElse:
    """The decisions of rule r0, written by hand."""

    def __init__(self) -> None:
        self.conditions = {"c0": True, "d0": False}

    def base(self, message: object) -> None: ...

    def one(self, message: object) -> None: ...

    def two(self, message: object) -> None: ...

    def trigger(self, message: object) -> None:
        if self.conditions["c0"]:
            if self.conditions["d0"]:
                self.two(message)
            else:
                self.one(message)
        else:
            self.base(message)


def toggling(sleec: Sleec) -> Callable[[], object]:
    """A function that changes condition c0."""
    state = {"c0": False}

    def toggle() -> None:
        state["c0"] = not state["c0"]
        sleec.update(state)

    return toggle


def running(size: int, mentioning: int = 1) -> tuple[Sleec, Any]:
    sleec = Sleec(rules(size, mentioning))
    instance = robot(sleec)()
    sleec.bind(instance)
    return sleec, instance


def by_size(rounds: int) -> tuple[dict[str, Timing], list[Bound]]:
    """One dispatch with 1 to 10,000 rules, compared with a ContextPy3 call without an active layer."""
    calls: dict[str, Callable[[], object]] = {}
    _, bare = running(1)
    calls["ContextPy3 call, no layer active"] = partial(bare.m0, None)
    calls["if-else with the same decisions"] = partial(IfElse().trigger, None)
    for size in SIZES:
        sleec, _ = running(size)
        sleec.update({"c0": True})
        calls[f"dispatch, {size:,} rules loaded"] = partial(sleec.trigger, "t0", None)
    timings = measured(calls, rounds)
    one, most = (timings[f"dispatch, {size:,} rules loaded"].median for size in (SIZES[0], SIZES[-1]))
    bare_call = timings["ContextPy3 call, no layer active"].median
    return timings, [
        Bound("dispatch, 10,000 rules : 1 rule", most / one, "<=", 1.3),
        Bound("dispatch : bare ContextPy3 call", most / bare_call, "<=", 1.0),
        Bound("dispatch : if-else", one / timings["if-else with the same decisions"].median, "<=", 12.0),
    ]


def against_global_activation(rounds: int) -> tuple[dict[str, Timing], list[Bound]]:
    """A dispatch with 1,000 rules whose hedges are active, compared with a call with all layers globally active."""
    sleec, instance = running(1_000, mentioning=1_000)
    sleec.update({"c0": True})
    with sleec.activate_globally():
        timings = measured(
            {
                "dispatch, 1,000 rules active": partial(sleec.trigger, "t0", None),
                "call, 1,000 layers globally active": partial(instance.m0, None),
            },
            rounds // 10,
        )
    globally, dispatched = (timings[name].median for name in reversed(timings))
    return timings, [Bound("global activation : dispatch", globally / dispatched, ">=", 100)]


def change_and_dispatch(rounds: int) -> tuple[dict[str, Timing], list[Bound]]:
    """A change of the context and then a dispatch, compared with bare ContextPy3 calls."""
    _, bare = running(1)
    calls: dict[str, Callable[[], object]] = {"a ContextPy3 call": partial(bare.m0, None)}

    def both(sleec: Sleec) -> Callable[[], object]:
        toggle = toggling(sleec)

        def change_and_trigger() -> None:
            toggle()
            sleec.trigger("t0", None)

        return change_and_trigger

    for size in SIZES:
        calls[f"change and dispatch, {size:,} rules"] = both(running(size)[0])
    timings = measured(calls, rounds)
    one, most = (timings[f"change and dispatch, {size:,} rules"].median for size in (SIZES[0], SIZES[-1]))
    return timings, [
        Bound("change and dispatch : ContextPy3 call", one / timings["a ContextPy3 call"].median, "<=", 3.0),
        Bound("change and dispatch, 10,000 rules : 1 rule", most / one, "<=", 2.0),
    ]


def changes(rounds: int) -> tuple[dict[str, Timing], list[Bound]]:
    """A change of one condition that 1 to 1,000 of 10,000 rules mention, and that 1 rule of 1 to 10,000 mentions."""
    calls: dict[str, Callable[[], object]] = {}

    for mentioning in MENTIONS:
        calls[f"change, 10,000 rules, {mentioning:,} mention it"] = toggling(running(10_000, mentioning)[0])
    for size in SIZES[:-1]:
        calls[f"change, {size:,} rules, 1 mentions it"] = toggling(running(size)[0])
    timings = measured(calls, rounds // 20)
    one, most = (timings[f"change, 10,000 rules, {m:,} mention it"].median for m in (MENTIONS[0], MENTIONS[-1]))
    alone = timings["change, 1 rules, 1 mentions it"].median
    return timings, [
        Bound("change that 1,000 rules mention : 1,000 changes that 1 does", most / (1_000 * one), "<=", 1.0),
        Bound("change, 1 of 10,000 rules : the only rule", one / alone, "<=", 2.0),
    ]


def monitored(rounds: int) -> tuple[dict[str, Timing], list[Bound]]:
    """The cost of the monitor in a dispatch that executes one obligation."""
    sleec = Sleec(rules(1))
    sleec.implement({name: lambda message: None for name in ("base", "one", "two")})
    watched = Sleec(rules(1))
    watched.implement({name: lambda message: None for name in ("base", "one", "two")})
    with Monitor(watched, print):
        timings = measured(
            {
                "dispatch to callables": partial(sleec.trigger, "t0", None),
                "the same, monitored": partial(watched.trigger, "t0", None),
            },
            rounds,
        )
    return timings, []


def with_times(rounds: int) -> tuple[dict[str, Timing], list[Bound]]:
    """The cost of a window: an obligation that is watched, and met at once."""
    calls: dict[str, Callable[[], object]] = {}
    for what, window in (("no window in the ruleset", ""), ("done at once in a window", " WITHIN 5 minutes")):
        sleec = Sleec(parse(f"RULE r WHEN A THEN X{window}"), clock=VirtualClock())
        sleec.implement({"X": lambda message: None})
        calls[f"dispatch, {what}"] = partial(sleec.trigger, "A", None)
    return measured(calls, rounds), []


def main(arguments: Sequence[str] = ()) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="a tenth of the calls")
    parser.add_argument("--json", action="store_true", help="print the figures as JSON")
    options = parser.parse_args(arguments)
    rounds = 100 if options.quick else 1_000
    timings: dict[str, Timing] = {}
    bounds: list[Bound] = []
    for part in (by_size, change_and_dispatch, against_global_activation, changes, monitored, with_times):
        more, of_these = part(rounds)
        timings.update(more)
        bounds += of_these
    if options.json:
        figures = {
            "microseconds": {name: timing._asdict() for name, timing in timings.items()},
            "ratios": [{**bound._asdict(), "kept": bound.kept} for bound in bounds],
        }
        print(json.dumps(figures, indent=2))
    else:
        print(f"{'microseconds':44} {'median':>9} {'90 %':>9} {'99 %':>9}")
        for name, timing in timings.items():
            print(f"{name:44} {timing.median:9.2f} {timing.p90:9.2f} {timing.p99:9.2f}")
        print()
        for bound in bounds:
            verdict = "" if bound.kept else "   NOT KEPT"
            print(f"{bound.what:60} {bound.ratio:8.2f}   ({bound.sign} {bound.limit:g}){verdict}")
    return 0 if all(bound.kept for bound in bounds) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
