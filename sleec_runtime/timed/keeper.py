"""Keeps the times of rules: what a dispatch decides, checks and brings.

Deciding, checking and noting what is due are one change of the ledger; code runs outside of it. So no two dispatches,
of triggers or of the clock, ever decide on half of what the other brings.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from functools import partial
from typing import TYPE_CHECKING, Any

from sleec_runtime.dispatch import one_of
from sleec_runtime.errors import NeedsAwait, Prohibited, SleecError, SnapshotRefused, UnknownObligation
from sleec_runtime.evaluation import Due
from sleec_runtime.messages import listed
from sleec_runtime.obligations import recording
from sleec_runtime.timed.agenda import CLOSES, OPENS
from sleec_runtime.timed.bounds import CheckedClock
from sleec_runtime.timed.failures import Failure, Failures
from sleec_runtime.timed.ledger import Ledger
from sleec_runtime.timed.pending import Pending
from sleec_runtime.timed.refusals import prohibited, refuse
from sleec_runtime.timed.run import Run, TimedDone
from sleec_runtime.timed.stages import Moment, Stage, called_by, in_place_of, with_chains
from sleec_runtime.timed.starts import Starts
from sleec_runtime.timed.tasks import Task
from sleec_runtime.timed.units import Unit
from sleec_runtime.timed.words import prohibitions_in_words

if TYPE_CHECKING:
    from sleec_runtime.instance import Instance
    from sleec_runtime.monitor import Monitor
    from sleec_runtime.program import Program
    from sleec_runtime.snapshot import Snapshot
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
        self._starts = Starts(self, self._ledger, self.failures, self.clock.execute)

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
        return run.done(names, snapshot)

    async def trigger_async(
        self, names: tuple[str, ...], args: tuple[Any, ...], kwargs: Mapping[str, Any], monitor: Monitor | None
    ) -> TimedDone:
        """`Sleec.trigger_async`, for one name or several; `monitor` looks at it."""
        run, snapshot = self._decide(names, args, kwargs, in_loop=True)
        with self._looked_at(names, snapshot, run, monitor):
            await run.go_async()
        if run.errors:
            raise one_of(run.errors)
        return run.done(names, snapshot)

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
        moment = self.moment()
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
            raise _done_though_forbidden(name, broken, now)
        return self.view_all(discharged)

    def _discharge(
        self, name: str, task: Task | None, program: Program
    ) -> tuple[list[Task], list[Task], tuple[Task, ...], Time]:
        waiting = self._ledger.agenda.to_do(name)
        if task is None and not waiting and name not in program.whole.obligations:
            raise UnknownObligation(name, program.whole.obligations)
        discharged, broken = self._ledger.note(name)
        return discharged, broken, waiting, self.clock.now()

    def moment(self, args: tuple[Any, ...] = (), kwargs: Mapping[str, Any] | None = None) -> Moment:
        """Now."""
        snapshot, instance = self._state()
        return Moment(self.clock.now(), snapshot, instance, args, kwargs or {})

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
        moment = self.moment(args, kwargs)
        stages = self.closure(called_by(names, moment), moment)
        run = self.admit(stages, moment.now, in_loop, names if self._chains else (), settled)
        if self._chains:
            for name in names:
                self._ledger.note(name)
        return run, moment.snapshot

    def closure(self, stage: Stage, moment: Moment) -> list[Stage]:
        """`stage`, and with chains what follows from it at once. Raises as `with_chains`."""
        return with_chains(stage, moment) if self._chains else [stage]

    # Deciding, within a change of the ledger ------------------------------------------------------------------

    def admit(
        self, stages: Sequence[Stage], now: Time, in_loop: bool, events: Sequence[str] = (), settled: bool = False
    ) -> Run:
        """Checks all that `stages` bring, and puts it on the agenda. Raises before any of it is there."""
        refuse(stages, self._ledger.agenda, now, events, settled)
        run = Run(self, stages, now)
        if run.asynchronous and not in_loop:
            labels = [unit.origin.rule.label for stage in stages for unit in stage.units if unit.asynchronous]
            raise NeedsAwait(
                f"code of {listed(dict.fromkeys(labels))} is a coroutine function",
                "await trigger_async(…) instead; what the clock starts needs an AsyncioClock",
            )
        watched = [task for stage in stages if not stage.watched for task in stage.tasks if self._is_watched(task, now)]
        if watched and self._ledger.closed:
            raise SleecError("the instance is closed, and what is due needs to be watched", "load the rules anew")
        for task in watched:
            self._watch(task)
        for stage in stages:
            for unit in stage.units:
                if unit.at > now:
                    self._ledger.schedule(unit.at, OPENS, unit.tasks, partial(self._starts.open, unit))
        for stage in stages:
            for task in stage.tasks:
                if task.literal.negated and task not in watched and not stage.watched:
                    self._ledger.set(task, "state", "over")
        return run

    def _is_watched(self, task: Task, now: Time) -> bool:
        """Whether anything of it outlasts the moment, or may."""
        if not task.at_once or task.first > now:
            return True
        # What is due in the place of another is nowhere else, once that is over.
        return not task.literal.negated and (task.is_alternative or task.name in task.origin.instance.takes_time)

    def _watch(self, task: Task) -> None:
        self._ledger.add(task)
        if task.literal.negated:
            if task.last is not None:
                self._ledger.schedule(task.last, CLOSES, (task,), partial(self._starts.close_prohibition, task))
        elif task.at_once:
            if task.name in task.origin.instance.takes_time:
                task.last = None
        elif task.last is not None:
            self._ledger.schedule(task.last, CLOSES, (task,), partial(self._starts.close, task))

    # For a run ------------------------------------------------------------------------------------------------

    def begin(self, unit: Unit) -> list[Task]:
        """The tasks of `unit` that are still open. They are under way from now on."""
        return self._ledger.change(partial(self._begin, unit))

    def _begin(self, unit: Unit) -> list[Task]:
        tasks = [task for task in unit.tasks if task.is_open]
        for task in tasks:
            self._ledger.set(task, "state", "under way")
            self._ledger.set(task, "unit", None)
        return tasks

    def happened(self, name: str, task: Task) -> list[Exception]:
        """`name` is done, as `task` asks for. Returns what is wrong with that."""
        _, broken = self._ledger.change(partial(self._ledger.note, name, task))
        return [_done_though_forbidden(name, broken, self.clock.now())] if broken else []

    def failed(self, task: Task) -> list[Stage]:
        """What `task` asks for was started, and its code raised: what is to be run in its place, on the agenda already.

        With nothing in its place, it can still be done until its window closes. Raises as a dispatch does.
        """
        alternatives = task.instead
        if alternatives is None and task.at_once:
            alternatives = task.otherwise
        if alternatives is not None:
            try:
                return self._ledger.change(partial(self._replace, task, alternatives))
            except Exception:
                self._ledger.change(partial(self._keep_open, task))
                raise
        self._ledger.change(partial(self._keep_open, task))
        return []

    def _keep_open(self, task: Task) -> None:
        """It can still be done if it has a window."""
        if task.is_open and task.at_once:
            self._ledger.end(task, "missed")
        elif task.is_open:
            self._ledger.set(task, "state", "waiting")

    def _replace(self, task: Task, alternatives: tuple[Task, ...]) -> list[Stage]:
        if not task.is_open:
            return []
        self._ledger.end(task, "replaced")
        moment = self.moment()
        stages = self.closure(in_place_of(task, alternatives, moment.snapshot), moment)
        self.admit(stages, moment.now, in_loop=True)
        return stages

    def withdraw(self, tasks: Iterable[Task]) -> None:
        """What was called for by an event that did not happen is not due."""
        self._ledger.change(partial(self._withdraw, tasks))

    def _withdraw(self, tasks: Iterable[Task]) -> None:
        for task in tasks:
            if task.is_open:
                self._ledger.end(task, "withdrawn")

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
            self._watch(task)
            if task.at_once and task.state == "waiting" and task.unit is None and last is not None:
                # The moment at which it was due has passed.
                task.last = last
                self._ledger.schedule(last, CLOSES, (task,), partial(self._starts.close, task))
        for unit in recovered.units:
            self._ledger.schedule(unit.at, OPENS, unit.tasks, partial(self._starts.open, unit))
        for task in recovered.tasks:
            if task.otherwise is not None and not task.literal.negated and task.last is not None and task.last < now:
                self._starts.miss(task)
        for label, name in recovered.left_out:
            lost = SnapshotRefused(f"{name} was pending under rules that had been replaced, and is not restored")
            self._starts.report(Failure(now, label, (name,), lost))

    def tick(self) -> None:
        """Starts and ends all that is due by now. The monitor of a dispatch that calls this does not look at it."""
        with recording(apart=True):
            self._starts.tick()

    def close(self) -> None:
        """Nothing is watched any more. What runs, runs on."""
        self._ledger.look(self._ledger.close)


def _done_though_forbidden(name: str, prohibitions: Sequence[Task], now: Time) -> Prohibited:
    message = f"{name} was done, and {prohibitions_in_words(prohibitions, now)}"
    return prohibited(message, name, prohibitions, "it was begun before that")
