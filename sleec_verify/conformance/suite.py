"""The conformance test, as a function for pytest and as a function for other uses."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sleec_runtime.errors import SleecError
from sleec_runtime.model import Reading, Ruleset
from sleec_verify.conformance.failure import Nonconformance
from sleec_verify.conformance.subject import Arguments, Bench, Factory, is_timed

if TYPE_CHECKING:
    import hypothesis

Part = Callable[[Bench, int], object]


def _each_rule(bench: Bench, examples: int) -> object:
    if is_timed(bench):
        from sleec_verify.conformance.scenarios.trials import each_rule_in_time

        return each_rule_in_time(bench)
    from sleec_verify.conformance.exhaustive import each_rule

    return each_rule(bench)


def _together(bench: Bench, examples: int) -> None:
    from hypothesis import given

    from sleec_verify.conformance.exhaustive import tried
    from sleec_verify.conformance.simultaneous_triggers import check_simultaneous_triggers
    from sleec_verify.conformance.strategies import contexts

    check_simultaneous_triggers(bench)

    @_settings(examples)
    @given(contexts(bench.oracle().ruleset))
    def any_context(context: Any) -> None:
        # A new instance each time: what one example leaves behind is the business of the part `changes`.
        with bench.running() as running:
            failure = tried(running, context)
        if failure is not None:
            raise failure

    with _repeatable():
        any_context()


def _changes(bench: Bench, examples: int) -> None:
    from sleec_verify.conformance.machine import run_machine

    with _repeatable():
        run_machine(bench, _settings(max(1, examples // 4)))


def _whole_changes(bench: Bench, examples: int) -> object:
    from sleec_verify.conformance.atomicity import whole_changes

    return whole_changes(bench)


def _exceptions(bench: Bench, examples: int) -> object:
    from sleec_verify.conformance.faults import inject_exceptions

    return inject_exceptions(bench)


def _replacement(bench: Bench, examples: int) -> object:
    from sleec_verify.conformance.ruleset_replacement import replaced

    return replaced(bench)


def _threads(bench: Bench, examples: int) -> None:
    from sleec_verify.conformance.machine import run_machine
    from sleec_verify.conformance.threads import in_threads

    in_threads(bench)
    with _repeatable():
        run_machine(bench, _settings(max(1, examples // 10)), threads=True)


def _scenarios(bench: Bench, examples: int) -> None:
    from hypothesis import given

    from sleec_verify.conformance.scenarios.random_scenarios import scenarios
    from sleec_verify.conformance.scenarios.trials import Trials, selected

    selected(bench)
    trials = Trials(bench)

    @_settings(examples)
    @given(scenarios(trials.ruleset))
    def any_scenario(scenario: Any) -> None:
        trials.check(scenario)

    with _repeatable():
        any_scenario()


PARTS: dict[str, Part] = {
    "each-rule": _each_rule,
    "whole-changes": _whole_changes,
    "exceptions": _exceptions,
    "replacement": _replacement,
    "together": _together,
    "changes": _changes,
    "threads": _threads,
    "scenarios": _scenarios,
}
"""The parts of the conformance test in their order: first the fast ones, which find the smallest failures."""

WITH_TIME = ("each-rule", "scenarios")
"""The parts for rules with time. The others are for rules without time, except the part `scenarios`."""


class NondeterministicSubject(SleecError):
    """A subject whose answers differ between runs, so that no smallest failure can be found."""


class UnknownPart(SleecError):
    """A part of the ready test that does not exist."""


def check_conformance(
    make: Factory,
    ruleset: Ruleset | str | Path | None = None,
    *,
    domain: str | None = None,
    reading: Reading | None = None,
    parts: Iterable[str] | None = None,
    watch: Iterable[object] = (),
    arguments: Arguments = (),
    examples: int = 100,
) -> None:
    """Runs the conformance test. Raises `Nonconformance` for the smallest failure, and `SleecError` if the test
    cannot run. The arguments are those of `conformance_test`."""
    bench = _bench(make, ruleset, domain, reading, watch, arguments)
    for name in _applicable(_chosen(parts), bench):
        PARTS[name](bench, examples)


def conformance_test(
    make: Factory,
    ruleset: Ruleset | str | Path | None = None,
    *,
    domain: str | None = None,
    reading: Reading | None = None,
    parts: Iterable[str] | None = None,
    watch: Iterable[object] = (),
    arguments: Arguments = (),
    examples: int = 100,
) -> Callable[[str], None]:
    """A test for pytest, with an item for each of `PARTS`: what is executed is what the rules oblige.

    `make` creates a new instance at each call, with the robot's code bound. `ruleset`, a value or a file, is what it
    must follow, in `domain` and `reading`; by default, those of the instance. `watch` are objects and modules that
    implement obligations and are not bound. `arguments` are given to each trigger; they may be a function of the
    triggers. `examples` sets the size of the random parts, and `parts` selects the parts.

    Raises `UnknownPart`. pytest collects the parts that apply to the rules; nothing is loaded or created before that.
    """
    import pytest

    watched = tuple(watch)

    def bench() -> Bench:
        return _bench(make, ruleset, domain, reading, watched, arguments)

    @pytest.mark.parametrize("part", _Parts(_chosen(parts), bench))
    def test_conformance(part: str) -> None:
        __tracebackhide__ = True
        try:
            PARTS[part](bench(), examples)
        except (Nonconformance, SleecError) as error:
            message = str(error)
        else:
            return
        pytest.fail(message, pytrace=False)

    return test_conformance


@contextmanager
def _repeatable() -> Iterator[None]:
    """Report failures that do not repeat. An unrepeatable failure is still a failure."""
    from hypothesis.errors import Flaky

    try:
        yield
    except Flaky as flaky:
        for error in getattr(flaky, "exceptions", ()):
            if isinstance(error, Nonconformance):
                raise error.after([*error.before, "(not every time: a repetition passed)"]) from None
        raise NondeterministicSubject(
            "the robot does not always behave the same in the same situation", str(flaky)
        ) from None


class _Parts(Collection[str]):
    """The chosen parts that apply to the rules, which are read when pytest collects the test."""

    def __init__(self, chosen: list[str], bench: Callable[[], Bench]) -> None:
        self._chosen = chosen
        self._bench = bench

    @cached_property
    def _found(self) -> list[str]:
        try:
            return _applicable(self._chosen, self._bench())
        except Exception:  # noqa: BLE001 - each part fails with it
            return self._chosen

    def __iter__(self) -> Iterator[str]:
        return iter(self._found)

    def __len__(self) -> int:
        return len(self._found)

    def __contains__(self, part: object) -> bool:
        return part in self._found


def _applicable(chosen: list[str], bench: Bench) -> list[str]:
    """The parts that apply to the rules of a bench."""
    timed = is_timed(bench)
    return [name for name in chosen if (name in WITH_TIME if timed else name != "scenarios")]


def _chosen(parts: Iterable[str] | None) -> list[str]:
    if parts is None:
        return list(PARTS)
    chosen = list(parts)
    for name in chosen:
        if name not in PARTS:
            raise UnknownPart(f"the conformance test has no part {name!r}", f"it has {', '.join(PARTS)}")
    return chosen


def _bench(
    make: Factory,
    ruleset: Ruleset | str | Path | None,
    domain: str | None,
    reading: Reading | None,
    watch: Iterable[object],
    arguments: Arguments,
) -> Bench:
    if isinstance(ruleset, (str, Path)):
        from sleec_runtime.language import load

        ruleset = load(ruleset)
    return Bench(make, ruleset, domain, reading, tuple(watch), arguments)


def _settings(examples: int) -> hypothesis.settings:
    from hypothesis import HealthCheck, Phase, settings

    # How long an example takes is the robot's affair, and a ruleset may well make large ones. Hypothesis's own
    # explanations cost more than the search, and the report says more.
    phases = [phase for phase in Phase if phase is not Phase.explain]
    return settings(
        max_examples=examples,
        deadline=None,
        suppress_health_check=list(HealthCheck),
        phases=phases,
        report_multiple_bugs=False,
        print_blob=False,
        stateful_step_count=25,
    )
