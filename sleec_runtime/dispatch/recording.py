"""Recordings: which obligations are executed, and in which order.

Tests and the monitor use a recording to see what a robot executes.
"""

from __future__ import annotations

import functools
import inspect
import types
from collections.abc import Awaitable, Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from contextvars import ContextVar
from typing import Any


class Recording:
    """The obligations that are executed while it is on: `executed` in order, and in `failed` those that raise.

    It sees its own thread and asyncio task, and the tasks that these start, but not other threads. An implementation
    that calls another implementation of the same obligation, such as an override that calls `super`, counts once.
    """

    def __init__(
        self,
        outer: Recording | None = None,
        apart: bool = False,
        on_execution: Callable[[str], object] | None = None,
        on_end: Callable[[str, BaseException | None], object] | None = None,
    ) -> None:
        self.executed: list[str] = []
        self.failed: list[str] = []
        self.outer = outer
        self.apart = apart
        self.on_execution = on_execution
        self.on_end = on_end
        self._under_way: set[str] = set()

    @contextmanager
    def executing(self, name: str) -> Iterator[list[Awaitable[object]]]:
        """Records that the block executes `name`. Yields the awaitables that `on_execution` has returned."""
        if name in self._under_way:
            yield []
            return
        self._under_way.add(name)
        self.executed.append(name)
        try:
            outer: AbstractContextManager[list[Awaitable[object]]]
            outer = nullcontext([]) if self.outer is None else self.outer.executing(name)
            with outer as returned:
                if self.on_execution is not None:
                    result = self.on_execution(name)
                    if inspect.isawaitable(result):
                        returned.append(result)
                yield returned
        except BaseException as error:
            self.failed.append(name)
            if self.on_end is not None:
                self.on_end(name, error)
            raise
        else:
            if self.on_end is not None:
                self.on_end(name, None)
        finally:
            self._under_way.discard(name)


_recording: ContextVar[Recording | None] = ContextVar("sleec_recording", default=None)


@contextmanager
def recording(
    apart: bool = False,
    on_execution: Callable[[str], object] | None = None,
    on_end: Callable[[str, BaseException | None], object] | None = None,
) -> Iterator[Recording]:
    """Records what the block executes.

    Recordings nest: an outer recording sees what an inner one sees. Recordings with `apart` do not report to each
    other, so that the monitor sees each dispatch separately. `on_execution` is called with each name when its execution
    begins; the implementation raises what it raises, and a coroutine function awaits what it returns, if that is
    awaitable. `on_end` is called with each name when its implementation has returned, raised or been awaited, and with
    the exception.
    """
    outer = _recording.get()
    while apart and outer is not None and outer.apart:
        outer = outer.outer
    inner = Recording(outer, apart, on_execution, on_end)
    token = _recording.set(inner)
    try:
        yield inner
    finally:
        _recording.reset(token)


def is_coroutine_function(function: Any) -> bool:
    """Whether a call of `function` returns a coroutine, as far as this can be known without a call."""
    if isinstance(function, (staticmethod, classmethod)):
        function = function.__func__
    return inspect.iscoroutinefunction(function) or inspect.iscoroutinefunction(type(function).__call__)


def recorded(name: str, function: Callable[..., Any]) -> Callable[..., Any]:
    """A wrapper of `function` that recordings see as `name`."""
    if is_coroutine_function(function):

        @functools.wraps(function)
        async def awaited(*args: Any, **kwargs: Any) -> Any:
            on = _recording.get()
            if on is None:
                return await function(*args, **kwargs)
            with on.executing(name) as returned:
                for awaitable in returned:
                    await awaitable
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
    """The callable that `recorded` wraps, which has the signature."""
    if isinstance(function, types.MethodType):
        plain = unrecorded(function.__func__)
        return function if plain is function.__func__ else functools.partial(plain, function.__self__)
    # A wrapper is recognised by its globals, because other decorators copy its attributes.
    ours = getattr(function, "__globals__", None) is globals()
    return unrecorded(function.__wrapped__) if ours and hasattr(function, "__wrapped__") else function
