"""An event loop on the clock of a scenario, so that coroutines wait in virtual time."""

from __future__ import annotations

import asyncio
import inspect
from collections.abc import Callable
from contextvars import Context
from typing import Any, TypeVar

from sleec_runtime.errors import SleecError
from sleec_verify.conformance.scenarios.clock import ScenarioClock

T = TypeVar("T")

_MOST_ROUNDS = 10_000


class ScenarioLoop(asyncio.SelectorEventLoop):
    """An event loop whose time is that of `clock`. A timer of the loop is an alarm of the clock."""

    def __init__(self, clock: ScenarioClock) -> None:
        # The base class reads the time.
        self._clock = clock
        self._callbacks = 0
        self._unfinished: list[asyncio.Task[object]] = []
        super().__init__()

    def time(self) -> float:
        return float(self._clock.now())

    def call_at(  # type: ignore[override]
        self, when: float, callback: Callable[..., object], *args: Any, context: Context | None = None
    ) -> asyncio.TimerHandle:
        timer = asyncio.TimerHandle(when, callback, args, self, context)

        def go_off() -> None:
            if not timer.cancelled():
                self.call_soon(callback, *args, context=context)

        self._clock.wake(when, go_off)
        return timer

    def call_soon(  # type: ignore[override]
        self, callback: Callable[..., object], *args: Any, context: Context | None = None
    ) -> asyncio.Handle:
        self._callbacks += 1
        return super().call_soon(callback, *args, context=context)

    def act(self, call: Callable[[], object], failed: Callable[[Exception], object]) -> None:
        """Makes a call within the loop, and runs the loop until everything in it waits for the clock.

        If the call returns a coroutine, it runs as a task. `failed` gets the exception of the call or of the coroutine.
        """
        self.run_until_complete(self._act(call, failed))

    def result_of(self, call: Callable[[], T]) -> T:
        """The result of a call within the loop."""

        async def within() -> T:
            return call()

        return self.run_until_complete(within())

    def stop_tasks(self) -> None:
        """Cancels what still waits, and closes the loop."""
        for task in asyncio.all_tasks(self):
            task.cancel()
        self.run_until_complete(self._settled())
        self.close()

    async def _act(self, call: Callable[[], object], failed: Callable[[Exception], object]) -> None:
        try:
            result = call()
        except Exception as error:  # noqa: BLE001 - handed on
            failed(error)
        else:
            if inspect.isawaitable(result):
                self._unfinished.append(self.create_task(_watched(result, failed)))
        await self._settled()
        self._unfinished = [task for task in self._unfinished if not task.done()]

    async def _settled(self) -> None:
        """Returns when only this coroutine is ready to run."""
        for _ in range(_MOST_ROUNDS):
            before = self._callbacks
            await asyncio.sleep(0)
            if self._callbacks == before + 1:
                return
        raise SleecError(
            "a coroutine of the robot runs without end at one time", "let it wait with `asyncio.sleep(seconds)`"
        )


async def _watched(awaitable: Any, failed: Callable[[Exception], object]) -> None:
    try:
        await awaitable
    except Exception as error:  # noqa: BLE001 - handed on
        failed(error)
