"""The monitor: silent while what is executed is due, and what it says when it is not."""

# ruff: noqa: F811 - the variants of a method share its name
# mypy: disable-error-code=no-redef

from __future__ import annotations

import asyncio

import contextpy3 as cop
import pytest

import sleec_runtime
from sleec_runtime import Monitor, Sleec, recording
from sleec_runtime.errors import NeedsAwait, SleecError, Unbindable, WrongArguments
from sleec_runtime.language import parse
from sleec_runtime.monitor.difference import Difference
from tests.support.robots import CURTAINS, listing_2, running

RULES = "RULE r1 WHEN a THEN Open AND Say UNLESS c IN WHICH CASE (Ask AND NOT Open)\nRULE r2 WHEN b THEN Wait"


class Hand:
    """Unmarked methods in snake case, all of which the monitor has to see."""

    def open(self) -> None: ...

    def say(self) -> None: ...

    def ask(self) -> None: ...

    def wait(self) -> None: ...

    def nod(self) -> None: ...

    def bow(self) -> None: ...


def hand_that_does(sleec: Sleec, *names: str) -> Hand:
    """A robot whose variants of r1 all do `names`, whatever the rule says."""

    class Robot(Hand):
        @sleec.rule("r1")
        @cop.base
        def request(self) -> None:
            for name in names:
                getattr(self, name)()

        @cop.around(sleec.layers["r1.hc1"])
        def request(self) -> None:
            cop.proceed()

    robot = Robot()
    sleec.bind(robot)
    sleec.implement({"Wait": robot.wait})
    return robot


@pytest.fixture
def sleec() -> Sleec:
    return running(RULES)


def differences(sleec: Sleec, *names: str, **conditions: bool) -> list[Difference]:
    hand_that_does(sleec, *names)
    sleec.update(conditions)
    found: list[Difference] = []
    with Monitor(sleec, found.append):
        sleec.trigger("a")
        sleec.trigger("b")
    return found


def test_it_is_silent_where_what_is_executed_is_due(sleec: Sleec) -> None:
    assert differences(sleec, "open", "say") == []


def test_it_is_silent_on_a_robot_that_is_properly_structured() -> None:
    curtains = running(CURTAINS)
    listing_2(curtains)
    found: list[Difference] = []
    with Monitor(curtains, found.append):
        for undressed in (False, True):
            curtains.update({"UserUndressed": undressed})
            curtains.trigger("CurtainOpenRequest")
    assert found == []


@pytest.mark.parametrize(
    ("plan", "words"),
    [
        (["open"], "not executed: Say"),
        (["open", "say", "ask"], "executed but not due: Ask"),
        (["say", "open"], "executed Say, Open where Open, Say was due"),
        (["open", "open", "say"], "executed Open, Open, Say where Open, Say was due"),
        ([], "not executed: Open, Say"),
    ],
)
def test_it_tells_what_was_executed_and_what_was_due(sleec: Sleec, plan: list[str], words: str) -> None:
    (difference,) = differences(sleec, *plan)
    assert str(difference) == f"a: {words}"
    assert difference.context.triggers == {"a"}


def test_it_tells_what_was_prohibited(sleec: Sleec) -> None:
    (difference,) = differences(sleec, "ask", "open", c=True)
    assert difference.prohibited == ("Open",)
    assert str(difference) == "a: executed but prohibited: Open"


def test_it_is_silent_where_the_prohibited_is_left_undone(sleec: Sleec) -> None:
    assert differences(sleec, "ask", c=True) == []


def test_what_raises_counts_as_not_executed(sleec: Sleec) -> None:
    class Broken:
        @sleec_runtime.obligation("Open")
        def open_up(self) -> None:
            raise RuntimeError("stuck")

        @sleec_runtime.obligation("Say")
        def say(self) -> None: ...

    sleec.implement(Broken())
    found: list[Difference] = []
    with Monitor(sleec, found.append), pytest.raises(RuntimeError, match="stuck"):
        sleec.trigger("a")
    (difference,) = found
    assert difference.missing == ("Open", "Say")


