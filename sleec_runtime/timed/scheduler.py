"""The scheduler of rules with time.

A dispatch decides, checks and records its tasks in one change of the ledger, and runs code outside of it. So no other
dispatch, by a trigger or by the clock, ever sees a part of them.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from functools import partial
from typing import Any

from sleec_runtime.dispatch.execution import one_of
from sleec_runtime.dispatch.instance import Instance
from sleec_runtime.dispatch.plan import Args, Kwargs
from sleec_runtime.dispatch.recording import recording
from sleec_runtime.dispatch.rule_index import RuleIndex
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.errors import SleecError, SnapshotRefused, UnknownObligation
from sleec_runtime.evaluation.due import Due
from sleec_runtime.timed.admission import Admission
from sleec_runtime.timed.agenda import CLOSES, OPENS
from sleec_runtime.timed.cascade import triggered_stage
from sleec_runtime.timed.clock import CheckedClock, Clock, Time
from sleec_runtime.timed.failures import Failure, Failures
from sleec_runtime.timed.ledger import Ledger, transaction
from sleec_runtime.timed.pending import Pending
from sleec_runtime.timed.progress import Progress
from sleec_runtime.timed.refusals import done_though_forbidden, refuse
from sleec_runtime.timed.run import Run
from sleec_runtime.timed.task import Task
from sleec_runtime.timed.timer_events import TimerEvents


class Scheduler:
    """Schedules the obligations and prohibitions of an instance.

    `state` returns the current context and code. With `chains`, a response is an event that triggers rules. `on_error`
    gets each failure of what the clock starts.
    """

    def __init__(
        self,
        state: Callable[[], tuple[Snapshot, Instance]],
        clock: Clock,
        chains: bool,
        on_error: Callable[[Failure], object] | None,
    ) -> None:
        self.clock = CheckedClock(clock)
        self.failures = Failures(on_error, self.clock.execute)
        self._state = state
        self._chains = chains
        self._restored = False
        self._ledger = Ledger(self.clock, self.tick)
        self._admission = Admission(state, self._ledger, chains)
        self._progress = Progress(self._admission, self._ledger)
        self._events = TimerEvents(self._admission, self._progress, self._ledger, self.failures, self.clock.execute)

    # Triggers -------------------------------------------------------------------------------------------------

    @transaction
    def decide(
        self, names: tuple[str, ...], args: Args, kwargs: Kwargs, in_loop: bool = False, settled: bool = False
    ) -> tuple[Run, Snapshot]:
        """Decides and checks what the triggers ask for, and puts it on the agenda. Returns the run of its code.

        Coroutine functions are rejected unless the run is `in_loop`. Prohibitions do not refuse triggers that are
        `settled`. Raises as `Sleec.trigger`.
        """
        moment = self._admission.moment(args, kwargs)
        stages = self._admission.closure(triggered_stage(names, moment), moment)
        self._admission.admit(stages, moment.now, in_loop, names if self._chains else (), settled)
        if self._chains:
            for name in names:
                self._ledger.note(name)
        return Run(self._progress, stages, moment.now), moment.snapshot

    def chained_events(self, snapshot: Snapshot) -> Collection[str]:
        """The obligations that trigger rules when their callables return."""
        return snapshot.index.number_of.keys() - self._state()[1].takes_time if self._chains else ()

    @transaction
    def due(self, names: tuple[str, ...]) -> Due:
        """`Sleec.due`: the decisions. Raises if they are forbidden now."""
        moment = self._admission.moment()
        stage = triggered_stage(names, moment, code=False)
        refuse([stage], self._ledger.agenda, moment.now, names if self._chains else ())
        return Due(stage.decisions)

    def completed(self, name: str, task: Task | None = None) -> tuple[Pending, ...]:
        """`name` is done: `Sleec.completed`, and `Pending.completed` of `task`."""
        if task is not None and task.literal.negated:
            raise SleecError(f"`{name}` is a prohibition, which cannot be completed", "complete an obligation")
        index = self._state()[0].index
        discharged, broken, waiting, now = self._discharge(name, task, index)
        fulfilled = next(iter(discharged or waiting), task)
        if self._chains and name in index.number_of:
            origin = None if fulfilled is None else fulfilled.origin
            # A prohibition does not undo it, so the rules that it triggers apply.
            args, kwargs = ((), {}) if origin is None else (origin.args, dict(origin.kwargs))
            run, _ = self.decide((name,), args, kwargs, settled=True)
            run.go()
            if run.errors:
                raise one_of(run.errors)
        if broken:
            raise done_though_forbidden(name, broken, now)
        return self.view_all(discharged)

    @transaction
    def _discharge(
        self, name: str, task: Task | None, index: RuleIndex
    ) -> tuple[list[Task], list[Task], tuple[Task, ...], Time]:
        waiting = self._ledger.agenda.to_do(name)
        if task is None and not waiting and name not in index.whole.obligations:
            raise UnknownObligation(name, index.whole.obligations)
        discharged, broken = self._ledger.note(name)
        return discharged, broken, waiting, self.clock.now()

    # Pending tasks --------------------------------------------------------------------------------------------

    def pending(self) -> tuple[Pending, ...]:
        """All open tasks, by the ends of their windows."""
        return self.view(self._ledger.agenda)

    def view(self, tasks: Iterable[Task]) -> tuple[Pending, ...]:
        """The open ones of `tasks` as users see them, by the ends of their windows."""
        still = self._ledger.look(partial(self._still_open, tasks))
        still.sort(key=lambda task: (task.last is None, task.first if task.last is None else task.last))
        return self.view_all(still)

    def _still_open(self, tasks: Iterable[Task]) -> list[Task]:
        now = self.clock.now()
        return [task for task in tasks if task.is_open_at(now)]

    def view_all(self, tasks: Iterable[Task]) -> tuple[Pending, ...]:
        """The `tasks` as users see them."""
        return tuple(Pending(task, self) for task in tasks)

    # Snapshots for other processes ------------------------------------------------------------------------------------

    def snapshot(self, saved_at: Time) -> dict[str, Any]:
        """`Sleec.pending_snapshot`."""
        return self._ledger.look(partial(self._checkpoint, saved_at))

    def _checkpoint(self, saved_at: Time) -> dict[str, Any]:
        from sleec_runtime.timed.checkpoint import checkpoint

        snapshot, _ = self._state()
        return checkpoint(self._ledger.agenda, snapshot.index, self._chains, self.clock.now(), saved_at)

    def restore(self, data: object, world: Time) -> tuple[Pending, ...]:
        """`Sleec.restore`."""
        self._restore(data, world)
        self.tick()
        return self.pending()

    @transaction
    def _restore(self, data: object, world: Time) -> None:
        from sleec_runtime.timed.recovery import Heir, recover

        if self._ledger.closed:
            raise SleecError("the instance is closed and schedules no more obligations", "load the rules again")
        if self._restored or any(self._ledger.agenda):
            raise SnapshotRefused(
                "a snapshot can be restored only once, and before the first trigger", "load the rules again"
            )
        snapshot, instance = self._state()
        now = self.clock.now()
        recovered = recover(data, Heir(snapshot.index, instance, self._chains, now, world))
        self._ledger.set(self, "_restored", True)
        for task in recovered.tasks:
            last = task.last
            self._admission.watch(task)
            if task.at_once and task.state == "waiting" and task.unit is None and last is not None:
                # The time at which it was due has passed.
                task.last = last
                self._ledger.schedule(last, CLOSES, (task,))
        for unit in recovered.units:
            self._ledger.schedule(unit.at, OPENS, unit.tasks, unit)
        for task in recovered.tasks:
            if task.otherwise is not None and not task.literal.negated and task.last is not None and task.last < now:
                self._events.miss(task)
        for label, name in recovered.left_out:
            lost = SnapshotRefused(f"`{name}` was pending under rules that had been replaced, and is not restored")
            self._events.report(Failure(now, label, (name,), lost))

    def tick(self) -> None:
        """Handles all timer events up to now. A monitor of the calling dispatch does not see them."""
        with recording(apart=True):
            self._events.tick()

    def close(self) -> None:
        """Stops all timer events. Running code continues."""
        self._ledger.look(self._ledger.close)
