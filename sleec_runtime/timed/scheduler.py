"""Keeps the times of rules: what a dispatch decides, checks and brings.

Deciding, checking and noting what is due are one change of the ledger; code runs outside of it. So no two dispatches,
of triggers or of the clock, ever decide on half of what the other brings.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from contextlib import AbstractContextManager, nullcontext
from functools import partial
from typing import TYPE_CHECKING, Any

from sleec_runtime.dispatch.dispatch import one_of
from sleec_runtime.dispatch.implementations import recording
from sleec_runtime.errors import SleecError, SnapshotRefused, UnknownObligation
from sleec_runtime.evaluation.evaluation import Due
from sleec_runtime.timed.agenda import CLOSES, OPENS
from sleec_runtime.timed.bounds import CheckedClock
from sleec_runtime.timed.cascade import called_by
from sleec_runtime.timed.failures import Failure, Failures
from sleec_runtime.timed.ledger import Ledger
from sleec_runtime.timed.lifecycle import Lifecycle, done_though_forbidden
from sleec_runtime.timed.pending import Pending
from sleec_runtime.timed.refusals import refuse
from sleec_runtime.timed.tasks import Task
from sleec_runtime.timed.timed_dispatch import Run, TimedDone

if TYPE_CHECKING:
    from sleec_runtime.dispatch.instance import Instance
    from sleec_runtime.dispatch.monitor import Monitor
    from sleec_runtime.dispatch.program import Program
    from sleec_runtime.dispatch.snapshot import Snapshot
    from sleec_runtime.timed.clocks import Clock, Time

_NO_ARGUMENTS: tuple[tuple[Any, ...], Mapping[str, Any]] = ((), {})


class Timekeeper:
    """All of an instance that has to do with time. `state` gives the context and the code of now. With `chains`, a
    response is an event: doing it sets off the rules that it is the trigger of."""

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
        self._lifecycle = Lifecycle(state, self._ledger, chains, self.failures, self.clock.execute)

    # Triggers -------------------------------------------------------------------------------------------------

    def trigger(
        self, names: tuple[str, ...], args: tuple[Any, ...], kwargs: Mapping[str, Any], monitor: Monitor | None
    ) -> TimedDone:
        """`Sleec.trigger`, for one name or several; `monitor` looks at it."""
        run, snapshot = self._decide(names, args, kwargs)
        with self._looked_at(names, snapshot, run, monitor):
            run.go()
        if run.errors:
            raise one_of(run.errors)
        return run.done(names, snapshot, self.view)

    async def trigger_async(
        self, names: tuple[str, ...], args: tuple[Any, ...], kwargs: Mapping[str, Any], monitor: Monitor | None
    ) -> TimedDone:
        """`Sleec.trigger_async`, for one name or several; `monitor` looks at it."""
        run, snapshot = self._decide(names, args, kwargs, in_loop=True)
        with self._looked_at(names, snapshot, run, monitor):
            await run.go_async()
        if run.errors:
            raise one_of(run.errors)
        return run.done(names, snapshot, self.view)

    def _looked_at(
        self, names: tuple[str, ...], snapshot: Snapshot, run: Run, monitor: Monitor | None
    ) -> AbstractContextManager[None]:
        if monitor is None:
            return nullcontext()
        chained: Collection[str] = ()
        if self._chains:
            _, instance = self._state()
            chained = snapshot.program.number_of.keys() - instance.takes_time
        return monitor.looking(names, snapshot, chained, run.fulfilled)

    def due(self, names: tuple[str, ...]) -> Due:
        """`Sleec.due`: the decisions, if nothing refuses them now."""
        return self._ledger.change(partial(self._due, names))

    def _due(self, names: tuple[str, ...]) -> Due:
        moment = self._lifecycle.moment()
        stage = called_by(names, moment, code=False)
        refuse([stage], self._ledger.agenda, moment.now, names if self._chains else ())
        return Due(stage.decisions)

    def completed(self, name: str, task: Task | None = None) -> tuple[Pending, ...]:
        """`name` is done: `Sleec.completed`, and `Pending.completed` of `task`."""
        if task is not None and task.literal.negated:
            raise SleecError(f"{name} is forbidden here, so that it cannot be completed", "complete what is to be done")
        snapshot, _ = self._state()
        program = snapshot.program
        discharged, broken, waiting, now = self._ledger.change(partial(self._discharge, name, task, program))
        called = next(iter(discharged or waiting), task)
        if self._chains and name in program.number_of:
            args, kwargs = _NO_ARGUMENTS if called is None else (called.origin.args, called.origin.kwargs)
            # That it is forbidden does not undo it, and what it sets off is due all the same.
            run, _ = self._decide((name,), args, kwargs, settled=True)
            run.go()
            if run.errors:
                raise one_of(run.errors)
        if broken:
            raise done_though_forbidden(name, broken, now)
        return self.view_all(discharged)

    def _discharge(
        self, name: str, task: Task | None, program: Program
    ) -> tuple[list[Task], list[Task], tuple[Task, ...], Time]:
        waiting = self._ledger.agenda.to_do(name)
        if task is None and not waiting and name not in program.whole.obligations:
            raise UnknownObligation(name, program.whole.obligations)
        discharged, broken = self._ledger.note(name)
        return discharged, broken, waiting, self.clock.now()

    def _decide(
        self,
        names: tuple[str, ...],
        args: tuple[Any, ...],
        kwargs: Mapping[str, Any],
        in_loop: bool = False,
        settled: bool = False,
    ) -> tuple[Run, Snapshot]:
        return self._ledger.change(partial(self._decided, names, args, kwargs, in_loop, settled))

    def _decided(
        self,
        names: tuple[str, ...],
        args: tuple[Any, ...],
        kwargs: Mapping[str, Any],
        in_loop: bool,
        settled: bool,
    ) -> tuple[Run, Snapshot]:
        moment = self._lifecycle.moment(args, kwargs)
        stages = self._lifecycle.closure(called_by(names, moment), moment)
        run = self._lifecycle.admit(stages, moment.now, in_loop, names if self._chains else (), settled)
        if self._chains:
            for name in names:
                self._ledger.note(name)
        return run, moment.snapshot

    # What there is --------------------------------------------------------------------------------------------

    def pending(self) -> tuple[Pending, ...]:
        """All that is not over, by when it ends."""
        return self.view(self._ledger.agenda)

    def view(self, tasks: Iterable[Task]) -> tuple[Pending, ...]:
        """What users see of those of `tasks` that are not over, by when they end."""
        still = self._ledger.look(partial(self._still_open, tasks))
        still.sort(key=lambda task: (task.last is None, task.first if task.last is None else task.last))
        return self.view_all(still)

    def _still_open(self, tasks: Iterable[Task]) -> list[Task]:
        now = self.clock.now()
        return [task for task in tasks if task.is_open_at(now)]

    def view_all(self, tasks: Iterable[Task]) -> tuple[Pending, ...]:
        """What users see of `tasks`."""
        return tuple(Pending(task, self) for task in tasks)

    # For another process --------------------------------------------------------------------------------------

    def snapshot(self, saved_at: Time) -> dict[str, Any]:
        """What is pending, as plain data: `Sleec.pending_snapshot`."""
        return self._ledger.look(partial(self._checkpoint, saved_at))

    def _checkpoint(self, saved_at: Time) -> dict[str, Any]:
        from sleec_runtime.timed.checkpoint import checkpoint

        snapshot, _ = self._state()
        return checkpoint(self._ledger.agenda, snapshot.program, self._chains, self.clock.now(), saved_at)

    def restore(self, data: object, world: Time) -> tuple[Pending, ...]:
        """`Sleec.restore`."""
        self._ledger.change(partial(self._restore, data, world))
        self.tick()
        return self.pending()

    def _restore(self, data: object, world: Time) -> None:
        from sleec_runtime.timed.recovery import Heir, recover

        if self._ledger.closed:
            raise SleecError("the instance is closed, and what is pending needs to be watched", "load the rules anew")
        if self._restored or any(self._ledger.agenda):
            raise SnapshotRefused("a snapshot is restored once, and before the first trigger", "load the rules anew")
        snapshot, instance = self._state()
        now = self.clock.now()
        recovered = recover(data, Heir(snapshot.program, instance, self._chains, now, world))
        self._ledger.set(self, "_restored", True)
        for task in recovered.tasks:
            last = task.last
            self._lifecycle.watch(task)
            if task.at_once and task.state == "waiting" and task.unit is None and last is not None:
                # The moment at which it was due has passed.
                task.last = last
                self._ledger.schedule(last, CLOSES, (task,), partial(self._lifecycle.starts.close, task))
        for unit in recovered.units:
            self._ledger.schedule(unit.at, OPENS, unit.tasks, partial(self._lifecycle.starts.open, unit))
        for task in recovered.tasks:
            if task.otherwise is not None and not task.literal.negated and task.last is not None and task.last < now:
                self._lifecycle.starts.miss(task)
        for label, name in recovered.left_out:
            lost = SnapshotRefused(f"{name} was pending under rules that had been replaced, and is not restored")
            self._lifecycle.starts.report(Failure(now, label, (name,), lost))

    def tick(self) -> None:
        """Starts and ends all that is due by now. The monitor of a dispatch that calls this does not look at it."""
        with recording(apart=True):
            self._lifecycle.starts.tick()

    def close(self) -> None:
        """Nothing is watched any more. What runs, runs on."""
        self._ledger.look(self._ledger.close)
