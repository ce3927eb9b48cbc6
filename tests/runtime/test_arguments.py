"""Arguments that do not fit the code of one rule are found before the code of any runs."""

# ruff: noqa: F811 - the variants of a method share its name
# mypy: disable-error-code=no-redef

from __future__ import annotations

import asyncio

import contextpy3 as cop
import pytest

from sleec_runtime.errors import Unbindable, WrongArguments
from tests.runtime.robots import running

TWO = "RULE r1 WHEN a THEN o1\nRULE r2 WHEN a THEN o2"


def test_nothing_runs_because_the_code_of_a_later_rule_does_not_take_the_arguments() -> None:
    sleec = running(TWO)
    done: list[str] = []

    def first(*args: object) -> None:
        done.append("o1")

    sleec.implement({"o1": first, "o2": lambda: done.append("o2")})
    with pytest.raises(WrongArguments, match="the code of rule r2, cannot be called so: too many positional") as caught:
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
    with pytest.raises(WrongArguments, match="second, the code of rule r2"):
        sleec.trigger("a", "please")
    with pytest.raises(WrongArguments, match="first, the code of rule r1"):
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

    with pytest.raises(Unbindable, match=r"on layer r2\.hc1, and method is the method of r1"):
        sleec.bind(Astray())
    assert set(sleec.missing()) == {"r1", "r2"}
