"""Which callable does what a rule obliges, and what was done: marks, names, and recordings.

An obligation is implemented by the callable marked ``@obligation("OpenCurtains")``, or by the method that has its
name in snake case, ``open_curtains``. A recording is how tests and the monitor see what was executed.
"""

from __future__ import annotations

import functools
import inspect
import re
import types
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, nullcontext
from contextvars import ContextVar
from typing import Any, TypeVar

from sleec_runtime.errors import Unbindable
from sleec_runtime.support.messages import represent

F = TypeVar("F", bound=Callable[..., Any])

_MARK = "__sleec_obligation__"
_TAKES_TIME = "__sleec_takes_time__"
_WORD_BORDER = re.compile(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])")


class Recording:
    """What was executed while it was on, in order: `executed`, with those that raised in `failed` as well.

    It sees its own thread and asyncio task, and the tasks that these start; not other threads. What implements an
    obligation by another implementation of the same one, as an override that calls `super` does, is executed once.
    """

    def __init__(
        self,
        outer: Recording | None = None,
        apart: bool = False,
        on_execution: Callable[[str], object] | None = None,
    ) -> None:
        self.executed: list[str] = []
        self.failed: list[str] = []
        self.outer = outer
        self.apart = apart
        self.on_execution = on_execution
        self._under_way: set[str] = set()

    @contextmanager
    def executing(self, name: str) -> Iterator[None]:
        """Notes the execution of `name`, which is that of the block."""
        if name in self._under_way:
            yield
            return
        self._under_way.add(name)
        self.executed.append(name)
        try:
            with nullcontext() if self.outer is None else self.outer.executing(name):
                if self.on_execution is not None:
                    self.on_execution(name)
                yield
        except BaseException:
            self.failed.append(name)
            raise
        finally:
            self._under_way.discard(name)


_recording: ContextVar[Recording | None] = ContextVar("sleec_recording", default=None)


@contextmanager
def recording(apart: bool = False, on_execution: Callable[[str], object] | None = None) -> Iterator[Recording]:
    """Records what is executed within. Recordings nest: an outer one sees what an inner one sees, except that those
    kept `apart` do not report to each other, so that each dispatch can be looked at for itself.

    `on_execution` is called with each name as its execution begins: a test does there what may happen meanwhile, and
    what it raises, the implementation raises.
    """
    outer = _recording.get()
    while apart and outer is not None and outer.apart:
        outer = outer.outer
    inner = Recording(outer, apart, on_execution)
    token = _recording.set(inner)
    try:
        yield inner
    finally:
        _recording.reset(token)


def snake_case(name: str) -> str:
    """The name of the method that implements obligation `name`: ``AskLegalPresence`` is ``ask_legal_presence``."""
    return _WORD_BORDER.sub("_", name).lower()


def obligation(name: str, completes: bool = True) -> Callable[[F], F]:
    """Marks a function or method as the implementation of obligation `name`: impl(O) of the paper, Section 3.2.

    What it does is unchanged; each call of it is seen by the recordings that are on, at the cost of one look-up.
    `completes` is False for what is only begun when it returns: it is done when ``sleec.completed(name)`` says so.
    That matters in rulesets with times.
    """

    def mark(function: F) -> F:
        if isinstance(function, (staticmethod, classmethod)):
            return type(function)(mark(function.__func__))
        wrapper = recorded(name, function)
        setattr(wrapper, _MARK, name)
        setattr(wrapper, _TAKES_TIME, not completes)
        return wrapper  # type: ignore[return-value]

    return mark


def is_coroutine_function(function: Any) -> bool:
    """Whether calling `function` gives something to be awaited, as far as can be told without calling it."""
    if isinstance(function, (staticmethod, classmethod)):
        function = function.__func__
    return inspect.iscoroutinefunction(function) or inspect.iscoroutinefunction(type(function).__call__)


