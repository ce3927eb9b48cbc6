"""Keeps the times of rules: what is pending, what is forbidden, and what the clock starts.

Deciding, checking and noting what is due are one step, under a lock; code runs outside of it. So no two dispatches,
of triggers or of the clock, ever decide on half of what the other brings.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Collection, Coroutine, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from functools import partial
from math import floor
from typing import TYPE_CHECKING, Any

from sleec_runtime.dispatch import one_of
from sleec_runtime.errors import DeadlineMissed, NeedsAwait, Prohibited, SleecError, UnknownObligation
from sleec_runtime.evaluation import Due
from sleec_runtime.timed.agenda import CLOSES, OPENS, Agenda
from sleec_runtime.timed.failures import Failure, Failures
from sleec_runtime.timed.instants import Instant
from sleec_runtime.timed.pending import Pending
from sleec_runtime.timed.refusals import prohibited, refuse
from sleec_runtime.timed.run import Run, TimedDone
from sleec_runtime.timed.stages import Moment, Stage, called_by, in_place_of, opened, with_chains
from sleec_runtime.timed.tasks import Task
from sleec_runtime.timed.units import Did, Unit
from sleec_runtime.timed.words import prohibitions_in_words, time_in_words

if TYPE_CHECKING:
    from asyncio import AbstractEventLoop

    from sleec_runtime.instance import Instance
    from sleec_runtime.layers import Variant
    from sleec_runtime.monitor import Monitor
    from sleec_runtime.snapshot import Snapshot
    from sleec_runtime.timed.clocks import Cancel, Clock, Time

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
        self.clock = clock
        self.failures = Failures(on_error)
        self._state = state
        self._chains = chains
        self._lock = threading.RLock()
        self._agenda = Agenda()
        self._instant = Instant(clock.now())
        self._woken_at: Time | None = None
        self._cancel: Cancel | None = None
        self._closed = False
        self._running: set[object] = set()

    # Triggers -------------------------------------------------------------------------------------------------

    def trigger(
        self, names: tuple[str, ...], args: tuple[Any, ...], kwargs: Mapping[str, Any], monitor: Monitor | None
    ) -> TimedDone:
        """`Sleec.trigger`, for one name or several; `monitor` looks at it."""
        run, snapshot = self._decide(names, args, kwargs)
        with self._looked_at(names, snapshot, monitor):
            run.go()
        if run.errors:
            raise one_of(run.errors)
        return run.done(names, snapshot)

    async def trigger_async(
        self, names: tuple[str, ...], args: tuple[Any, ...], kwargs: Mapping[str, Any], monitor: Monitor | None
    ) -> TimedDone:
        """`Sleec.trigger_async`, for one name or several; `monitor` looks at it."""
        run, snapshot = self._decide(names, args, kwargs, in_loop=True)
        with self._looked_at(names, snapshot, monitor):
            await run.go_async()
        if run.errors:
            raise one_of(run.errors)
        return run.done(names, snapshot)

    def _looked_at(
        self, names: tuple[str, ...], snapshot: Snapshot, monitor: Monitor | None
    ) -> AbstractContextManager[None]:
        if monitor is None:
            return nullcontext()
        chained: Collection[str] = ()
        if self._chains:
            _, instance = self._state()
            chained = snapshot.program.number_of.keys() - instance.takes_time
        return monitor.looking(names, snapshot, chained)

    def due(self, names: tuple[str, ...]) -> Due:
        """`Sleec.due`: the decisions, if nothing refuses them now."""
        with self._lock:
            moment = self._moment()
            stage = called_by(names, moment, code=False)
            refuse([stage], self._agenda, moment.now, names if self._chains else ())
        return Due(stage.decisions)

    def completed(self, name: str, task: Task | None = None) -> tuple[Pending, ...]:
        """`name` is done: `Sleec.completed`, and `Pending.completed` of `task`."""
        if task is not None and task.literal.negated:
            raise SleecError(f"{name} is forbidden here, so that it cannot be completed", "complete what is to be done")
        with self._lock:
            snapshot, _ = self._state()
            program = snapshot.program
            waiting = self._agenda.to_do(name)
            if task is None and not waiting and name not in program.whole.obligations:
                raise UnknownObligation(name, program.whole.obligations)
            discharged, broken = self._note(name)
            now = self.clock.now()
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

    def _moment(self, args: tuple[Any, ...] = (), kwargs: Mapping[str, Any] | None = None) -> Moment:
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
        with self._lock:
            moment = self._moment(args, kwargs)
            stages = self._closure(called_by(names, moment), moment)
            run = self._admit(stages, moment.now, in_loop, names if self._chains else (), settled)
            if self._chains:
                for name in names:
                    self._note(name)
        return run, moment.snapshot

    def _closure(self, stage: Stage, moment: Moment) -> list[Stage]:
        return with_chains(stage, moment) if self._chains else [stage]

    # Deciding, under the lock ---------------------------------------------------------------------------------

    def _admit(
        self, stages: Sequence[Stage], now: Time, in_loop: bool, events: Sequence[str] = (), settled: bool = False
    ) -> Run:
        """Checks all that `stages` bring, and puts it on the agenda. Raises before any of it is there."""
        refuse(stages, self._agenda, now, events, settled)
        run = Run(self, stages, now)
        if run.asynchronous and not in_loop:
            labels = [unit.origin.rule.label for stage in stages for unit in stage.units if unit.asynchronous]
            raise NeedsAwait(
                f"code of {', '.join(dict.fromkeys(labels))} is a coroutine function",
                "await trigger_async(…) instead; what the clock starts needs an AsyncioClock",
            )
        watched = [task for stage in stages if not stage.watched for task in stage.tasks if self._is_watched(task, now)]
        if watched and self._closed:
            raise SleecError("the instance is closed, and what is due needs to be watched", "load the rules anew")
        for task in watched:
            self._watch(task)
        for stage in stages:
            for unit in stage.units:
                if unit.at > now:
                    self._agenda.schedule(unit.at, OPENS, unit.tasks, partial(self._open, unit))
        for stage in stages:
            for task in stage.tasks:
                if task.literal.negated and task not in watched and not stage.watched:
                    task.state = "over"
        self._rewake()
        return run

    def _is_watched(self, task: Task, now: Time) -> bool:
        """Whether anything of it outlasts the moment, or may."""
        if not task.at_once or task.first > now:
            return True
        return not task.literal.negated and task.name in task.origin.instance.takes_time

    def _watch(self, task: Task) -> None:
        self._agenda.add(task)
        if task.literal.negated:
            if task.last is not None:
                self._agenda.schedule(task.last, CLOSES, (task,), partial(self._close_prohibition, task))
        elif task.at_once:
            if task.name in task.origin.instance.takes_time:
                task.last = None
        elif task.last is not None:
            self._agenda.schedule(task.last, CLOSES, (task,), partial(self._close, task))

    def _end(self, task: Task, state: Any) -> None:
        task.state = state
        self._agenda.remove(task)

    def _note(self, name: str, own: Task | None = None) -> tuple[list[Task], list[Task]]:
        """`name` happens now: the obligations that are done by it, and the prohibitions that it breaks, with nothing in
        their place."""
        now = self.clock.now()
        discharged = [task for task in self._agenda.to_do(name) if task.covers(now)]
        if own is not None and own.at_once and own not in discharged:
            discharged.append(own)
        for task in discharged:
            self._end(task, "done")
        broken = self._agenda.prohibitions(name, now)
        for task in broken:
            task.broken = True
        if discharged:
            self._rewake()
        return discharged, [task for task in broken if task.is_decided]

    # For a run ------------------------------------------------------------------------------------------------

    def begin(self, unit: Unit, did: Did) -> Variant:
        """What runs for `unit`, which is under way from now on."""
        with self._lock:
            for task in unit.tasks:
                if task.is_open:
                    task.state = "under way"
        return unit.variant(did)

    def happened(self, name: str, task: Task) -> list[Exception]:
        """`name` is done, as `task` asks for. Returns what is wrong with that."""
        with self._lock:
            _, broken = self._note(name, task)
            now = self.clock.now()
        return [_done_though_forbidden(name, broken, now)] if broken else []

    def failed(self, task: Task) -> list[Stage]:
        """What `task` asks for was started, and its code raised: what is to be run in its place, on the agenda already.

        With nothing in its place, it can still be done until its window closes. Raises as a dispatch does.
        """
        with self._lock:
            if not task.is_open:
                return []
            alternatives = task.instead
            if alternatives is None and task.at_once:
                alternatives = task.otherwise
            if alternatives is None:
                if task.at_once:
                    self._end(task, "missed")
                else:
                    task.state = "waiting"
                return []
            self._end(task, "replaced")
            moment = self._moment()
            stages = self._closure(in_place_of(task, alternatives, moment.snapshot), moment)
            self._admit(stages, moment.now, in_loop=True)
        return stages

    def withdraw(self, tasks: Iterable[Task]) -> None:
        """What was called for by an event that did not happen is not due."""
        with self._lock:
            for task in tasks:
                self._end(task, "withdrawn")
            self._rewake()

    # What the clock starts and ends ---------------------------------------------------------------------------

    def tick(self) -> None:
        """Starts and ends all that is due by now."""
        while True:
            with self._lock:
                next_one = None if self._closed else self._agenda.pop(self.clock.now())
                if next_one is None:
                    self._woken_at = None
                    self._rewake()
                    return
            at, call = next_one
            call(at)

    def _open(self, unit: Unit, at: Time) -> None:
        with self._lock:
            snapshot, _ = self._state()
        self._start(opened(unit, snapshot), unit.tasks, at)

    def _close(self, task: Task, at: Time) -> None:
        """Its window closes, and it is not done."""
        with self._lock:
            if not task.is_open:
                return
            alternatives = task.otherwise
            if alternatives is None and task.instead is not None and self._still_possible(task.instead):
                alternatives = task.instead
            self._end(task, "missed" if alternatives is None else "replaced")
            snapshot, _ = self._state()
        if alternatives is None:
            label = task.origin.rule.label
            assert task.last is not None, "what has no end does not close"
            self._fail(
                (task,),
                DeadlineMissed(
                    f"{task.name} was to be done by {time_in_words(task.last)} ({label}), and was not",
                    task.name,
                    task.last,
                ),
            )
        elif alternatives:
            self._start(in_place_of(task, alternatives, snapshot), alternatives, at)

    def _still_possible(self, tasks: Iterable[Task]) -> bool:
        now = self.clock.now()
        return all(
            not task.literal.negated and not task.at_once and (task.last is None or task.last >= now) for task in tasks
        )

    def _close_prohibition(self, task: Task, at: Time) -> None:
        """Its window closes. It forbids to the end of that moment, and is then over."""
        assert task.last is not None, "what has no end does not close"
        with self._lock:
            self._agenda.schedule(floor(task.last) + 1, CLOSES, (task,), partial(self._end_locked, task))
            alternatives = task.otherwise if task.otherwise is not None else task.instead
            snapshot, _ = self._state()
        if task.broken and alternatives:
            self._start(in_place_of(task, alternatives, snapshot), alternatives, at)

    def _end_locked(self, task: Task, at: Time) -> None:
        with self._lock:
            self._end(task, "over")

    def _start(self, stage: Stage, tasks: Sequence[Task], at: Time) -> None:
        """Starts what is due now. What is forbidden now is started once it no longer is, if its window lasts."""
        loop = _running_loop()
        try:
            with self._lock:
                if self._instant.at != at:
                    self._instant = Instant(at)
                run = self._admit_when_allowed(stage, self._instant, in_loop=loop is not None)
        except Exception as error:  # noqa: BLE001 - told
            self._give_up(tasks, error, at)
            return
        if run is None:
            return
        if loop is not None and run.asynchronous:
            self._spawn(loop, self._finish(run, stage))
        else:
            run.go()
            self._report(run, stage)

    def _admit_when_allowed(self, stage: Stage, instant: Instant, in_loop: bool) -> Run | None:
        moment = self._moment()
        try:
            stages = self._closure(stage, moment)
            instant.refuse(stages, moment.now)
            run = self._admit(stages, moment.now, in_loop)
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
            stages = self._closure(stage, moment)
            instant.refuse(stages, moment.now)
            self._admit(stages, moment.now, in_loop)
            instant.note(stages, moment.now)
            return None

    async def _finish(self, run: Run, stage: Stage) -> None:
        await run.go_async()
        self._report(run, stage)

    def _spawn(self, loop: AbstractEventLoop, work: Coroutine[Any, Any, None]) -> None:
        task = loop.create_task(work)
        # The loop itself holds its tasks but weakly.
        self._running.add(task)
        task.add_done_callback(self._running.discard)

    def _report(self, run: Run, stage: Stage) -> None:
        for label, error in run.errors:
            self.failures(Failure(self.clock.now(), label, tuple(task.name for task in stage.tasks), error))

    def _give_up(self, tasks: Sequence[Task], error: Exception, at: Time) -> None:
        """What was to be started now is not. What has a window stays due until that closes."""
        self._fail(tasks, error)
        for task in tasks:
            with self._lock:
                watched = task in self._agenda.to_do(task.name)
                if watched and not task.at_once:
                    continue
                alternatives = task.otherwise if task.at_once and watched else None
                self._end(task, "missed" if alternatives is None else "replaced")
                snapshot, _ = self._state()
            if alternatives:
                self._start(in_place_of(task, alternatives, snapshot), alternatives, at)

    def _fail(self, tasks: Sequence[Task], error: Exception) -> None:
        label = tasks[0].origin.rule.label
        self.failures(Failure(self.clock.now(), label, tuple(task.name for task in tasks), error))

    def _rewake(self) -> None:
        at = None if self._closed else self._agenda.next_time()
        if at == self._woken_at:
            return
        if self._cancel is not None:
            self._cancel()
        self._woken_at = at
        self._cancel = None if at is None else self.clock.wake(at, self.tick)

    # What there is --------------------------------------------------------------------------------------------

    def pending(self) -> tuple[Pending, ...]:
        """All that is not over, by when it ends."""
        with self._lock:
            return self.view(self._agenda)

    def view(self, tasks: Iterable[Task]) -> tuple[Pending, ...]:
        """What users see of those of `tasks` that are not over, by when they end."""
        with self._lock:
            now = self.clock.now()
            still = [task for task in tasks if task.is_open_at(now)]
        still.sort(key=lambda task: (task.last is None, task.first if task.last is None else task.last))
        return self.view_all(still)

    def view_all(self, tasks: Iterable[Task]) -> tuple[Pending, ...]:
        """What users see of `tasks`."""
        return tuple(Pending(task, self) for task in tasks)

    def close(self) -> None:
        """Nothing is watched any more. What runs, runs on."""
        with self._lock:
            self._closed = True
            self._rewake()


def _done_though_forbidden(name: str, prohibitions: Sequence[Task], now: Time) -> Prohibited:
    message = f"{name} was done at {time_in_words(now)}, and {prohibitions_in_words(prohibitions)}"
    return prohibited(message, name, prohibitions, "it was begun before that")


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
