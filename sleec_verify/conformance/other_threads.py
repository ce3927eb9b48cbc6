"""Other threads: what a trigger starts in threads and pools counts, and the test waits for it."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import contextmanager, suppress
from contextvars import ContextVar, copy_context
from functools import partial
from typing import Any

SECONDS = 1.0
"""How long the test waits, after each trigger, for the threads that it started. A thread that runs longer is not
waited for again."""

_Started = list["threading.Thread | Future[Any]"]
_started: ContextVar[_Started | None] = ContextVar("sleec_started_threads", default=None)


class Provoked(Exception):
    """An exception that the test raises in the code of the robot. It ends a thread without a report."""


@contextmanager
def followed() -> Iterator[None]:
    """Within the block, threads and tasks of pools that are started within `awaited` run in the context of their
    start, so that recordings see them."""
    start, submit = threading.Thread.start, ThreadPoolExecutor.submit

    def started(thread: threading.Thread) -> None:
        found = _started.get()
        if found is not None and not _is_of_a_pool(thread):
            found.append(thread)
            thread.run = partial(copy_context().run, _run, thread.run)  # type: ignore[method-assign]
        start(thread)

    def submitted(pool: ThreadPoolExecutor, call: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        found = _started.get()
        if found is None:
            return submit(pool, call, *args, **kwargs)
        future = submit(pool, copy_context().run, call, *args, **kwargs)
        found.append(future)
        return future

    threading.Thread.start = started  # type: ignore[method-assign, assignment]
    ThreadPoolExecutor.submit = submitted  # type: ignore[method-assign, assignment]
    try:
        yield
    finally:
        threading.Thread.start = start  # type: ignore[method-assign]
        ThreadPoolExecutor.submit = submit  # type: ignore[method-assign]


@contextmanager
def awaited() -> Iterator[None]:
    """At the end of the block, waits for what it started in other threads, also by these, up to `SECONDS`."""
    found: _Started = []
    token = _started.set(found)
    try:
        yield
    finally:
        _started.reset(token)
        until = time.monotonic() + SECONDS
        for one in found:  # It grows when a thread starts another one.
            left = max(0.0, until - time.monotonic())
            if isinstance(one, Future):
                wait([one], left)
            elif one is not threading.current_thread():
                one.join(left)


def _run(work: Callable[[], object]) -> None:
    with suppress(Provoked):
        work()


def _is_of_a_pool(thread: threading.Thread) -> bool:
    """Whether a pool started a thread, which lives as long as the pool."""
    target = getattr(thread, "_target", None)
    return getattr(target, "__module__", "") == "concurrent.futures.thread"
