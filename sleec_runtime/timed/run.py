"""The run of a dispatch of rules with time: which units run, in which order, and with which results."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from types import CoroutineType

from sleec_runtime.dispatch.plan import Plan
from sleec_runtime.dispatch.variants import Unfinished, Variant, await_under, run_under
from sleec_runtime.errors import NeedsAwait
from sleec_runtime.evaluation.due import Due
from sleec_runtime.model import Obligation
from sleec_runtime.timed.cascade import Stage
from sleec_runtime.timed.clock import Time
from sleec_runtime.timed.progress import Progress
from sleec_runtime.timed.task import Task
from sleec_runtime.timed.unit import Unit


class Run:
    """Runs the units of admitted stages.

    `errors` are the errors with the labels of their rules. `fulfilled` are the obligations that need not start, with
    the labels of their rules. Another execution of the same event has fulfilled them: in another thread, in an inner
    trigger, or for another rule of this dispatch.
    """

    def __init__(self, progress: Progress, stages: Sequence[Stage], now: Time) -> None:
        self.errors: list[tuple[str, BaseException]] = []
        self.fulfilled: list[tuple[str, Obligation]] = []
        self.results: list[object] = []
        self._progress = progress
        self._now = now
        self._stages = deque(stages)
        self._happened: set[str] = set()
        self._served: set[str] = set()
        self._begun: list[Stage] = []
        self._variants: list[Variant] = []

    @property
    def needs_loop(self) -> bool:
        """Whether a remaining unit contains a coroutine function."""
        return any(stage.needs_loop(self._now) for stage in self._stages)

    @property
    def begun(self) -> bool:
        """Whether a stage has begun."""
        return bool(self._begun)

    @property
    def tasks(self) -> list[Task]:
        """The tasks of the stages that have begun."""
        return [task for stage in self._begun for task in stage.tasks]

    def plan(self, triggers: tuple[str, ...], mark: object) -> Plan:
        """The decisions and variants of the stages that have begun."""
        decisions = tuple(decision for stage in self._begun for decision in stage.decisions)
        return Plan(triggers, Due(decisions), tuple(self._variants), mark)

    def go(self, unattended: bool = False) -> None:
        """Runs all units. Errors are kept in `errors`.

        An exception that is not an `Exception`, such as SystemExit, interrupts the run, unless it is `unattended`.
        """
        try:
            for unit in self._units():
                variant = self._begin(unit)
                result: object = None
                error: BaseException | None = None
                try:
                    result = run_under(variant, unit.origin.args, dict(unit.origin.kwargs))
                except BaseException as raised:
                    if not unattended and not isinstance(raised, Exception):
                        raise
                    error = raised
                if type(result) is CoroutineType or type(result) is Unfinished:
                    result.close()
                    error = NeedsAwait(
                        f"a variant of {unit.origin.rule.label} returned a coroutine",
                        "await trigger_async(…) instead; what the clock starts needs an AsyncioClock",
                    )
                self._ended(unit, variant, result, error)
        except BaseException:
            self._abandon()
            raise

    async def go_async(self, unattended: bool = False) -> None:
        """Runs all units as `go` does, and awaits coroutines. A cancellation interrupts the run."""
        try:
            for unit in self._units():
                variant = self._begin(unit)
                result: object = None
                error: BaseException | None = None
                try:
                    result = await await_under(variant, unit.origin.args, dict(unit.origin.kwargs))
                except (Exception, SystemExit, KeyboardInterrupt) as raised:
                    if not unattended and not isinstance(raised, Exception):
                        raise
                    error = raised
                self._ended(unit, variant, result, error)
        except BaseException:
            self._abandon()
            raise

    def _abandon(self) -> None:
        """The run is interrupted: withdraws the stages whose events no longer happen."""
        for stage in self._stages:
            if stage.event is not None and stage.event not in self._happened:
                self._progress.withdraw(stage.tasks)

    def _units(self) -> Iterator[Unit]:
        """The units to run, in order."""
        while self._stages:
            stage = self._stages.popleft()
            # An event happens once at an instant, also if an alternative leads to it again.
            if stage.event is not None and (stage.event not in self._happened or stage.event in self._served):
                self._progress.withdraw(stage.tasks)
                continue
            self._begun.append(stage)
            self._served.update(stage.triggers)
            for task in stage.tasks:
                task.conditional = False
            for unit in stage.units:
                if unit.at <= self._now:
                    yield unit

    def _begin(self, unit: Unit) -> Variant:
        tasks = self._progress.begin(unit)
        if unit.written is None:
            self.fulfilled += [
                (task.origin.rule.label, task.literal)
                for task in unit.tasks
                if task not in tasks and task.state == "done"
            ]
        return unit.variant(tasks, self._did)

    def _did(self, task: Task) -> None:
        """The obligation is done now."""
        self._happened.add(task.name)
        self.errors += [(task.origin.rule.label, error) for error in self._progress.happened(task.name, task)]

    def _ended(self, unit: Unit, variant: Variant, result: object, error: BaseException | None) -> None:
        """A unit has run. If it raised, its open tasks are replaced by their alternatives."""
        self._variants.append(variant)
        self.results.append(result)
        if error is not None:
            self.errors.append((unit.origin.rule.label, error))
        for task in unit.tasks:
            if error is not None:
                self._replace(task)
            elif unit.written is not None and task.name not in unit.origin.instance.takes_time and task.is_open:
                self._did(task)

    def _replace(self, task: Task) -> None:
        try:
            stages = self._progress.failed(task)
        except Exception as error:  # noqa: BLE001 - the refusal of the alternative is kept with the other errors
            self.errors.append((task.origin.rule.label, error))
        else:
            self._stages.extendleft(reversed(stages))
