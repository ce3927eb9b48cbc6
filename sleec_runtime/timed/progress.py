"""The progress of tasks: they are begun, done, replaced or withdrawn."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial

from sleec_runtime.timed.admission import Admission
from sleec_runtime.timed.cascade import Stage, alternative_stage
from sleec_runtime.timed.ledger import Ledger, transaction
from sleec_runtime.timed.refusals import done_though_forbidden
from sleec_runtime.timed.task import Task
from sleec_runtime.timed.unit import Unit


class Progress:
    """Changes the states of tasks while their code runs."""

    def __init__(self, admission: Admission, ledger: Ledger) -> None:
        self._admission = admission
        self._ledger = ledger

    @transaction
    def begin(self, unit: Unit) -> list[Task]:
        """Sets the open tasks of `unit` to "under way", and returns them."""
        tasks = [task for task in unit.tasks if task.is_open]
        for task in tasks:
            self._ledger.set(task, "state", "under way")
            self._ledger.set(task, "unit", None)
        return tasks

    def happened(self, name: str, task: Task) -> list[Exception]:
        """`name` is done for `task`. Returns an error if a prohibition forbids it."""
        _, broken = self._ledger.change(partial(self._ledger.note, name, task))
        return [done_though_forbidden(name, broken, self._ledger.clock.now())] if broken else []

    def failed(self, task: Task) -> list[Stage]:
        """The code of `task` raised. Returns the stages of its alternatives, which are on the agenda.

        Without alternatives, the task can still be done until its window closes. Raises as a dispatch does.
        """
        alternatives = task.instead
        if alternatives is not None and any(map(self._is_over, alternatives)):
            alternatives = None
        if alternatives is None and task.at_once:
            alternatives = task.otherwise
        if alternatives is not None:
            try:
                return self._replace(task, alternatives)
            except Exception:
                self._keep_open(task)
                raise
        self._keep_open(task)
        return []

    def _is_over(self, task: Task) -> bool:
        """Whether the window of an alternative has closed."""
        last = task.first if task.at_once else task.last
        return last is not None and last < self._ledger.clock.now()

    @transaction
    def _keep_open(self, task: Task) -> None:
        """Keeps the task open if it has a window."""
        if task.is_open and task.at_once:
            self._ledger.end(task, "missed")
        elif task.is_open:
            self._ledger.set(task, "state", "waiting")

    @transaction
    def _replace(self, task: Task, alternatives: tuple[Task, ...]) -> list[Stage]:
        if not task.is_open:
            return []
        self._ledger.end(task, "replaced")
        moment = self._admission.moment()
        stages = self._admission.closure(alternative_stage(task, alternatives, moment.snapshot), moment)
        self._admission.admit(stages, moment.now, in_loop=True)
        return stages

    @transaction
    def withdraw(self, tasks: Iterable[Task]) -> None:
        """Withdraws tasks whose event did not happen."""
        for task in tasks:
            if task.is_open:
                self._ledger.end(task, "withdrawn")