def test_each_dispatch_is_looked_at_for_itself(sleec: Sleec) -> None:
    found: list[Difference] = []

    def say() -> None:
        sleec.trigger("b")

    sleec.implement({"Open": lambda: None, "Say": say, "Wait": lambda: None})
    with recording() as outer, Monitor(sleec, found.append):
        sleec.trigger("a")
    assert found == []
    assert outer.executed == ["Open", "Say", "Wait"]


def test_it_looks_at_coroutines(sleec: Sleec) -> None:
    found: list[Difference] = []

    class Quiet:
        @sleec.rule("r1")
        async def request(self) -> None:
            await asyncio.sleep(0)

    sleec.bind(Quiet())
    with Monitor(sleec, found.append):
        asyncio.run(sleec.trigger_async("a"))
        asyncio.run(sleec.trigger_all_async(["a"]))
    assert [difference.missing for difference in found] == [("Open", "Say"), ("Open", "Say")]


def test_a_callback_that_raises_stops_the_caller(sleec: Sleec) -> None:
    hand_that_does(sleec)

    def stop(difference: Difference) -> None:
        raise SystemExit(str(difference))

    with Monitor(sleec, stop), pytest.raises(SystemExit, match="not executed"):
        sleec.trigger_all(["a"])


def test_it_sees_what_is_bound_while_it_is_on(sleec: Sleec) -> None:
    found: list[Difference] = []
    with Monitor(sleec, found.append):
        robot = hand_that_does(sleec, "open", "say")
        sleec.trigger("a")
        sleec.unbind("r1")
        hand_that_does(sleec, "open")
        sleec.trigger("a")
    assert [difference.missing for difference in found] == [("Say",)]
    assert vars(robot) == {}


def test_it_sees_obligations_that_come_with_a_replaced_ruleset(sleec: Sleec) -> None:
    robot = hand_that_does(sleec, "open", "say")
    helper = Hand()
    grown = parse(RULES + "\nRULE r3 WHEN d THEN Nod AND Bow")
    found: list[Difference] = []
    with Monitor(sleec, found.append, watch=[helper]):
        sleec.prepare(grown)

        @sleec.rule("r3")
        def request() -> None:
            robot.nod()
            helper.bow()

        sleec.replace(grown, bind=[request])
        sleec.trigger("a")
        sleec.trigger("d")
    assert found == []


def test_a_trigger_that_is_refused_before_anything_runs_is_no_difference(sleec: Sleec) -> None:
    async def wait(*args: object) -> None: ...

    hand_that_does(sleec, "open", "say")
    sleec.implement({"Wait": wait})
    found: list[Difference] = []
    with Monitor(sleec, found.append):
        with pytest.raises(WrongArguments):
            sleec.trigger("a", "please")
        with pytest.raises(WrongArguments):
            asyncio.run(sleec.trigger_async("a", "please"))
        with pytest.raises(NeedsAwait):
            sleec.trigger("b")
    assert found == []


def test_it_gives_back_the_attributes_that_it_stood_in_for(sleec: Sleec) -> None:
    robot = hand_that_does(sleec, "open", "say")
    done: list[str] = []
    robot.say = mine = lambda: done.append("mine")  # type: ignore[method-assign]
    with Monitor(sleec, print):
        sleec.trigger("a")
    assert vars(robot) == {"say": mine}
    assert done == ["mine"]


def test_what_cannot_be_watched_is_not_bound(sleec: Sleec) -> None:
    class Slots:
        __slots__ = ()

        @sleec.rule("r1")
        def request(self) -> None: ...

        def open(self) -> None: ...

    with Monitor(sleec, print):
        with pytest.raises(Unbindable, match="accepts no attributes"):
            sleec.bind(Slots())
        assert "r1" in sleec.missing()


def test_it_leaves_no_trace(sleec: Sleec) -> None:
    robot = hand_that_does(sleec)
    monitor = Monitor(sleec, print).start()
    assert "open" in vars(robot)
    with pytest.raises(SleecError, match="already"):
        Monitor(sleec, print).start()
    monitor.stop()
    monitor.stop()
    assert vars(robot) == {}
    sleec.trigger("b")


def test_an_object_that_takes_no_attributes_cannot_be_watched(sleec: Sleec) -> None:
    class Slots:
        __slots__ = ()

        def open(self) -> None: ...

    with pytest.raises(Unbindable, match="obligation"):
        Monitor(sleec, print, watch=[Slots()]).start()
    Monitor(sleec, print).start()
