"""What the clock starts and ends."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from math import floor
from typing import TYPE_CHECKING

from sleec_runtime.errors import DeadlineMissed, Prohibited, Reentrant
from sleec_runtime.timed.agenda import CLOSES
from sleec_runtime.timed.cascade import Moment, Stage, in_place_of, opened
from sleec_runtime.timed.failures import Failure, Failures, raise_interrupt
from sleec_runtime.timed.instants import Instant
from sleec_runtime.timed.ledger import Act, Ledger
from sleec_runtime.timed.wording import duration_in_words

if TYPE_CHECKING:
    from asyncio import AbstractEventLoop

    from sleec_runtime.timed.clocks import Time
    from sleec_runtime.timed.execution_plan import Unit
    from sleec_runtime.timed.executor import Execute
    from sleec_runtime.timed.lifecycle import Lifecycle
    from sleec_runtime.timed.tasks import Task
    from sleec_runtime.timed.timed_dispatch import Run


class Starts:
    """Starts, by `execute`, what opens, and what is due because something closes undone. What goes wrong is reported to
    `failures`, and not raised: only a KeyboardInterrupt in the main thread is both."""

    def __init__(self, lifecycle: Lifecycle, ledger: Ledger, failures: Failures, execute: Execute) -> None:
        self._lifecycle = lifecycle
        self._ledger = ledger
        self._failures = failures
        self._execute = execute
        self._instant = Instant(ledger.clock.now())
        self._running: set[object] = set()

    def tick(self) -> None:
        """Starts and ends all that is due by now. Raises Reentrant within a change."""
        self._ledger.refuse_reentry()
        try:
            self._serve()
        except BaseException:
            self._ledger.wake_for_acts()
            raise

    def _serve(self) -> None:
        interrupt = None
        while True:
            try:
                if not self._ledger.do_next() and not self._ledger.change(self._ledger.decide_next):
                    break
            except KeyboardInterrupt as error:
                interrupt = error
        if interrupt is not None:
            raise interrupt

    # Decisions, within a change of the ledger -----------------------------------------------------------------

    def open(self, unit: Unit, at: Time) -> None:
        """Its window opens."""
        self._start(opened(unit, self._lifecycle.moment().snapshot), unit.tasks, at)

    def close(self, task: Task, at: Time) -> None:
        """Its window closes, and it is not done."""
        alternatives = task.otherwise
        if alternatives is None and task.instead is not None and self._still_possible(task.instead):
            alternatives = task.instead
        self._ledger.end(task, "missed" if alternatives is None else "replaced")
        if alternatives is None:
            self.miss(task)
        elif alternatives:
            self._start(in_place_of(task, alternatives, self._lifecycle.moment().snapshot), alternatives, at)

    def miss(self, task: Task) -> None:
        """Reports that its window has closed, and it is not done."""
        assert task.last is not None, "what has no end does not close"
        length = duration_in_words(task.last - task.origin.moment)
        message = f"{task.name} was not done within {length} of the trigger of rule {task.origin.rule.label}"
        self.report(self._failure((task,), DeadlineMissed(message, task.name, task.last)))

    def report(self, failure: Failure) -> None:
        """Keeps `failure`, and has it told once the change is made."""
        self._ledger.undo_by(partial(self._failures.forget, failure))
        self._failures.keep(failure)
        self._ledger.after(Act(partial(self._failures.tell, failure), lambda: True))

    def _still_possible(self, tasks: Iterable[Task]) -> bool:
        now = self._ledger.clock.now()
        return all(
            not task.literal.negated and not task.at_once and (task.last is None or task.last >= now) for task in tasks
        )

    def close_prohibition(self, task: Task, at: Time) -> None:
        """Its window closes. It forbids to the end of that moment, and is then over."""
        assert task.last is not None, "what has no end does not close"
        self._ledger.schedule(floor(task.last) + 1, CLOSES, (task,), partial(self._end, task))
        alternatives = task.otherwise if task.otherwise is not None else task.instead
        broken = task.broken
        self._ledger.set(task, "broken", False)
        if broken and alternatives:
            self._start(in_place_of(task, alternatives, self._lifecycle.moment().snapshot), alternatives, at)

    def _end(self, task: Task, at: Time) -> None:
        self._ledger.end(task, "over")

    def _start(self, stage: Stage, tasks: Sequence[Task], at: Time) -> None:
        """Starts what is due now. What is forbidden now is started once it no longer is, if its window lasts."""
        loop = _running_loop()
        try:
            run = self._ledger.attempt(partial(self._admit_when_allowed, stage, at, in_loop=loop is not None))
        except Reentrant:
            # Raised by a signal handler, which has nothing to do with what is due.
            raise
        except Exception as error:  # noqa: BLE001 - reported
            self._give_up(tasks, error, at)
            return
        if run is None:
            return
        if loop is not None and run.asynchronous:
            start: Callable[[], object] = partial(self._spawn, loop, run, stage)
        else:
            start = partial(self._execute, partial(self._go, run, stage), partial(self._fail, stage.tasks))
        self._ledger.after(Act(start, lambda: run.begun))

    def _admit_when_allowed(self, stage: Stage, at: Time, in_loop: bool) -> Run | None:
        moment = self._lifecycle.moment()
        try:
            return self._ledger.attempt(partial(self._admit, stage, moment, at, in_loop))
        except Prohibited as refusal:
            again = refusal.over
            late = [unit for unit in stage.units if unit.at <= moment.now]
            if again is None or any(task.at_once for unit in late for task in unit.tasks):
                raise
            for unit in late:
                self._ledger.set(unit, "at", again)
            # With nothing that starts now, only what it forbids itself can be refused.
            self._admit(stage, moment, at, in_loop)
            return None

    def _admit(self, stage: Stage, moment: Moment, at: Time, in_loop: bool) -> Run:
        instant = self._instant if self._instant.at == at else Instant(at)
        stages = self._lifecycle.closure(stage, moment)
        instant.refuse(stages, moment.now)
        run = self._lifecycle.admit(stages, moment.now, in_loop)
        self._ledger.set(self, "_instant", instant.with_started(stages, moment.now))
        return run

    def _give_up(self, tasks: Sequence[Task], error: Exception, at: Time) -> None:
        """What was to be started now is not. What has a window stays due until that closes."""
        self.report(self._failure(tasks, error))
        for task in tasks:
            watched = task in self._ledger.agenda.to_do(task.name)
            if watched and not task.at_once:
                self._ledger.set(task, "unit", None)
                continue
            alternatives = task.otherwise if task.at_once and watched else None
            self._ledger.end(task, "missed" if alternatives is None else "replaced")
            if alternatives:
                self._start(in_place_of(task, alternatives, self._lifecycle.moment().snapshot), alternatives, at)

    # Acts, outside of it --------------------------------------------------------------------------------------

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
            self._failures(self._failure(stage.tasks, error, label))
        for _, error in run.errors:
            raise_interrupt(error)

    def _fail(self, tasks: Sequence[Task], error: BaseException) -> None:
        self._failures(self._failure(tasks, error))

    def _failure(self, tasks: Sequence[Task], error: BaseException, label: str | None = None) -> Failure:
        label = label or tasks[0].origin.rule.label
        return Failure(self._ledger.clock.now(), label, tuple(task.name for task in tasks), error)


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
