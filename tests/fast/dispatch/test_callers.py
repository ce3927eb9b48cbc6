"""Dispatch, whatever its callers do."""

# ruff: noqa: F811 - the variants of a method share its name
# mypy: disable-error-code=no-redef

from __future__ import annotations

import contextpy3 as cop
import pytest

from sleec_runtime.errors import NotBound, VariantsFailed
from tests.support.robots import CURTAINS, Log, listing_2, running


def test_layers_that_the_caller_has_active_change_nothing() -> None:
    sleec = running(CURTAINS)
    robot = listing_2(sleec)
    hc1, hc2 = sleec.layers.values()
    with cop.active_layers(hc1, hc2):
        sleec.trigger("CurtainOpenRequest")
        assert robot.taken() == ["OpenCurtains"]
    cop.global_activate_layer(hc2)
    try:
        sleec.update({"UserUndressed": True})
        with cop.active_layer(hc2):
            sleec.trigger("CurtainOpenRequest")
    finally:
        cop.global_deactivate_layer(hc2)
    assert robot.taken() == ["RefuseRequest", "ExplainWhy"]


def test_a_variant_sees_its_layer_and_those_that_are_of_no_rule() -> None:
    sleec = running(CURTAINS)
    own = cop.Layer("spoken")
    seen: list[str] = []

    class Robot:
        @sleec.rule("dress_assist")
        @cop.base
        def request(self):
            self.tell()

        @cop.around(sleec.layers["dress_assist.hc1"])
        def request(self):
            self.tell()

        @cop.base
        def tell(self):
            seen.append("base")

        @cop.around(sleec.layers["dress_assist.hc1"])
        def tell(self):
            seen.append("hc1")
            cop.proceed()

        @cop.around(own)
        def tell(self):
            seen.append("spoken")
            cop.proceed()

    sleec.bind(Robot())
    sleec.update({"UserUndressed": True})
    with cop.active_layer(own):
        sleec.trigger("CurtainOpenRequest")
    assert seen == ["hc1", "spoken", "base"]


def test_a_trigger_within_a_variant_starts_afresh() -> None:
    sleec = running(
        "RULE outer WHEN a THEN Ask UNLESS c IN WHICH CASE Insist\n"
        "RULE inner WHEN b THEN Say UNLESS d IN WHICH CASE Shout"
    )

    class Robot(Log):
        @sleec.rule("outer")
        @cop.base
        def ask(self):
            self.do("Ask")

        @cop.around(sleec.layers["outer.hc1"])
        def ask(self):
            self.tell()
            sleec.update({"c": False, "d": True})
            sleec.trigger("b")
            sleec.trigger("a")
            self.tell()
            self.do("Insist")

        @sleec.rule("inner")
        @cop.base
        def say(self):
            self.do("Say")

        @cop.around(sleec.layers["inner.hc1"])
        def say(self):
            self.tell()
            self.do("Shout")

        @cop.base
        def tell(self):
            self.do("quietly")

        @cop.around(sleec.layers["outer.hc1"])
        def tell(self):
            self.do("outer")

    robot = Robot()
    sleec.bind(robot)
    sleec.update({"c": True})
    done = sleec.trigger("a")
    assert robot.taken() == ["outer", "quietly", "Shout", "Ask", "outer", "Insist"]
    assert done.obligations == ("Insist",)
    assert done.context.conditions == {"c": True}


def test_what_a_variant_raises_comes_out_as_it_is_after_the_others_have_run() -> None:
    sleec = running("RULE r1 WHEN a THEN Fail\nRULE r2 WHEN a THEN Help\nRULE r3 WHEN b THEN Help")
    robot = Log()

    def fail() -> None:
        raise RuntimeError("the arm is stuck")

    sleec.implement({"Fail": fail, "Help": lambda: robot.do("Help")})
    with pytest.raises(RuntimeError, match="stuck"):
        sleec.trigger("a")
    assert robot.taken() == ["Help"]
    assert sleec.trigger("b").obligations == ("Help",)


def test_several_variants_that_raise_are_told_together() -> None:
    sleec = running("RULE r1 WHEN a THEN Fail\nRULE r2 WHEN a THEN Fail")

    def fail() -> None:
        raise RuntimeError("stuck")

    sleec.implement({"Fail": fail})
    with pytest.raises(VariantsFailed, match=r"r1.*r2") as failure:
        sleec.trigger("a")
    assert [label for label, _ in failure.value.errors] == ["r1", "r2"]


def test_an_interrupt_stops_at_once() -> None:
    sleec = running("RULE r1 WHEN a THEN Fail\nRULE r2 WHEN a THEN Help")
    robot = Log()

    def interrupt() -> None:
        raise KeyboardInterrupt

    sleec.implement({"Fail": interrupt, "Help": lambda: robot.do("Help")})
    with pytest.raises(KeyboardInterrupt):
        sleec.trigger("a")
    assert robot.taken() == []


def test_an_exception_leaves_contextpy3_as_it_was() -> None:
    sleec = running(CURTAINS)
    mine = cop.Layer("mine")

    class Robot:
        @sleec.rule("dress_assist")
        @cop.base
        def request(self):
            raise RuntimeError

        @cop.base
        def outer(self):
            with pytest.raises(RuntimeError):
                sleec.trigger("CurtainOpenRequest")
            return "base"

        @cop.around(mine)
        def outer(self):
            with pytest.raises(RuntimeError):
                sleec.trigger("CurtainOpenRequest")
            return cop.proceed() + " after mine"

    robot = Robot()
    sleec.bind(robot)
    with cop.active_layer(mine):
        assert robot.outer() == "base after mine"
    assert cop._TLS.active_layers == ()
    assert cop._TLS.context is None


def test_nothing_is_half_executed_because_a_later_rule_lacks_its_code() -> None:
    sleec = running("RULE r1 WHEN a THEN Log\nRULE r2 WHEN a THEN Help")
    robot = Log()
    sleec.implement({"Log": lambda: robot.do("Log")})
    with pytest.raises(NotBound, match="r2"):
        sleec.trigger("a")
    assert robot.taken() == []
