"""Triggers from asyncio: coroutine variants, each with its own layer in every step, whatever else runs between."""

# ruff: noqa: F811 - the variants of a method share its name
# mypy: disable-error-code=no-redef

from __future__ import annotations

import asyncio
import functools
import gc

import contextpy3 as cop
import pytest

from sleec_runtime import Sleec, recording
from sleec_runtime.errors import NeedsAwait, VariantsFailed
from tests.support.robots import CURTAINS, Log, running

REQUEST = "CurtainOpenRequest"


class Curtains(Log):
    """Tells in which layer it finds itself before and after it waited."""

    def __init__(self, sleec: Sleec) -> None:
        super().__init__()
        log = self.log

        class Robot:
            @sleec.rule("dress_assist")
            @cop.base
            async def request(self, pause):
                await self.wait(pause)

            @cop.around(sleec.layers["dress_assist.hc1"])
            async def request(self, pause):
                await self.wait(pause)

            @cop.around(sleec.layers["dress_assist.hc2"])
            async def request(self, pause):
                await self.wait(pause)
                await cop.proceed(pause)

            async def wait(self, pause):
                before = self.where()
                await pause()
                log.append(f"{before}-{self.where()}")

            @cop.base
            def where(self):
                return "base"

            @cop.around(sleec.layers["dress_assist.hc1"])
            def where(self):
                return "hc1"

            @cop.around(sleec.layers["dress_assist.hc2"])
            def where(self):
                return "hc2"

        sleec.bind(Robot())


async def moment() -> None:
    await asyncio.sleep(0)


def test_two_dispatches_take_turns_and_each_keeps_its_layer() -> None:
    sleec = running(CURTAINS)
    robot = Curtains(sleec)

    async def main() -> None:
        sleec.update({"UserUndressed": True})
        first = asyncio.create_task(sleec.trigger_async(REQUEST, moment))
        await moment()
        sleec.update({"UserDistressed": True})
        second = asyncio.create_task(sleec.trigger_all_async([REQUEST], moment))
        await moment()
        sleec.update({"UserUndressed": False})
        third = await sleec.trigger_async(REQUEST, moment)
        assert [d.clauses[0].clause for d in (await first, await second, third)] == [1, 2, 0]

    asyncio.run(main())
    assert sorted(robot.log) == ["base-base", "hc1-hc1", "hc2-hc2", "hc2-hc2"]
    assert cop._TLS.active_layers == ()
    assert cop._TLS.context is None


def test_a_variant_may_catch_what_it_awaits() -> None:
    sleec = running("RULE r WHEN a THEN Try")
    log = Log()

    async def attempt() -> None:
        try:
            await asyncio.wait_for(asyncio.Event().wait(), 0.001)
        except asyncio.TimeoutError:
            log.do("gave up")

    sleec.implement({"Try": attempt})
    asyncio.run(sleec.trigger_async("a"))
    assert log.taken() == ["gave up"]


def test_a_dispatch_can_be_cancelled_and_dropped() -> None:
    sleec = running(CURTAINS)
    robot = Curtains(sleec)

    async def forever() -> None:
        await asyncio.Event().wait()

    async def main() -> None:
        task = asyncio.create_task(sleec.trigger_async(REQUEST, forever))
        await moment()
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task
        dropped = sleec.trigger_async(REQUEST, moment)
        dropped.send(None)
        dropped.close()
        await sleec.trigger_async(REQUEST, moment)

    asyncio.run(main())
    assert robot.taken() == ["base-base"]


def test_functions_and_coroutine_functions_run_in_the_order_of_the_clause() -> None:
    sleec = running("RULE r1 WHEN a THEN One AND Two AND Three\nRULE r2 WHEN a THEN Four")
    log = Log()

    async def one() -> None:
        await moment()
        log.log.append("One")

    class Two:
        async def __call__(self) -> None:
            log.log.append("Two")

    sleec.implement(
        {"One": one, "Two": Two(), "Three": lambda: log.log.append("Three"), "Four": lambda: log.log.append("Four")}
    )
    with recording() as seen:
        done = asyncio.run(sleec.trigger_async("a"))
    assert log.taken() == list(done.obligations) == seen.executed == ["One", "Two", "Three", "Four"]


def test_a_coroutine_that_nobody_would_await_is_refused_before_anything_runs() -> None:
    sleec = running("RULE r1 WHEN a THEN One\nRULE r2 WHEN a THEN Two")
    log = Log()

    async def two() -> None:
        raise AssertionError("not to be run")

    sleec.implement({"One": lambda: log.do("One"), "Two": two})
    with pytest.raises(NeedsAwait, match="trigger_async"):
        sleec.trigger("a")
    assert log.taken() == []


def test_a_coroutine_that_could_not_be_foreseen_is_no_silent_success() -> None:
    sleec = running("RULE r WHEN a THEN One")

    async def one() -> None: ...

    class Robot:
        @sleec.rule("r")
        def request(self):
            return one()

    sleec.bind(Robot())
    with pytest.raises(NeedsAwait, match="returned a coroutine"):
        sleec.trigger("a")
    gc.collect()
    asyncio.run(sleec.trigger_async("a"))


def test_errors_come_out_after_all_variants() -> None:
    sleec = running(
        "RULE r1 WHEN a THEN Fail\nRULE r2 WHEN a THEN Help\nRULE r3 WHEN b THEN Fail\nRULE r4 WHEN b THEN Fail"
    )
    log = Log()

    async def fail() -> None:
        raise RuntimeError("stuck")

    sleec.implement({"Fail": fail, "Help": lambda: log.log.append("Help")})
    with recording() as seen, pytest.raises(RuntimeError, match="stuck"):
        asyncio.run(sleec.trigger_async("a"))
    assert (seen.executed, seen.failed) == (["Fail", "Help"], ["Fail"])
    with pytest.raises(VariantsFailed):
        asyncio.run(sleec.trigger_async("b"))
    sleec.implement({"Help": lambda: 1 // 0})
    with pytest.raises(VariantsFailed, match=r"r1: RuntimeError.*r2: ZeroDivisionError"):
        asyncio.run(sleec.trigger_async("a"))


def test_a_coroutine_that_a_callable_returns_is_awaited_or_refused() -> None:
    log: list[str] = []

    async def later(name: str) -> None:
        log.append(name)

    class Later:
        async def __call__(self) -> None:
            log.append("o3")

    sleec = running("RULE r WHEN a THEN o1 AND o2 AND o3 AND o4")
    sleec.implement({"o1": lambda: later("o1"), "o2": functools.partial(later, "o2"), "o3": Later(), "o4": list})
    with pytest.raises(NeedsAwait):
        sleec.trigger("a")
    asyncio.run(sleec.trigger_async("a"))
    assert log == ["o1", "o2", "o3"]
    log.clear()
    sleec.implement({"o2": list, "o3": lambda: later("o3")})
    with pytest.raises(NeedsAwait):
        sleec.trigger("a")
    assert log == []
    asyncio.run(sleec.trigger_async("a"))
    assert log == ["o1", "o3"]
