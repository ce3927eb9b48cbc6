"""Asynchronous robots: without and with time, nested triggers, and a mixture with code that is not asynchronous."""

from __future__ import annotations

import asyncio

import contextpy3 as cop
import pytest

from sleec_runtime import AsyncioClock, Sleec, obligation
from sleec_runtime.language import parse
from sleec_verify.conformance import Nonconformance, check_conformance

RULES = parse("""
RULE call WHEN Call THEN Speak AND Wave UNLESS Asleep IN WHICH CASE Wait
RULE knock WHEN Knock THEN Open UNLESS Asleep IN WHICH CASE Speak
""")

TIMED = parse("""
RULE call WHEN Call THEN Speak WITHIN 10 seconds OTHERWISE Ring WITHIN 5 seconds UNLESS Asleep IN WHICH CASE Wait
RULE quiet WHEN NightFalls THEN NOT Ring WITHIN 60 seconds
RULE knock WHEN Knock THEN Open UNLESS Asleep IN WHICH CASE Speak WITHIN 5 TO 30 seconds
""")


def made(rules, asynchronous, clock=None, slow=(), **options) -> Sleec:
    """An instance whose `asynchronous` obligations are coroutine functions."""
    sleec = Sleec(rules, clock=clock, on_error=lambda failure: None, **options)
    for name in sorted(rules.obligations):

        async def awaited() -> None:
            await asyncio.sleep(0)

        code = awaited if name in asynchronous else lambda: None
        sleec.implement({name: obligation(name, completes=name not in slow)(code)})
    return sleec


@pytest.mark.parametrize("asynchronous", [{"Speak"}, {"Wave", "Open"}, RULES.obligations], ids=["one", "two", "all"])
def test_an_asynchronous_robot_passes(asynchronous) -> None:
    check_conformance(lambda: made(RULES, asynchronous), examples=20)


class _Written:
    """Methods written by hand, of which some are coroutine functions."""

    def __init__(self, sleec: Sleec, again: bool) -> None:
        self.sleec = sleec
        self.again = again

    async def speak(self) -> None: ...
    def wave(self) -> None: ...
    async def wait(self) -> None: ...
    async def open(self) -> None: ...


def written(again: bool) -> Sleec:
    """A robot that looks `again` at a condition, after a coroutine."""
    sleec = Sleec(RULES)

    class Robot(_Written):
        @sleec.rule("call")
        @cop.base
        async def call(self) -> None:
            await self.speak()
            if not (self.again and self.sleec.conditions.get("Asleep")):
                self.wave()

        @cop.around(sleec.layers["call.hc1"])  # type: ignore[no-redef]
        async def call(self) -> None:  # noqa: F811
            await self.wait()

        @sleec.rule("knock")
        @cop.base
        async def knock(self) -> None:
            await self.open()

        @cop.around(sleec.layers["knock.hc1"])  # type: ignore[no-redef]
        async def knock(self) -> None:  # noqa: F811
            await self.speak()

    sleec.bind(Robot(sleec, again))
    return sleec


def test_methods_written_by_hand_pass() -> None:
    check_conformance(lambda: written(again=False), examples=20)


def test_a_condition_that_changes_while_a_coroutine_runs_is_found() -> None:
    check_conformance(lambda: written(again=True), parts=["each-rule", "together"], examples=20)
    with pytest.raises(Nonconformance, match="did not execute Wave") as caught:
        check_conformance(lambda: written(again=True), parts=["changes"], examples=400)
    assert any("while Speak is executed" in step for step in caught.value.before)


def test_a_wrong_asynchronous_robot_fails() -> None:
    def make() -> Sleec:
        sleec = made(RULES, RULES.obligations)

        async def nothing() -> None: ...

        sleec.implement({"Speak": sleec._instance.implementation("Open"), "Open": nothing})
        return sleec

    with pytest.raises(Nonconformance, match="Speak"):
        check_conformance(make, parts=["each-rule"])


@pytest.mark.slow
@pytest.mark.parametrize("chains", [False, True])
@pytest.mark.parametrize("loop", [False, True], ids=["the given clock", "AsyncioClock"])
@pytest.mark.parametrize("slow", [(), ("Speak",)], ids=["at return", "completed later"])
def test_an_asynchronous_robot_with_deadlines_passes(chains, loop, slow) -> None:
    def make(clock):
        return made(TIMED, {"Speak", "Ring"}, AsyncioClock() if loop else clock, slow, chains=chains)

    check_conformance(make, examples=30)


def test_a_coroutine_that_takes_too_long_is_late() -> None:
    rules = parse("RULE knock WHEN Knock THEN Speak WITHIN 5 TO 30 seconds")

    def make(clock, seconds):
        sleec = made(rules, (), clock)

        async def speak() -> None:
            await asyncio.sleep(seconds)

        sleec.implement({"Speak": speak})
        return sleec

    check_conformance(lambda clock: make(clock, 25), examples=30)
    with pytest.raises(Nonconformance, match="did not execute Speak by 30 s"):
        check_conformance(lambda clock: make(clock, 26), parts=["each-rule"])
