"""The dispatcher for rules with time: a scheduler, and its clock."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager, nullcontext
from functools import partial
from typing import Any

from sleec_runtime.dispatch.execution import one_of
from sleec_runtime.dispatch.plan import Args, Kwargs
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.evaluation.due import Due
from sleec_runtime.facade.dispatcher import Dispatcher, State
from sleec_runtime.facade.done import Done
from sleec_runtime.monitor.monitor import Monitor
from sleec_runtime.timed.clock import Clock, Time
from sleec_runtime.timed.failures import Failure
from sleec_runtime.timed.monotonic_clock import MonotonicClock
from sleec_runtime.timed.pending import Pending
from sleec_runtime.timed.run import Run
from sleec_runtime.timed.scheduler import Scheduler


class TimedDispatcher(Dispatcher):
    """Dispatches rules with time. Without a `clock` it has its own `MonotonicClock`, which `close` stops.

    With `chains`, a response is an event that triggers rules. `on_error` gets each failure of what the clock starts.
    """

    def __init__(
        self, state: State, clock: Clock | None, chains: bool, on_error: Callable[[Failure], object] | None
    ) -> None:
        super().__init__(state)
        self._own_clock: MonotonicClock | None = None
        if clock is None:
            clock = self._own_clock = MonotonicClock()
        self.scheduler = Scheduler(state, clock, chains, on_error)

    def anticipate(self, snapshot: Snapshot, name: str, args: Args) -> None:
        self.ready(snapshot, (name,), args, {})

    def trigger(
        self, snapshot: Snapshot, names: tuple[str, ...], args: Args, kwargs: Kwargs, monitor: Monitor | None
    ) -> Done:
        run, snapshot = self.scheduler.decide(names, args, kwargs)
        with self._observed(names, snapshot, run, monitor):
            run.go()
        return self._done(names, snapshot, run)

    async def trigger_async(
        self, snapshot: Snapshot, names: tuple[str, ...], args: Args, kwargs: Kwargs, monitor: Monitor | None
    ) -> Done:
        run, snapshot = self.scheduler.decide(names, args, kwargs, in_loop=True)
        with self._observed(names, snapshot, run, monitor):
            await run.go_async()
        return self._done(names, snapshot, run)

    def _observed(
        self, names: tuple[str, ...], snapshot: Snapshot, run: Run, monitor: Monitor | None
    ) -> AbstractContextManager[None]:
        if monitor is None:
            return nullcontext()
        return monitor.observe(names, snapshot, self.scheduler.chained_events(snapshot), run.fulfilled)

    def _done(self, names: tuple[str, ...], snapshot: Snapshot, run: Run) -> Done:
        if run.errors:
            raise one_of(run.errors)
        pending = partial(self.scheduler.view, run.tasks)
        return Done(run.plan(names, snapshot.mark), snapshot, run.results, pending)

    def due(self, snapshot: Snapshot, names: tuple[str, ...]) -> Due:
        return self.scheduler.due(names)

    def completed(self, obligation: str) -> tuple[Pending, ...]:
        return self.scheduler.completed(obligation)

    def pending(self) -> tuple[Pending, ...]:
        return self.scheduler.pending()

    def failures(self) -> tuple[Failure, ...]:
        return self.scheduler.failures.kept()

    def pending_snapshot(self, saved_at: Time) -> dict[str, Any]:
        return self.scheduler.snapshot(saved_at)

    def restore(self, data: Mapping[str, Any], world: Time) -> tuple[Pending, ...]:
        return self.scheduler.restore(data, world)

    def tick(self) -> None:
        self.scheduler.tick()

    def close(self) -> None:
        self.scheduler.close()
        if self._own_clock is not None:
            self._own_clock.close()
