"""One dispatch of rules with times: what runs, in which order, and what comes of it."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from types import CoroutineType
from typing import TYPE_CHECKING

from sleec_runtime.dispatch.dispatch import Done, Plan
from sleec_runtime.dispatch.instance import Unfinished
from sleec_runtime.dispatch.layers import Variant, await_under, run_all
from sleec_runtime.errors import NeedsAwait
from sleec_runtime.evaluation.evaluation import Due

if TYPE_CHECKING:
    from sleec_runtime.dispatch.snapshot import Snapshot
    from sleec_runtime.model import Obligation
    from sleec_runtime.timed.cascade import Stage
    from sleec_runtime.timed.clocks import Time
    from sleec_runtime.timed.execution_plan import Unit
    from sleec_runtime.timed.lifecycle import Lifecycle
    from sleec_runtime.timed.pending import Pending
    from sleec_runtime.timed.tasks import Task


class TimedDone(Done):
    """What one dispatch of rules with times did, and what of it is not over."""

    __slots__ = ("_tasks", "_view")

    def __init__(
        self,
        plan: Plan,
        snapshot: Snapshot,
        results: Sequence[object],
        tasks: Sequence[Task],
        view: Callable[[Iterable[Task]], tuple[Pending, ...]],
    ) -> None:
        super().__init__(plan, snapshot, results)
        self._tasks = tasks
        self._view = view

    @property
    def due(self) -> tuple[Pending, ...]:
        return self._view(self._tasks)

    def explain(self) -> str:
        return "\n".join([super().explain(), *map(str, self.due)])


class Run:
    """The stages of a dispatch, which have been checked and are on the agenda. It is over when `units` is.

    Whoever runs it takes each unit, runs it, and says with `ended` what came of it. `errors` has what was raised, with
    the labels of the rules. `fulfilled` lists the obligations that are not started, because another execution of the
    same event has fulfilled them: that of another thread, of an inner trigger, or of another rule of this dispatch.
    Each is with the label of its rule.
    """

    def __init__(self, lifecycle: Lifecycle, stages: Sequence[Stage], now: Time) -> None:
        self.errors: list[tuple[str, BaseException]] = []
        self.fulfilled: list[tuple[str, Obligation]] = []
        self._lifecycle = lifecycle
        self._now = now
        self._stages = deque(stages)
        self._happened: set[str] = set()
        self._begun: list[Stage] = []
        self._variants: list[Variant] = []
        self._results: list[object] = []

    @property
    def asynchronous(self) -> bool:
        """Whether something in it is known to need an event loop."""
        return any(unit.asynchronous for stage in self._stages for unit in stage.units if unit.at <= self._now)

    @property
    def begun(self) -> bool:
        """Whether a stage of it has been begun."""
        return bool(self._begun)

    def units(self) -> Iterator[Unit]:
        """What to run, one after the other."""
        while self._stages:
            stage = self._stages.popleft()
            if stage.event is not None and stage.event not in self._happened:
                self._lifecycle.withdraw(stage.tasks)
                continue
            self._begun.append(stage)
            for task in stage.tasks:
                task.conditional = False
            for unit in stage.units:
                if unit.at <= self._now:
                    yield unit

    def go(self, unattended: bool = False) -> None:
        """Runs all units. An exception that is no `Exception`, such as SystemExit, interrupts this; if it is
        `unattended`, it is kept like the others."""
        try:
            for unit in self.units():
                variant = self._begin(unit)
                result: object = None
                error: BaseException | None = None
                try:
                    (result,), errors = run_all((variant,), unit.origin.args, dict(unit.origin.kwargs))
                    error = errors[0][1] if errors else None
                except BaseException as raised:
                    if not unattended:
                        raise
                    error = raised
                if type(result) is CoroutineType or type(result) is Unfinished:
                    result.close()
                    error = NeedsAwait(
                        f"a variant of {unit.origin.rule.label} returned a coroutine",
                        "await trigger_async(…) instead; what the clock starts needs an AsyncioClock",
                    )
                self.ended(unit, variant, result, error)
        except BaseException:
            self._abandon()
            raise

    async def go_async(self, unattended: bool = False) -> None:
        """Runs all units as `go` does, awaiting those that are coroutines. What cancels a coroutine interrupts this."""
        try:
            for unit in self.units():
                variant = self._begin(unit)
                result: object = None
                error: BaseException | None = None
                try:
                    result = await await_under(variant, unit.origin.args, dict(unit.origin.kwargs))
                except (Exception, SystemExit, KeyboardInterrupt) as raised:
                    if not unattended and not isinstance(raised, Exception):
                        raise
                    error = raised
                self.ended(unit, variant, result, error)
        except BaseException:
            self._abandon()
            raise

    def _abandon(self) -> None:
        """It is interrupted: what the rest would be called for by does not happen."""
        for stage in self._stages:
            if stage.event is not None and stage.event not in self._happened:
                self._lifecycle.withdraw(stage.tasks)

    def _begin(self, unit: Unit) -> Variant:
        tasks = self._lifecycle.begin(unit)
        if unit.written is None:
            self.fulfilled += [
                (task.origin.rule.label, task.literal)
                for task in unit.tasks
                if task not in tasks and task.state == "done"
            ]
        return unit.variant(tasks, self.did)

    def did(self, task: Task) -> None:
        """The obligation is done, now."""
        self._happened.add(task.name)
        self.errors += [(task.origin.rule.label, error) for error in self._lifecycle.happened(task.name, task)]

    def ended(self, unit: Unit, variant: Variant, result: object, error: BaseException | None) -> None:
        """A unit has run. What it left undone, because it raised, may have something in its place."""
        self._variants.append(variant)
        self._results.append(result)
        if error is not None:
            self.errors.append((unit.origin.rule.label, error))
        for task in unit.tasks:
            if error is not None:
                self._replace(task)
            elif unit.written is not None and task.name not in unit.origin.instance.takes_time and task.is_open:
                self.did(task)

    def _replace(self, task: Task) -> None:
        try:
            stages = self._lifecycle.failed(task)
        except Exception as error:  # noqa: BLE001 - the alternative was refused, and is kept with the others
            self.errors.append((task.origin.rule.label, error))
        else:
            self._stages.extendleft(reversed(stages))

    def done(
        self,
        triggers: tuple[str, ...],
        snapshot: Snapshot,
        view: Callable[[Iterable[Task]], tuple[Pending, ...]],
    ) -> TimedDone:
        """What it did, if nothing was raised. `view` shows users what of it is not over."""
        decisions = tuple(decision for stage in self._begun for decision in stage.decisions)
        plan = Plan(triggers, Due(decisions), tuple(self._variants), snapshot.mark)
        tasks = [task for stage in self._begun for task in stage.tasks]
        return TimedDone(plan, snapshot, self._results, tasks, view)
