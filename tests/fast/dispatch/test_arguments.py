"""Arguments that do not fit the code of one rule are found before the code of any runs."""

# ruff: noqa: F811 - the variants of a method share its name
# mypy: disable-error-code=no-redef

from __future__ import annotations

import asyncio
import functools
import inspect
import types
from collections.abc import Callable
from typing import Any

import contextpy3 as cop
import pytest

from sleec_runtime import Monitor, obligation
from sleec_runtime.errors import Unbindable, WrongArguments
from tests.support.robots import running

TWO = "RULE r1 WHEN a THEN o1\nRULE r2 WHEN a THEN o2"


def test_nothing_runs_because_the_code_of_a_later_rule_does_not_take_the_arguments() -> None:
    sleec = running(TWO)
    done: list[str] = []

    def first(*args: object) -> None:
        done.append("o1")

    sleec.implement({"o1": first, "o2": lambda: done.append("o2")})
    with pytest.raises(WrongArguments, match="of rule `r2`, cannot be called with these arguments: too many") as caught:
        sleec.trigger("a", "please")
    assert isinstance(caught.value, TypeError)
    assert done == []
    sleec.trigger("a")
    assert done == ["o1", "o2"]


def test_names_count_as_places_do() -> None:
    sleec = running(TWO)
    done: list[object] = []

    def first(message: object) -> None:
        done.append(message)

    def second(*, message: object) -> None:
        done.append(message)

    sleec.implement({"o1": first, "o2": second})
    with pytest.raises(WrongArguments, match="r2"):
        sleec.trigger("a", "please")
    with pytest.raises(WrongArguments, match="r1"):
        sleec.trigger("a", text="please")
    sleec.trigger("a", message="please")
    assert done == ["please", "please"]


def test_methods_static_methods_and_what_has_no_signature() -> None:
    sleec = running(TWO + "\nRULE r3 WHEN b THEN o3")
    done: list[object] = []

    class Robot:
        @sleec.rule("r1")
        @cop.base
        def first(self, message: str) -> None:
            done.append(message)

        @sleec.rule("r2")
        @staticmethod
        def second() -> None:
            done.append("second")

    sleec.bind(Robot())
    with pytest.raises(WrongArguments, match="`second`, the code of rule `r2`"):
        sleec.trigger("a", "please")
    with pytest.raises(WrongArguments, match="`first`, the code of rule `r1`"):
        sleec.trigger("a")
    assert done == []
    sleec.implement({"o3": dict})
    sleec.trigger("b", [("any", "thing")])


def test_coroutines_are_asked_too() -> None:
    sleec = running(TWO)
    done: list[str] = []

    async def second() -> None:
        done.append("o2")

    sleec.implement({"o1": lambda *args: done.append("o1"), "o2": second})
    with pytest.raises(WrongArguments):
        asyncio.run(sleec.trigger_async("a", "please"))
    assert done == []
    asyncio.run(sleec.trigger_async("a"))
    assert done == ["o1", "o2"]


def test_two_variants_on_one_layer_are_refused() -> None:
    sleec = running(
        "RULE r1 WHEN a THEN o1 UNLESS c IN WHICH CASE o2\nRULE r2 WHEN b THEN o1 UNLESS c IN WHICH CASE o2"
    )

    class Twice:
        @sleec.rule("r1")
        @cop.base
        def method(self) -> None: ...

        @cop.around(sleec.layers["r1.hc1"])
        def method(self) -> None: ...

        @cop.around(sleec.layers["r1.hc1"])
        def method(self) -> None: ...

    with pytest.raises(Unbindable, match=r"two variants on layer r1\.hc1"):
        sleec.bind(Twice())

    class Astray:
        @sleec.rule("r1")
        @cop.base
        def method(self) -> None: ...

        @cop.around(sleec.layers["r2.hc1"])
        def method(self) -> None: ...

    with pytest.raises(Unbindable, match=r"on layer `r2\.hc1`, but is the method of r1"):
        sleec.bind(Astray())
    assert set(sleec.missing()) == {"r1", "r2"}

    class Advised:
        @sleec.rule("r1")
        @cop.base
        def method(self) -> None: ...

        @cop.before(sleec.layers["r2.hc1"])
        def method(self) -> None: ...

    with pytest.raises(Unbindable, match=r"on layer `r2\.hc1`, but is the method of r1"):
        sleec.bind(Advised())

    elsewhere = cop.Layer("elsewhere")

    class TwiceElsewhere:
        @sleec.rule("r1")
        @cop.base
        def method(self) -> None: ...

        @cop.around(elsewhere)
        def method(self) -> None: ...

        @cop.around(elsewhere)
        def method(self) -> None: ...

    with pytest.raises(Unbindable, match="two variants on layer <layer elsewhere>"):
        sleec.bind(TwiceElsewhere())


