"""What becomes of tasks: they are admitted to the agenda, begun, done, replaced or withdrawn."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from sleec_runtime.errors import NeedsAwait, Prohibited, SleecError
from sleec_runtime.support.messages import listed
from sleec_runtime.timed.agenda import CLOSES, OPENS
from sleec_runtime.timed.cascade import Moment, Stage, in_place_of, with_chains
from sleec_runtime.timed.refusals import prohibited, refuse
from sleec_runtime.timed.timed_dispatch import Run
from sleec_runtime.timed.timer_events import Starts
from sleec_runtime.timed.wording import prohibitions_in_words

if TYPE_CHECKING:
    from sleec_runtime.dispatch.instance import Instance
    from sleec_runtime.dispatch.snapshot import Snapshot
    from sleec_runtime.timed.clocks import Time
    from sleec_runtime.timed.execution_plan import Unit
    from sleec_runtime.timed.executor import Execute
    from sleec_runtime.timed.failures import Failures
    from sleec_runtime.timed.ledger import Ledger
    from sleec_runtime.timed.tasks import Task


class Lifecycle:
    """Puts what stages bring on the agenda, has it started and ended by `starts`, and says what runs become of. `state`
    gives the context and the code of now."""

    def __init__(
        self,
        state: Callable[[], tuple[Snapshot, Instance]],
        ledger: Ledger,
        chains: bool,
        failures: Failures,
        execute: Execute,
    ) -> None:
        self._state = state
        self._ledger = ledger
        self._chains = chains
        self.starts = Starts(self, ledger, failures, execute)

    # Within a change of the ledger ----------------------------------------------------------------------------

    def moment(self, args: tuple[Any, ...] = (), kwargs: Mapping[str, Any] | None = None) -> Moment:
        """Now."""
        snapshot, instance = self._state()
        return Moment(self._ledger.clock.now(), snapshot, instance, args, kwargs or {})

    def closure(self, stage: Stage, moment: Moment) -> list[Stage]:
        """`stage`, and with chains what follows from it at once. Raises as `with_chains`."""
        return with_chains(stage, moment) if self._chains else [stage]

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
            self.watch(task)
        for stage in stages:
            for unit in stage.units:
                if unit.at > now:
                    self._ledger.schedule(unit.at, OPENS, unit.tasks, partial(self.starts.open, unit))
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

    def watch(self, task: Task) -> None:
        """Puts it on the agenda, with what ends it."""
        self._ledger.add(task)
        if task.literal.negated:
            if task.last is not None:
                self._ledger.schedule(task.last, CLOSES, (task,), partial(self.starts.close_prohibition, task))
        elif task.at_once:
            if task.name in task.origin.instance.takes_time:
                task.last = None
        elif task.last is not None:
            self._ledger.schedule(task.last, CLOSES, (task,), partial(self.starts.close, task))

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
        return [done_though_forbidden(name, broken, self._ledger.clock.now())] if broken else []

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


def done_though_forbidden(name: str, prohibitions: Sequence[Task], now: Time) -> Prohibited:
    """The error that says so."""
    message = f"{name} was done, and {prohibitions_in_words(prohibitions, now)}"
    return prohibited(message, name, prohibitions, "it was begun before that")
