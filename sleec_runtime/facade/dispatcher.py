"""The dispatcher of an instance, for rules without time."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import nullcontext
from typing import TYPE_CHECKING, Any

from sleec_runtime.dispatch.decisions import due_in
from sleec_runtime.dispatch.execution import plan, run, run_async
from sleec_runtime.dispatch.instance import Instance
from sleec_runtime.dispatch.plan import Args, Kwargs, Plan
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.errors import UnknownObligation, UnknownTrigger
from sleec_runtime.evaluation.due import Due
from sleec_runtime.facade.done import Done

if TYPE_CHECKING:
    from sleec_runtime.monitor.monitor import Monitor
    from sleec_runtime.timed.clock import Time
    from sleec_runtime.timed.failures import Failure
    from sleec_runtime.timed.pending import Pending

State = Callable[[], tuple[Snapshot, Instance]]
"""Returns the current context and code."""


class Dispatcher:
    """Answers the triggers of an instance. The methods are those of `Sleec`, with checked arguments.

    This one is for rules without time: it executes all obligations at once, so that nothing is pending.
    `TimedDispatcher` extends it.
    """

    def __init__(self, state: State) -> None:
        self._state = state

    def plan(self, snapshot: Snapshot, names: tuple[str, ...]) -> Plan:
        """The plan of a dispatch. The plan of a single trigger is cached until the context changes."""
        if len(names) != 1:
            return plan(snapshot, names, self._state()[1])
        try:
            place = snapshot.index.places.get(names[0])
        except TypeError:  # not hashable
            place = None
        if place is None:
            raise UnknownTrigger(names[0], snapshot.index.places)
        outcomes = snapshot.rows[place[0]][place[1]]
        known = outcomes.plan
        if known is None or known.mark is not snapshot.mark:
            # Two threads may both make the plan. Their plans are equal.
            known = outcomes.plan = plan(snapshot, names, self._state()[1])
        return known

    def ready(self, snapshot: Snapshot, names: tuple[str, ...], args: Args, kwargs: Kwargs) -> Plan:
        """The plan of a dispatch with these arguments, which all checks have accepted."""
        ready = self.plan(snapshot, names)
        if kwargs or len(args) not in ready.ready_for:
            ready.refuse_misfits(args, kwargs)
            ready.refuse_coroutines()
            if not kwargs:
                ready.ready_for.add(len(args))
        return ready

    def anticipate(self, snapshot: Snapshot, name: str, args: Args) -> None:
        snapshot.ready_plans[name] = self.ready(snapshot, (name,), args, {})

    def trigger(
        self, snapshot: Snapshot, names: tuple[str, ...], args: Args, kwargs: Kwargs, monitor: Monitor | None
    ) -> Done:
        ready = self.ready(snapshot, names, args, kwargs)
        if len(names) == 1:
            snapshot.ready_plans[names[0]] = ready  # for the next `Sleec.trigger`
        if monitor is None:
            return Done(ready, snapshot, run(ready, args, kwargs))
        with monitor.observe(names, snapshot):
            return Done(ready, snapshot, run(ready, args, kwargs))

    async def trigger_async(
        self, snapshot: Snapshot, names: tuple[str, ...], args: Args, kwargs: Kwargs, monitor: Monitor | None
    ) -> Done:
        ready = self.plan(snapshot, names)
        ready.refuse_misfits(args, kwargs)
        with nullcontext() if monitor is None else monitor.observe(names, snapshot):
            return Done(ready, snapshot, await run_async(ready, args, kwargs))

    def due(self, snapshot: Snapshot, names: tuple[str, ...]) -> Due:
        return due_in(snapshot, names)

    def completed(self, obligation: str) -> tuple[Pending, ...]:
        known = self._state()[0].index.whole.obligations
        if obligation not in known:
            raise UnknownObligation(obligation, known)
        return ()

    def pending(self) -> tuple[Pending, ...]:
        return ()

    def failures(self) -> tuple[Failure, ...]:
        return ()

    def pending_snapshot(self, saved_at: Time) -> dict[str, Any]:
        from sleec_runtime.timed.checkpoint import checkpoint

        return checkpoint((), self._state()[0].index, False, 0, saved_at)

    def restore(self, data: Mapping[str, Any], world: Time) -> tuple[Pending, ...]:
        from sleec_runtime.timed.recovery import Heir, recover

        snapshot, instance = self._state()
        recover(data, Heir(snapshot.index, instance, False, 0, world))
        return ()

    def tick(self) -> None:
        """There are no timer events."""

    def close(self) -> None:
        """There is no timer."""
