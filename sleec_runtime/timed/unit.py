"""Units: the code that starts together, and when."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from types import CoroutineType
from typing import Any

from sleec_runtime.dispatch.plan import refuse_misfit
from sleec_runtime.dispatch.recording import is_coroutine_function
from sleec_runtime.dispatch.required_code import require_alternatives, require_one_start
from sleec_runtime.dispatch.variants import Unfinished, Variant
from sleec_runtime.timed.clock import Time
from sleec_runtime.timed.task import Origin, Task

Did = Callable[[Task], object]
"""Called with each task when its callable has returned."""


class Unit:
    """The code that starts together at the time `at`: the `written` variant of a clause, or the callables of `tasks` in
    order."""

    __slots__ = ("at", "origin", "tasks", "written")

    def __init__(self, origin: Origin, tasks: tuple[Task, ...], at: Time, written: Variant | None = None) -> None:
        self.origin = origin
        self.tasks = tasks
        self.at = at
        self.written = written
        for task in tasks:
            task.unit = self

    @property
    def asynchronous(self) -> bool:
        """Whether it contains a coroutine function."""
        if self.written is not None:
            return self.written.asynchronous
        return any(is_coroutine_function(self.origin.instance.implementation(task.name)) for task in self.tasks)

    def variant(self, tasks: Iterable[Task], did: Did) -> Variant:
        """The code of `tasks`, the open tasks of the unit. It calls `did` for each task when its callable returns. A
        written variant is the code of all tasks, and does not call `did`."""
        if self.written is not None:
            return self.written
        instance, decision = self.origin.instance, self.origin.decision
        functions = []
        for task in tasks:
            function = instance.implementation(task.name)
            assert function is not None, "refused before the decision"
            functions.append(function if task.name in instance.takes_time else _reporting(function, task, did))
        return instance.composed(
            decision.rule.label, None if self.tasks[0].is_alternative else decision.layer, functions
        )


def units_of(origin: Origin, tasks: Iterable[Task]) -> tuple[Unit, ...]:
    """The units of the active clause of a rule. Raises NotBound and WrongArguments, also for the code of
    alternatives."""
    decision, instance = origin.decision, origin.instance
    clause = list(decision.rule.clauses())[decision.clause]
    written = instance.variant(decision.rule, decision.clause, clause)
    tasks = tuple(tasks)
    for task in tasks:
        require_alternatives(decision.rule, task.literal, instance)
    method = written if instance.has_method(decision.rule.label) else None
    if method is not None:
        _refuse_misfits(origin, method, method.called)
    for task in tasks:
        _refuse_misfits_of(task, with_itself=method is None)
    to_do = tuple(task for task in tasks if not task.literal.negated)
    if method is not None:
        require_one_start(decision.rule, clause)
        return (Unit(origin, to_do, to_do[0].first if to_do else origin.moment, method),)
    return composed_units(origin, to_do)


def composed_units(origin: Origin, tasks: Iterable[Task]) -> tuple[Unit, ...]:
    """The units of `tasks` without a written variant: one for all tasks that are due first, and one for each other."""
    to_do = [task for task in tasks if not task.literal.negated]
    if not to_do:
        return ()
    first = min(task.first for task in to_do)
    units = [Unit(origin, tuple(task for task in to_do if task.first == first), first)]
    units += [Unit(origin, (task,), task.first) for task in to_do if task.first != first]
    return tuple(units)


def _refuse_misfits_of(task: Task, with_itself: bool) -> None:
    """Raises WrongArguments if the arguments do not fit the code of `task` or of its alternatives."""
    if with_itself and not task.literal.negated:
        # The callable as given: its recorded wrapper accepts any arguments.
        function = task.origin.instance.given(task.name)
        assert function is not None, "refused before"
        _refuse_misfits(task.origin, task.name, (function,))
    for alternative in (*(task.otherwise or ()), *(task.instead or ())):
        _refuse_misfits_of(alternative, with_itself=True)


def _refuse_misfits(origin: Origin, of: object, functions: Iterable[Callable[..., Any]]) -> None:
    shape = (of, len(origin.args), *origin.kwargs)
    fitting = origin.instance.fitting
    if shape not in fitting:
        for function in functions:
            refuse_misfit(origin.rule.label, function, origin.args, origin.kwargs)
        fitting.add(shape)


def _reporting(function: Callable[..., Any], task: Task, did: Did) -> Callable[..., Any]:
    if is_coroutine_function(function):

        async def awaited(*args: Any, **kwargs: Any) -> None:
            await function(*args, **kwargs)
            did(task)

        return awaited

    def called(*args: Any, **kwargs: Any) -> object:
        result = function(*args, **kwargs)
        if type(result) is CoroutineType:
            return Unfinished(result, [lambda: did(task)], (), {})
        did(task)
        return None

    return called