def test_functions_of_one_name_are_looked_at_each_for_itself() -> None:
    sleec = running("RULE r1 WHEN a THEN o1\nRULE r2 WHEN b THEN o1 UNLESS c IN WHICH CASE o2")

    def made(label: str) -> object:
        @sleec.rule(label)
        @cop.base
        def method() -> None: ...

        @cop.around(sleec.layers["r2.hc1"])
        def method() -> None: ...

        return method

    module = types.ModuleType("module")
    vars(module).update(first=made("r1"), second=made("r2"))
    with pytest.raises(Unbindable, match=r"on layer `r2\.hc1`, but is the method of r1"):
        sleec.bind(module)


def test_a_class_may_serve_two_instances() -> None:
    one = running("RULE r1 WHEN a THEN o1 UNLESS c IN WHICH CASE o2")
    two = running("RULE r2 WHEN a THEN o1 UNLESS c IN WHICH CASE o2")

    class Shared:
        @one.rule("r1")
        @two.rule("r2")
        @cop.base
        def method(self) -> None: ...

        @cop.around(one.layers["r1.hc1"])
        def method(self) -> None: ...

        @cop.around(two.layers["r2.hc1"])
        def method(self) -> None: ...

    for sleec in (one, two):
        sleec.bind(Shared())
        assert not sleec.missing()


def test_what_a_decorator_wraps_does_not_say_what_it_takes() -> None:
    sleec = running(TWO)
    done: list[object] = []

    def with_a_reason(function: Callable[[str, str], None]) -> Callable[[str], None]:
        @functools.wraps(function)
        def wrapper(message: str) -> None:
            function("a reason", message)

        return wrapper

    @obligation("o2")
    @with_a_reason
    def second(reason: str, message: str) -> None:
        done.append((reason, message))

    @with_a_reason
    @obligation("o1")
    def first(reason: str, message: str) -> None:
        done.append((reason, message))

    sleec.implement({"o1": first, "o2": second})
    sleec.trigger("a", "please")
    assert done == [("a reason", "please")] * 2
    with pytest.raises(WrongArguments, match="r1"):
        sleec.trigger("a", "a reason", "please")


def test_marked_implementations_are_asked_whatever_sees_them() -> None:
    sleec = running(TWO)
    done: list[str] = []

    class Robot:
        def o1(self, *args: object) -> None:
            done.append("o1")

        @obligation("o2")
        def second(self) -> None:
            done.append("o2")

    robot = Robot()
    with Monitor(sleec, print, watch=[robot]):
        sleec.implement(robot)
        with pytest.raises(WrongArguments, match="`second`, the code of rule `r2`"):
            sleec.trigger("a", "please")
        assert done == []
        sleec.trigger("a")
    assert done == ["o1", "o2"]


def test_advice_after_a_variant_is_given_its_result() -> None:
    sleec = running("RULE r1 WHEN a THEN o1")

    class Robot:
        @sleec.rule("r1")
        @cop.base
        def method(self, message: str) -> str:
            return message

        @cop.after()
        def method(self, message: str, __result__: str) -> str:
            return __result__ + "!"

    sleec.bind(Robot())
    assert sleec.trigger("a", "please").results == {"r1": "please!"}
    with pytest.raises(WrongArguments):
        sleec.trigger("a", "please", "now")


def test_a_signature_is_read_once_and_not_once_a_context(monkeypatch: pytest.MonkeyPatch) -> None:
    sleec = running("RULE r1 WHEN a THEN o1 UNLESS c IN WHICH CASE o2")
    sleec.implement({"o1": lambda message: None, "o2": lambda message: None})
    read: list[object] = []
    signature = inspect.signature

    def reading(function: Callable[..., object], **options: Any) -> inspect.Signature:
        read.append(function)
        return signature(function, **options)

    monkeypatch.setattr(inspect, "signature", reading)
    for turn in range(10):
        sleec.update({"c": turn % 2 == 0})
        sleec.trigger("a", "please")
    assert len(read) == 2
