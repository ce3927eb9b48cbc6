"""What the clock starts and ends."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from math import floor
from typing import TYPE_CHECKING

from sleec_runtime.errors import DeadlineMissed, Prohibited
from sleec_runtime.timed.agenda import CLOSES
from sleec_runtime.timed.failures import Failure, Failures, raise_interrupt
from sleec_runtime.timed.instants import Instant
from sleec_runtime.timed.stages import Stage, in_place_of, opened
from sleec_runtime.timed.words import duration_in_words

if TYPE_CHECKING:
    from asyncio import AbstractEventLoop

    from sleec_runtime.timed.clocks import Time
    from sleec_runtime.timed.executor import Execute
    from sleec_runtime.timed.keeper import Timekeeper
    from sleec_runtime.timed.ledger import Ledger
    from sleec_runtime.timed.run import Run
    from sleec_runtime.timed.tasks import Task
    from sleec_runtime.timed.units import Unit


class Starts:
    """Starts, by `execute`, what opens, and what is due because something closes undone. What goes wrong is reported to
    `failures`, and not raised: only a KeyboardInterrupt in the main thread is both."""

    def __init__(self, keeper: Timekeeper, ledger: Ledger, failures: Failures, execute: Execute) -> None:
        self._keeper = keeper
        self._ledger = ledger
        self._failures = failures
        self._execute = execute
        self._instant = Instant(ledger.clock.now())
        self._running: set[object] = set()

    def tick(self) -> None:
        """Starts and ends all that is due by now."""
        interrupt = None
        while True:
            with self._ledger.lock:
                next_one = self._ledger.next_call()
            if next_one is None:
                break
            at, call = next_one
            try:
                call(at)
            except KeyboardInterrupt as error:
                interrupt = error
        if interrupt is not None:
            raise interrupt

    def open(self, unit: Unit, at: Time) -> None:
        """Its window opens."""
        with self._ledger.lock:
            start = self._admit(opened(unit, self._keeper.moment().snapshot), unit.tasks, at)
        start()

    def close(self, task: Task, at: Time) -> None:
        """Its window closes, and it is not done."""
        with self._ledger.lock:
            if not task.is_open:
                return
            alternatives = task.otherwise
            if alternatives is None and task.instead is not None and self._still_possible(task.instead):
                alternatives = task.instead
            self._ledger.end(task, "missed" if alternatives is None else "replaced")
            start = self._admit_in_place_of(task, alternatives or (), at)
        if alternatives is None:
            self.miss(task)
        start()

    def miss(self, task: Task) -> None:
        """Reports that its window has closed, and it is not done."""
        assert task.last is not None, "what has no end does not close"
        length = duration_in_words(task.last - task.origin.moment)
        message = f"{task.name} was not done within {length} of the trigger of rule {task.origin.rule.label}"
        self._fail((task,), DeadlineMissed(message, task.name, task.last))

    def _still_possible(self, tasks: Iterable[Task]) -> bool:
        now = self._ledger.clock.now()
        return all(
            not task.literal.negated and not task.at_once and (task.last is None or task.last >= now) for task in tasks
        )

    def close_prohibition(self, task: Task, at: Time) -> None:
        """Its window closes. It forbids to the end of that moment, and is then over."""
        assert task.last is not None, "what has no end does not close"
        with self._ledger.lock:
            self._ledger.agenda.schedule(floor(task.last) + 1, CLOSES, (task,), partial(self._end_locked, task))
            alternatives = task.otherwise if task.otherwise is not None else task.instead
            broken, task.broken = task.broken, False
            start = self._admit_in_place_of(task, alternatives if broken and alternatives else (), at)
        start()

    def _end_locked(self, task: Task, at: Time) -> None:
        with self._ledger.lock:
            self._ledger.end(task, "over")

    def _admit_in_place_of(self, task: Task, alternatives: tuple[Task, ...], at: Time) -> Callable[[], object]:
        """As `_admit`, for what is due in the place of `task`. In one step, under the lock, with the end of `task`: at
        no time is neither of them pending."""
        if not alternatives:
            return _nothing
        return self._admit(in_place_of(task, alternatives, self._keeper.moment().snapshot), alternatives, at)

    def _admit(self, stage: Stage, tasks: Sequence[Task], at: Time) -> Callable[[], object]:
        """Puts what is due now on the agenda; what it returns starts it. What is forbidden now is started once it no
        longer is, if its window lasts."""
        loop = _running_loop()
        try:
            if self._instant.at != at:
                self._instant = Instant(at)
            run = self._admit_when_allowed(stage, self._instant, in_loop=loop is not None)
        except Exception as error:  # noqa: BLE001 - reported
            return partial(self._give_up, tasks, error, at)
        if run is None:
            return _nothing
        if loop is not None and run.asynchronous:
            return partial(self._spawn, loop, run, stage)
        return partial(self._execute, partial(self._go, run, stage), partial(self._fail, stage.tasks))

    def _admit_when_allowed(self, stage: Stage, instant: Instant, in_loop: bool) -> Run | None:
        moment = self._keeper.moment()
        try:
            stages = self._keeper.closure(stage, moment)
            instant.refuse(stages, moment.now)
            run = self._keeper.admit(stages, moment.now, in_loop)
            instant.note(stages, moment.now)
            return run
        except Prohibited as refusal:
            again = refusal.over
            late = [unit for unit in stage.units if unit.at <= moment.now]
            if again is None or any(task.at_once for unit in late for task in unit.tasks):
                raise
            for unit in late:
                unit.at = again
            # With nothing that starts now, only what it forbids itself can be refused.
            stages = self._keeper.closure(stage, moment)
            instant.refuse(stages, moment.now)
            self._keeper.admit(stages, moment.now, in_loop)
            instant.note(stages, moment.now)
            return None

    def _go(self, run: Run, stage: Stage) -> None:
        try:
            run.go(unattended=True)
        except BaseException as error:
            self._fail(stage.tasks, error)
            raise
        finally:
            self._report(run, stage)

    async def _finish(self, run: Run, stage: Stage) -> None:
        try:
            await run.go_async(unattended=True)
        except BaseException as error:
            self._fail(stage.tasks, error)
            raise
        finally:
            self._report(run, stage)

    def _spawn(self, loop: AbstractEventLoop, run: Run, stage: Stage) -> None:
        task = loop.create_task(self._finish(run, stage))
        # The loop itself holds its tasks but weakly.
        self._running.add(task)
        task.add_done_callback(self._running.discard)

    def _report(self, run: Run, stage: Stage) -> None:
        for label, error in run.errors:
            self._failures(Failure(self._ledger.clock.now(), label, tuple(task.name for task in stage.tasks), error))
        for _, error in run.errors:
            raise_interrupt(error)

    def _give_up(self, tasks: Sequence[Task], error: Exception, at: Time) -> None:
        """What was to be started now is not. What has a window stays due until that closes."""
        self._fail(tasks, error)
        for task in tasks:
            with self._ledger.lock:
                watched = task in self._ledger.agenda.to_do(task.name)
                if watched and not task.at_once:
                    task.unit = None
                    continue
                alternatives = task.otherwise if task.at_once and watched else None
                self._ledger.end(task, "missed" if alternatives is None else "replaced")
                start = self._admit_in_place_of(task, alternatives or (), at)
            start()

    def _fail(self, tasks: Sequence[Task], error: BaseException) -> None:
        label = tasks[0].origin.rule.label
        self._failures(Failure(self._ledger.clock.now(), label, tuple(task.name for task in tasks), error))


def _nothing() -> None:
    """There is nothing to start."""


def _running_loop() -> AbstractEventLoop | None:
    """The event loop of this thread, if one is running; asyncio is not imported to find that there is none."""
    asyncio = sys.modules.get("asyncio")
    if asyncio is None:
        return None
    try:
        loop: AbstractEventLoop = asyncio.get_running_loop()
    except RuntimeError:
        return None
    return loop
