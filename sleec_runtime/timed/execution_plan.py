"""From what is due to the code that does it, and what starts when."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from types import CoroutineType
from typing import TYPE_CHECKING, Any

from sleec_runtime.dispatch.dispatch import refuse_misfit
from sleec_runtime.dispatch.implementations import is_coroutine_function
from sleec_runtime.dispatch.instance import Unfinished
from sleec_runtime.errors import NotBound
from sleec_runtime.model import Clause, Obligation, Rule, literals
from sleec_runtime.support.messages import listed

if TYPE_CHECKING:
    from sleec_runtime.dispatch.instance import Instance
    from sleec_runtime.dispatch.layers import Variant
    from sleec_runtime.timed.clocks import Time
    from sleec_runtime.timed.tasks import Origin, Task

Did = Callable[["Task"], object]
"""Told of each obligation that its callable has done."""


class Unit:
    """What is started together, from the time `at` on: a variant that was written for the clause, or the callables of
    `tasks`, one after the other."""

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
        """Whether it is known to need an event loop."""
        if self.written is not None:
            return self.written.asynchronous
        return any(is_coroutine_function(self.origin.instance.implementation(task.name)) for task in self.tasks)

    def variant(self, tasks: Iterable[Task], did: Did) -> Variant:
        """The code that does `tasks`, which are those of the unit that are open. It calls `did` for each obligation as
        its callable returns. A written variant does all tasks of the unit, and calls nothing."""
        if self.written is not None:
            return self.written
        instance, decision = self.origin.instance, self.origin.decision
        functions = []
        for task in tasks:
            function = instance.implementation(task.name)
            assert function is not None, "refused before anything was decided"
            functions.append(function if task.name in instance.takes_time else _telling(function, task, did))
        return instance.composed(
            decision.rule.label, None if self.tasks[0].is_alternative else decision.layer, functions
        )


def units_of(origin: Origin, tasks: Iterable[Task]) -> tuple[Unit, ...]:
    """What does what the active clause of a rule asks for. Raises NotBound and WrongArguments,
    for what may come in its place, too."""
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
    """The callables of all `tasks` that are due first as one unit, and each of the others as another."""
    to_do = [task for task in tasks if not task.literal.negated]
    if not to_do:
        return ()
    first = min(task.first for task in to_do)
    units = [Unit(origin, tuple(task for task in to_do if task.first == first), first)]
    units += [Unit(origin, (task,), task.first) for task in to_do if task.first != first]
    return tuple(units)


def _refuse_misfits_of(task: Task, with_itself: bool) -> None:
    """Raises WrongArguments if what does `task`, or what may come in its place, does not take the arguments."""
    if with_itself and not task.literal.negated:
        # What records it takes anything.
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


def require_code(rule: Rule, clause: Clause, instance: Instance) -> None:
    """Raises NotBound if what `clause` says of time could not be done by the code that there is."""
    if instance.has_method(rule.label):
        require_one_start(rule, clause)
    for obligation in clause.obligations:
        require_alternatives(rule, obligation, instance)


def require_one_start(rule: Rule, clause: Clause) -> None:
    """Raises NotBound for a method of a clause whose windows open at different times: it can be called but once."""
    starts = {_start(obligation) for obligation in clause.obligations if not obligation.negated}
    if len(starts) > 1:
        raise NotBound(
            f"a clause of rule {rule.label} asks for things at different times, which one method cannot do",
            [rule.label],
            "unbind() its method, and implement() each obligation; or write two rules",
        )


def _start(obligation: Obligation) -> object:
    window = None if obligation.timing is None else obligation.timing.window
    if window is None or window.start is None:
        return 0
    return str(window.start) if window.start.measures else window.start.seconds


def require_alternatives(rule: Rule, obligation: Obligation, instance: Instance) -> None:
    """Raises NotBound if an obligation behind `otherwise` or `else` has no callable: no method is written for those."""
    if obligation.timing is None:
        return
    names = [
        literal.name
        for alternative in obligation.timing.alternatives()
        for literal in literals(alternative)
        if not literal.negated and instance.implementation(literal.name) is None
    ]
    if names:
        raise NotBound(
            f"rule {rule.label} may ask for {listed(dict.fromkeys(names))} in place of {obligation}, "
            "and there is no callable for it",
            [rule.label],
            "implement() it: what is due in place of something else has no variant",
        )


def _telling(function: Callable[..., Any], task: Task, did: Did) -> Callable[..., Any]:
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
