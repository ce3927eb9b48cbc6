"""Critical sections: changes that exclude each other, also within one thread."""

from __future__ import annotations

import threading
from collections.abc import Callable
from functools import wraps
from typing import Concatenate, ParamSpec, Protocol, TypeVar

from sleec_runtime.concurrency.fork import renew_after_fork
from sleec_runtime.errors import Reentrant

T = TypeVar("T")
P = ParamSpec("P")


class CriticalSection:
    """Makes one change at a time. Other threads wait; the same thread gets an error.

    The same thread enters again if a signal handler or a finalizer, which Python runs between any two steps of a
    thread, uses the object that is being changed. It cannot wait, and must not see a part of a change.
    """

    def __init__(self, undo: Callable[[], object] | None = None) -> None:
        """`undo` undoes the unfinished change of another thread, in a forked process."""
        # Reentrant, because a handler may also run just before or after a change, while the thread holds the lock.
        self._lock = threading.RLock()
        self._changing = False
        self._undo = undo
        renew_after_fork(self)

    def run(self, change: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> T:
        """Makes a change. Raises Reentrant within another change of this thread."""
        with self._lock:
            if self._changing:
                raise Reentrant
            try:
                self._changing = True
                return change(*args, **kwargs)
            finally:
                self._changing = False

    def refuse_reentry(self) -> None:
        """Raises Reentrant within a change by this thread."""
        with self._lock:
            if self._changing:
                raise Reentrant

    def after_fork(self) -> None:
        if self._lock.acquire(blocking=False):
            # Free, or held by the thread that forked.
            self._lock.release()
            return
        self._lock = threading.RLock()
        self._changing = False
        if self._undo is not None:
            self._undo()


class _HasSection(Protocol):
    _section: CriticalSection


S = TypeVar("S", bound=_HasSection)


def exclusive(method: Callable[Concatenate[S, P], T]) -> Callable[Concatenate[S, P], T]:
    """Makes a method a change in the critical section of its object."""

    @wraps(method)
    def change(self: S, /, *args: P.args, **kwargs: P.kwargs) -> T:
        return self._section.run(method, self, *args, **kwargs)

    return change
