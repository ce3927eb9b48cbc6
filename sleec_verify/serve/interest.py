"""Whether somebody waits for the answer of the current request. A page closes a request when the text has changed."""

from __future__ import annotations

from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager
from contextvars import ContextVar
from threading import Event, Lock

import anyio
from starlette.requests import Request

_INTERVAL = 0.05
"""The seconds between two checks whether the page has closed a request that waits for a lock."""

_abandoned: ContextVar[Event | None] = ContextVar("abandoned", default=None)


class Superseded(Exception):
    """Nobody waits for the answer."""


def require_interest() -> None:
    """Raises Superseded if the page has closed the current request."""
    abandoned = _abandoned.get()
    if abandoned is not None and abandoned.is_set():
        raise Superseded


@contextmanager
def held(lock: Lock) -> Iterator[None]:
    """Within the block, the current request holds the lock. Raises `Superseded` if the page closes the request, also
    while it waits: otherwise, such requests would take all threads of the server."""
    while not lock.acquire(timeout=_INTERVAL):
        require_interest()
    try:
        require_interest()
        yield
    finally:
        lock.release()


@asynccontextmanager
async def watched(request: Request) -> AsyncIterator[None]:
    """Within the block, `require_interest` is about this request, whose body has been read."""
    abandoned = Event()

    async def wait_for_disconnect() -> None:
        while (await request.receive())["type"] != "http.disconnect":
            pass
        abandoned.set()

    token = _abandoned.set(abandoned)
    try:
        async with anyio.create_task_group() as tasks:
            tasks.start_soon(wait_for_disconnect)
            yield
            tasks.cancel_scope.cancel()
    finally:
        _abandoned.reset(token)