def recorded(name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    """`function`, seen by recordings under `name`."""
    if is_coroutine_function(function):

        @functools.wraps(function)
        async def awaited(*args: Any, **kwargs: Any) -> Any:
            on = _recording.get()
            if on is None:
                return await function(*args, **kwargs)
            with on.executing(name):
                return await function(*args, **kwargs)

        return awaited

    @functools.wraps(function, updated=())
    def called(*args: Any, **kwargs: Any) -> Any:
        on = _recording.get()
        if on is None:
            return function(*args, **kwargs)
        with on.executing(name):
            return function(*args, **kwargs)

    return called


def unrecorded(function: Callable[..., Any]) -> Callable[..., Any]:
    """What `recorded` was given: the callable that takes the arguments, and can say which."""
    if isinstance(function, types.MethodType):
        plain = unrecorded(function.__func__)
        return function if plain is function.__func__ else functools.partial(plain, function.__self__)
    # By its globals, because the marks of a wrapper are copied to whatever wraps it in turn.
    ours = getattr(function, "__globals__", None) is globals()
    return unrecorded(function.__wrapped__) if ours and hasattr(function, "__wrapped__") else function


def obligation_of(function: object) -> str | None:
    """The obligation that a callable is marked with."""
    name = getattr(function, _MARK, None)
    return name if isinstance(name, str) else None


def takes_time(function: object) -> bool:
    """Whether a callable is marked as one that only begins what it is to do."""
    return getattr(function, _TAKES_TIME, False) is True


def taking_time(robot: object) -> Iterator[str]:
    """The obligations that callables of `robot` (an object, a class or a module) only begin. O(attributes)."""
    owner = robot if isinstance(robot, type) else type(robot)
    attributes: dict[str, object] = {}
    for holder in (*reversed(owner.__mro__), robot):
        attributes.update(getattr(holder, "__dict__", {}))
    for attribute in attributes.values():
        function = _underlying(attribute)
        name = obligation_of(function)
        if name is not None and takes_time(function):
            yield name


def implementations(robot: object, obligations: Iterable[str]) -> dict[str, Callable[..., Any]]:
    """The callables of `robot` (an object or a module) that implement `obligations`; a mark goes before a name.

    O(attributes of robot + obligations).
    """
    wanted = dict.fromkeys(obligations)
    by_mark: dict[str, Callable[..., Any]] = {}
    for attribute in dir(robot):
        # Looked at without getting it, because a property may do something when it is read.
        name = obligation_of(_underlying(inspect.getattr_static(robot, attribute, None)))
        if name in wanted and name is not None:
            by_mark[name] = getattr(robot, attribute)
    found: dict[str, Callable[..., Any]] = {}
    for name in wanted:
        implementation = by_mark.get(name) or getattr(robot, snake_case(name), None)
        if callable(implementation):
            found[name] = implementation
    return found


def _underlying(attribute: object) -> object:
    return attribute.__func__ if isinstance(attribute, (staticmethod, classmethod)) else attribute


@contextmanager
def watched(robot: object, obligations: Iterable[str]) -> Iterator[None]:
    """Lets recordings see the unmarked implementations of `robot` too, by instance attributes in front of its methods,
    until the end of the block."""
    placed: list[str] = []
    # Attributes that the object had of its own come back.
    own = dict(getattr(robot, "__dict__", {}))
    for name, function in implementations(robot, obligations).items():
        if obligation_of(function) is None:
            if not hasattr(robot, "__dict__"):
                raise Unbindable(
                    f"{represent(robot)} takes no attributes, so its methods cannot be watched",
                    f'mark {function.__name__} with @sleec_runtime.obligation("{name}")',
                )
            # An attribute of the object itself is looked up before the method of its class.
            setattr(robot, snake_case(name), recorded(name, function))
            placed.append(snake_case(name))
    try:
        yield
    finally:
        for attribute in placed:
            if attribute in own:
                setattr(robot, attribute, own[attribute])
            else:
                delattr(robot, attribute)
