"""Timer events: what happens when windows open and close."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from math import floor
from typing import TYPE_CHECKING

from sleec_runtime.errors import DeadlineMissed, Prohibited, Reentrant
from sleec_runtime.timed.admission import Admission
from sleec_runtime.timed.agenda import ENDS, Entry
from sleec_runtime.timed.cascade import Moment, Stage, alternative_stage, opening_stage
from sleec_runtime.timed.clock import Execute, Time
from sleec_runtime.timed.failures import Failure, Failures, raise_interrupt
from sleec_runtime.timed.ledger import Action, Ledger
from sleec_runtime.timed.progress import Progress
from sleec_runtime.timed.run import Run
from sleec_runtime.timed.simultaneous_starts import SimultaneousStarts
from sleec_runtime.timed.task import Task
from sleec_runtime.timed.wording import duration_in_words

if TYPE_CHECKING:
    from asyncio import AbstractEventLoop


class TimerEvents:
    """Starts obligations when their windows open, and the alternatives when a window closes unfulfilled. `execute` runs
    the code.

    Errors are reported to `failures` and not raised, except a KeyboardInterrupt in the main thread, which is both.
    """

    def __init__(
        self, admission: Admission, progress: Progress, ledger: Ledger, failures: Failures, execute: Execute
    ) -> None:
        self._admission = admission
        self._progress = progress
        self._ledger = ledger
        self._failures = failures
        self._execute = execute
        self._simultaneous = SimultaneousStarts(ledger.clock.now())
        self._running: set[object] = set()

    def tick(self) -> None:
        """Handles all timer events up to now. Raises Reentrant within a change."""
        self._ledger.refuse_reentry()
        try:
            self._serve()
        except BaseException:
            self._ledger.wake_for_actions()
            raise

    def _serve(self) -> None:
        interrupt = None
        while True:
            try:
                if not self._ledger.do_next() and not self._ledger.change(
                    partial(self._ledger.decide_next, self._decide)
                ):
                    break
            except KeyboardInterrupt as error:
                interrupt = error
        if interrupt is not None:
            raise interrupt

    # Decisions, within a change of the ledger -----------------------------------------------------------------

    def _decide(self, entry: Entry) -> None:
        if entry.unit is not None:
            stage = opening_stage(entry.unit, self._admission.moment().snapshot)
            self._start(stage, entry.unit.tasks, entry.at)
            return
        (task,) = entry.tasks
        if entry.kind == ENDS:
            self._ledger.end(task, "over")
        elif task.literal.negated:
            self._close_prohibition(task, entry.at)
        else:
            self._close(task, entry.at)

    def _close(self, task: Task, at: Time) -> None:
        """The window of an unfulfilled obligation closes."""
        alternatives = task.otherwise
        if alternatives is None and task.instead is not None and self._still_possible(task.instead):
            alternatives = task.instead
        self._ledger.end(task, "missed" if alternatives is None else "replaced")
        if alternatives is None:
            self.miss(task)
        elif alternatives:
            self._start_alternatives(task, alternatives, at)

    def miss(self, task: Task) -> None:
        """Reports that the window of an unfulfilled obligation has closed."""
        assert task.last is not None, "a window without an end does not close"
        length = duration_in_words(task.last - task.origin.moment)
        message = f"`{task.name}` was not done within {length} of the trigger of rule `{task.origin.rule.label}`"
        self.report(self._failure((task,), DeadlineMissed(message, task.name, task.last)))

    def report(self, failure: Failure) -> None:
        """Keeps `failure`, and reports it after the change."""
        self._ledger.undo_by(partial(self._failures.forget, failure))
        self._failures.keep(failure)
        self._ledger.after(Action(partial(self._failures.tell, failure), lambda: True))

    def _still_possible(self, tasks: Iterable[Task]) -> bool:
        now = self._ledger.clock.now()
        return all(
            not task.literal.negated and not task.at_once and (task.last is None or task.last >= now) for task in tasks
        )

    def _close_prohibition(self, task: Task, at: Time) -> None:
        """The window of a prohibition closes. It stays in force to the end of that second, and then ends."""
        assert task.last is not None, "a window without an end does not close"
        self._ledger.schedule(floor(task.last) + 1, ENDS, (task,))
        alternatives = task.otherwise
        if alternatives is None and task.instead is not None and self._still_possible(task.instead):
            alternatives = task.instead
        broken = task.broken
        self._ledger.set(task, "broken", False)
        if broken and alternatives:
            self._start_alternatives(task, alternatives, at)

    def _start_alternatives(self, task: Task, alternatives: tuple[Task, ...], at: Time) -> None:
        self._start(alternative_stage(task, alternatives, self._admission.moment().snapshot), alternatives, at)

    def _start(self, stage: Stage, tasks: Sequence[Task], at: Time) -> None:
        """Starts the due tasks. A forbidden task starts when the prohibition ends, if its window is still open."""
        loop = _running_loop()
        try:
            run = self._ledger.attempt(partial(self._admit_when_allowed, stage, at, in_loop=loop is not None))
        except Reentrant:
            # Raised by a signal handler, not by the start.
            raise
        except Exception as error:  # noqa: BLE001 - reported
            self._give_up(tasks, error, at)
            return
        if run is None:
            return
        if loop is not None and run.needs_loop:
            start: Callable[[], object] = partial(self._spawn, loop, run, stage)
        else:
            start = partial(self._execute, partial(self._go, run, stage), partial(self._fail, stage.tasks))
        self._ledger.after(Action(start, lambda: run.begun))

    def _admit_when_allowed(self, stage: Stage, at: Time, in_loop: bool) -> Run | None:
        moment = self._admission.moment()
        try:
            return self._ledger.attempt(partial(self._admit, stage, moment, at, in_loop))
        except Prohibited as refusal:
            again = refusal.over
            late = [unit for unit in stage.units if unit.at <= moment.now]
            if again is None or any(task.at_once for unit in late for task in unit.tasks):
                raise
            for unit in late:
                self._ledger.set(unit, "at", again)
            # Nothing starts now, so only the prohibitions of the stage itself can be refused.
            self._admit(stage, moment, at, in_loop)
            return None

    def _admit(self, stage: Stage, moment: Moment, at: Time, in_loop: bool) -> Run:
        simultaneous = self._simultaneous if self._simultaneous.at == at else SimultaneousStarts(at)
        stages = self._admission.closure(stage, moment)
        simultaneous.refuse(stages, moment.now)
        self._admission.admit(stages, moment.now, in_loop)
        self._ledger.set(self, "_simultaneous", simultaneous.with_started(stages, moment.now))
        return Run(self._progress, stages, moment.now)

    def _give_up(self, tasks: Sequence[Task], error: Exception, at: Time) -> None:
        """Reports tasks that cannot start. Those with a window stay due until it closes."""
        self.report(self._failure(tasks, error))
        for task in tasks:
            watched = task in self._ledger.agenda.to_do(task.name)
            if watched and not task.at_once:
                self._ledger.set(task, "unit", None)
                continue
            alternatives = task.otherwise if task.at_once and watched else None
            self._ledger.end(task, "missed" if alternatives is None else "replaced")
            if alternatives:
                self._start_alternatives(task, alternatives, at)

    # Actions, outside of a change -------------------------------------------------------------------------------------

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
        # The loop holds only weak references to its tasks.
        self._running.add(task)
        task.add_done_callback(self._running.discard)

    def _report(self, run: Run, stage: Stage) -> None:
        for label, error in run.errors:
            self._failures(self._failure(stage.tasks, error, label))
        for _, error in run.errors:
            raise_interrupt(error)

    def _fail(self, tasks: Sequence[Task], error: BaseException) -> None:
        self._failures(self._failure(tasks, error))

    def _failure(self, tasks: Sequence[Task], error: BaseException, label: str | None = None) -> Failure:
        label = label or tasks[0].origin.rule.label
        return Failure(self._ledger.clock.now(), label, tuple(task.name for task in tasks), error)


def _running_loop() -> AbstractEventLoop | None:
    """The running event loop of this thread, if there is one. It does not import asyncio."""
    asyncio = sys.modules.get("asyncio")
    if asyncio is None:
        return None
    try:
        loop: AbstractEventLoop = asyncio.get_running_loop()
    except RuntimeError:
        return None
    return loop
