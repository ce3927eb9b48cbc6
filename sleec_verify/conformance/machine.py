"""A Hypothesis state machine: changes and triggers in any order, and triggers and changes during triggers."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from typing import Any

from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, rule

from sleec_runtime.model import Context, Value
from sleec_verify.conformance import strategies
from sleec_verify.conformance.failure import Nonconformance, difference, situation_text
from sleec_verify.conformance.subject import Bench, Observation
from sleec_verify.wording.phrases import value_text


def state_machine(bench: Bench, *, threads: bool = False) -> type[RuleBasedStateMachine]:
    """The machine for one bench. Its `TestCase` is a test, and `run_state_machine_as_test` runs it. With `threads`,
    other threads make some of the changes and triggers, one at a time, so that each run can be repeated."""
    oracle = bench.oracle()
    ruleset = oracle.ruleset
    triggers = sorted(oracle.whole.triggers)
    some = st.lists(st.sampled_from(triggers), min_size=1, max_size=3, unique=True) if triggers else st.just([])
    contexts = strategies.contexts(ruleset)
    changes = strategies.changes(ruleset)

    class Changes(RuleBasedStateMachine):
        """One subject, and its changes and triggers."""

        def __init__(self) -> None:
            super().__init__()
            self._open = ExitStack()
            self._running = self._open.enter_context(bench.running())
            self._steps: list[str] = []

        @rule(changes=changes)
        def change(self, changes: dict[str, Value | None]) -> None:
            """Some values change, and others become unknown."""
            self._steps.append(f"change: {_changes_text(changes)}")
            self._running.change(changes)

        @rule(context=contexts)
        def enter(self, context: Context) -> None:
            """A situation that the assumptions allow, as one change, and its triggers."""
            self._running.enter(context)
            self._steps.append(f"change to: {situation_text(Context(frozenset(), context.conditions))}")
            self._trigger(sorted(context.triggers))

        @rule(names=some)
        def trigger(self, names: Sequence[str]) -> None:
            """One or several triggers occur."""
            self._trigger(names)

        @rule(outer=some, inner=some, changes=changes)
        def trigger_within_a_trigger(
            self, outer: Sequence[str], inner: Sequence[str], changes: dict[str, Value | None]
        ) -> None:
            """While the first obligation of a trigger is executed, the context changes and another trigger occurs."""
            failures: list[Nonconformance] = []
            inside = False

            def meanwhile(name: str) -> object:
                nonlocal inside
                if not inside:
                    inside = True
                    self._steps.append(
                        f"trigger {', '.join(outer)}; while {name} is executed: {_changes_text(changes)}"
                    )
                    self._running.change(changes)
                    context = self._running.here(inner)
                    return self._running.observe_within(
                        inner, lambda observed: failures.extend(self._compared(inner, context, observed))
                    )
                return None

            here = self._running.here(outer)
            observed = self._running.observe(outer, meanwhile)
            for failure in (*failures, *self._compared(outer, here, observed)):
                raise failure

        def _trigger(self, names: Sequence[str]) -> None:
            for failure in self._compared(names, self._running.here(names), None):
                raise failure
            self._steps.append(f"trigger {', '.join(names)}")

        def _compared(
            self, names: Sequence[str], context: Context, observed: Observation | None
        ) -> list[Nonconformance]:
            """What is wrong with an observation; without one, the triggers occur now."""
            if observed is None:
                observed = self._running.observe(names)
            expected = oracle.expected(context)
            what = difference(context, expected, observed, oracle.whole)
            return [] if what is None else [Nonconformance(context, expected, observed, what, list(self._steps))]

        def teardown(self) -> None:
            self._open.close()

    class Threads(Changes):
        """The same, with steps in a new thread or in one that made earlier steps."""

        def __init__(self) -> None:
            super().__init__()
            self._old = self._open.enter_context(ThreadPoolExecutor(1))

        @rule(changes=changes, new=st.booleans())
        def change_elsewhere(self, changes: dict[str, Value | None], new: bool) -> None:
            """Another thread reports a change."""
            self._steps.append(f"{_thread(new)}: change: {_changes_text(changes)}")
            self._elsewhere(new, lambda: self._running.change(changes))

        @rule(names=some, new=st.booleans())
        def trigger_elsewhere(self, names: Sequence[str], new: bool) -> None:
            """One or several triggers occur in another thread."""
            observed: list[Observation] = []
            self._elsewhere(new, lambda: observed.append(self._running.observe(names)))
            self._steps.append(f"{_thread(new)}: trigger {', '.join(names)}")
            # The solver is this thread's.
            for failure in self._compared(names, self._running.here(names), observed[0]):
                raise failure

        def _elsewhere(self, new: bool, work: Callable[[], object]) -> None:
            if new:
                with ThreadPoolExecutor(1) as pool:
                    pool.submit(work).result()
            else:
                self._old.submit(work).result()

    return Threads if threads else Changes


def run_machine(bench: Bench, settings: Any, *, threads: bool = False) -> None:
    """Runs the machine. Raises the smallest Nonconformance that Hypothesis finds."""
    from hypothesis.stateful import run_state_machine_as_test

    run_state_machine_as_test(state_machine(bench, threads=threads), settings=settings)  # type: ignore[no-untyped-call]


def _thread(new: bool) -> str:
    return "in a new thread" if new else "in another thread"


def _changes_text(changes: Mapping[str, Value | None]) -> str:
    facts = (f"{name} is {'not known' if value is None else value_text(value)}" for name, value in changes.items())
    return ", ".join(facts) or "nothing changes"
