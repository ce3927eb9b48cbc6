"""Instrumentation of the robot's code: recordings see each implementation of an obligation, however it is called.

The methods of a watched object are wrapped in its classes, so that a call through a class or through `super` is seen,
too. Calls with other objects of these classes do not count.
"""

from __future__ import annotations

import inspect
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from functools import wraps
from types import FunctionType, MethodType, ModuleType
from typing import Any

from sleec_runtime.dispatch.implementations import implementations, obligation_of, snake_case, watched
from sleec_runtime.dispatch.recording import is_coroutine_function, recorded, unrecorded


def robots_of(callables: Iterable[object]) -> Iterator[object]:
    """The objects of bound methods, and the modules of functions."""
    for function in callables:
        if isinstance(function, MethodType):
            yield function.__self__
        elif isinstance(function, FunctionType):
            plain = inspect.unwrap(unrecorded(function))
            module = sys.modules.get(getattr(plain, "__module__", None) or "")
            if isinstance(plain, FunctionType) and module is not None:
                yield module


@contextmanager
def instrumented(robots: Iterable[object], obligations: Iterable[str]) -> Iterator[None]:
    """Within the block, recordings see each implementation of `obligations` by `robots` (objects, classes and modules).
    Raises Unbindable for a method that cannot be wrapped."""
    wanted = tuple(obligations)
    with ExitStack() as undo:
        for robot in {id(robot): robot for robot in robots}.values():
            left = set(wanted)
            if not isinstance(robot, ModuleType):
                for name in implementations(robot, wanted):
                    if _in_classes(undo, robot, name):
                        left.discard(name)
            undo.enter_context(watched(robot, [name for name in wanted if name in left]))
        yield


def _in_classes(undo: ExitStack, robot: object, name: str) -> bool:
    """Wraps the definitions of an obligation in the classes of `robot`. Returns whether nothing is left to wrap."""
    attribute = snake_case(name)
    if attribute in getattr(robot, "__dict__", {}) and not isinstance(robot, type):
        return False
    own = robot if isinstance(robot, type) else type(robot)
    holders = [holder for holder in own.__mro__ if attribute in vars(holder)]
    if not holders:
        return False  # It is marked, and has another name.
    for holder in holders:
        before = vars(holder)[attribute]
        wrapped = _wrapped(before, name, None if isinstance(robot, type) else robot)
        if wrapped is None:
            return False
        try:
            setattr(holder, attribute, wrapped)
        except TypeError:
            return False  # A class that accepts no attributes.
        undo.callback(setattr, holder, attribute, before)
    return True


def _wrapped(before: object, name: str, robot: object | None) -> object | None:
    """An attribute of a class that records calls with `robot`; None if it is not a function."""
    if isinstance(before, (staticmethod, classmethod)):
        inner = before.__func__
        seen = inner if obligation_of(inner) is not None else recorded(name, inner)
        return type(before)(seen)
    if not isinstance(before, FunctionType):
        return None
    if obligation_of(before) is not None:
        return before
    return recorded(name, before) if robot is None else _for(robot, before, recorded(name, before))


def _for(robot: object, before: Callable[..., Any], seen: Callable[..., Any]) -> Callable[..., Any]:
    """The function `seen` where `robot` is the object, and `before` elsewhere."""

    if is_coroutine_function(before):

        @wraps(before)
        async def awaited(*args: Any, **kwargs: Any) -> Any:
            return await (seen if args and args[0] is robot else before)(*args, **kwargs)

        return awaited

    @wraps(before)
    def called(*args: Any, **kwargs: Any) -> Any:
        return (seen if args and args[0] is robot else before)(*args, **kwargs)

    return called
