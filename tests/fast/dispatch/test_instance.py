"""γ(Γ): methods as in the paper's Listing 2, on classes, subclasses, functions and modules; and instances by
construction."""

# ruff: noqa: F811 - the variants of a method share its name
# mypy: disable-error-code=no-redef

from __future__ import annotations

import types

import contextpy3 as cop
import pytest

import sleec_runtime
from sleec_runtime import Sleec
from sleec_runtime.errors import NotBound, Unbindable
from tests.support.robots import CURTAINS, Log, running

REQUEST = "CurtainOpenRequest"
EXPECTED = {
    (False, False): ["OpenCurtains"],
    (False, True): ["OpenCurtains"],
    (True, False): ["RefuseRequest", "ExplainWhy"],
    (True, True): ["WarnUser", "OpenCurtains"],
}


@pytest.fixture
def sleec() -> Sleec:
    return running(CURTAINS)


def answers(sleec: Sleec, log: Log) -> dict[tuple[bool, bool], list[str]]:
    found = {}
    for undressed, distressed in EXPECTED:
        sleec.update({"UserUndressed": undressed, "UserDistressed": distressed})
        sleec.trigger(REQUEST, "message")
        found[undressed, distressed] = log.taken()
    return found


def curtain_class(sleec: Sleec) -> type[Log]:
    class Curtains(Log):
        @sleec.rule("dress_assist")
        @cop.base
        def open_curtains_request(self, message: str) -> str:
            assert message == "message"
            self.do("OpenCurtains")
            return "base"

        @cop.around(sleec.layers["dress_assist.hc1"])
        def open_curtains_request(self, message: str) -> str:
            self.do("RefuseRequest")
            self.do("ExplainWhy")
            return "hc1"

        @cop.around(sleec.layers["dress_assist.hc2"])
        def open_curtains_request(self, message: str) -> str:
            self.do("WarnUser")
            self.do("OpenCurtains")
            return "hc2"

    return Curtains


def test_listing_2(sleec: Sleec) -> None:
    robot = curtain_class(sleec)()
    sleec.bind(robot)
    assert answers(sleec, robot) == EXPECTED
    assert sleec.trigger(REQUEST, "message").results == {"dress_assist": "hc2"}


def test_keyword_arguments_reach_the_variants(sleec: Sleec) -> None:
    robot = curtain_class(sleec)()
    sleec.bind(robot)
    sleec.trigger(REQUEST, message="message")
    assert robot.taken() == ["OpenCurtains"]


def test_the_variants_may_come_in_any_order(sleec: Sleec) -> None:
    class Curtains(Log):
        @cop.around(sleec.layers["dress_assist.hc2"])
        def request(self, message):
            self.do("WarnUser")
            self.do("OpenCurtains")

        @sleec.rule("dress_assist")
        @cop.base
        def request(self, message):
            self.do("OpenCurtains")

        @cop.around(sleec.layers["dress_assist.hc1"])
        def request(self, message):
            self.do("RefuseRequest")
            self.do("ExplainWhy")

    robot = Curtains()
    sleec.bind(robot)
    assert answers(sleec, robot) == EXPECTED


def test_the_mark_may_stand_on_a_variant(sleec: Sleec) -> None:
    class Curtains(Log):
        @cop.base
        def request(self, message):
            self.do("OpenCurtains")

        @sleec.rule("dress_assist")
        @cop.around(sleec.layers["dress_assist.hc1"])
        def request(self, message):
            self.do("RefuseRequest")
            self.do("ExplainWhy")

        @cop.around(sleec.layers["dress_assist.hc2"])
        def request(self, message):
            self.do("WarnUser")
            self.do("OpenCurtains")

    robot = Curtains()
    sleec.bind(robot)
    assert answers(sleec, robot) == EXPECTED


def test_a_subclass_may_override_one_variant_and_keep_the_others(sleec: Sleec) -> None:
    class Polite(curtain_class(sleec)):  # type: ignore[misc]
        @cop.around(sleec.layers["dress_assist.hc1"])
        def open_curtains_request(self, message):
            self.do("Apologise")
            super().open_curtains_request(message)

    robot = Polite()
    sleec.bind(robot)
    assert answers(sleec, robot) == {**EXPECTED, (True, False): ["Apologise", "RefuseRequest", "ExplainWhy"]}


def test_a_plain_override_is_another_base(sleec: Sleec) -> None:
    class Slow(curtain_class(sleec)):  # type: ignore[misc]
        def open_curtains_request(self, message):
            self.do("OpenSlowly")

    robot = Slow()
    sleec.bind(robot)
    default = {key: ["OpenSlowly"] for key, value in EXPECTED.items() if value == ["OpenCurtains"]}
    assert answers(sleec, robot) == {**EXPECTED, **default}


def test_an_override_may_be_marked_again(sleec: Sleec) -> None:
    class Again(curtain_class(sleec)):  # type: ignore[misc]
        @sleec.rule("dress_assist")
        @cop.around(sleec.layers["dress_assist.hc2"])
        def open_curtains_request(self, message):
            self.do("Warn")

    robot = Again()
    sleec.bind(robot)
    assert answers(sleec, robot) == {**EXPECTED, (True, True): ["Warn"]}


def test_an_inherited_method_is_bound_to_the_object_of_the_subclass(sleec: Sleec) -> None:
    class Same(curtain_class(sleec)):  # type: ignore[misc]
        pass

    robot = Same()
    sleec.bind(robot)
    assert answers(sleec, robot) == EXPECTED


def test_functions_of_a_module(sleec: Sleec) -> None:
    log = Log()
    module = types.ModuleType("robot")
    vars(module).update(cop=cop, sleec=sleec, log=log)
    exec(
        """
@sleec.rule("dress_assist")
@cop.base
def request(message): log.do("OpenCurtains")

@cop.around(sleec.layers["dress_assist.hc1"])
def request(message): log.do("RefuseRequest"); log.do("ExplainWhy")

@cop.around(sleec.layers["dress_assist.hc2"])
def request(message): log.do("WarnUser"); log.do("OpenCurtains")
""",
        vars(module),
    )
    vars(module)["another_name"] = module.request
    sleec.bind(module)
    assert answers(sleec, log) == EXPECTED
    sleec.unbind("dress_assist")
    sleec.bind(module.request)
    assert answers(sleec, log) == EXPECTED


def test_static_and_class_methods(sleec: Sleec) -> None:
    log = Log()

    class Curtains:
        @sleec.rule("dress_assist")
        @cop.base
        @staticmethod
        def request(message):
            log.do("OpenCurtains")

        @cop.around(sleec.layers["dress_assist.hc1"])
        @classmethod
        def request(cls, message):
            assert cls is Curtains
            log.do("RefuseRequest")
            log.do("ExplainWhy")

        @cop.around(sleec.layers["dress_assist.hc2"])
        @staticmethod
        def request(message):
            log.do("WarnUser")
            log.do("OpenCurtains")

    sleec.bind(Curtains)
    assert answers(sleec, log) == EXPECTED


def test_one_method_may_be_that_of_two_rules() -> None:
    sleec = running(
        "RULE one WHEN A THEN Stop UNLESS c IN WHICH CASE Go\nRULE two WHEN B THEN Stop UNLESS c IN WHICH CASE Wait"
    )

    class Robot(Log):
        @sleec.rule("one")
        @sleec.rule("two")
        @cop.base
        def request(self):
            self.do("Stop")

        @cop.around(sleec.layers["one.hc1"])
        def request(self):
            self.do("Go")

        @cop.around(sleec.layers["two.hc1"])
        def request(self):
            self.do("Wait")

    robot = Robot()
    sleec.bind(robot)
    sleec.trigger("A")
    sleec.update({"c": True})
    sleec.trigger("A")
    sleec.trigger("B")
    assert robot.taken() == ["Stop", "Go", "Wait"]


def test_before_and_after_advice_and_proceed_work_as_in_contextpy3(sleec: Sleec) -> None:
    class Curtains(Log):
        @sleec.rule("dress_assist")
        @cop.base
        def request(self, message):
            self.do("base")

        @cop.before()
        def request(self, message):
            self.do("before all")

        @cop.around(sleec.layers["dress_assist.hc1"])
        def request(self, message):
            self.do("around")
            cop.proceed(message)

        @cop.after(sleec.layers["dress_assist.hc1"])
        def request(self, message, __result__=None):
            self.do("after")

    robot = Curtains()
    sleec.bind(robot)
    sleec.trigger(REQUEST, "message")
    assert robot.taken() == ["before all", "base"]
    sleec.update({"UserUndressed": True})
    sleec.trigger(REQUEST, "message")
    with cop.active_layer(sleec.layers["dress_assist.hc1"]):
        dispatched, _ = robot.taken(), robot.request("message")
    assert dispatched == robot.taken() == ["around", "before all", "base", "after"]


def test_layers_are_one_object_a_name(sleec: Sleec) -> None:
    assert list(sleec.layers) == ["dress_assist.hc1", "dress_assist.hc2"]
    assert len(sleec.layers) == 2
    assert sleec.layers["dress_assist.hc1"] is sleec.layers["dress_assist.hc1"]
    assert "dress_assist.hc3" not in sleec.layers
    assert sleec.layers.get("dress_assist.hc3") is None
    assert isinstance(sleec.layers["dress_assist.hc1"], cop.Layer)


# By construction ------------------------------------------------------------------------------------------


def test_callables_for_obligations_need_no_variant_by_hand(sleec: Sleec) -> None:
    log = Log()
    names = ("OpenCurtains", "RefuseRequest", "ExplainWhy", "WarnUser")
    sleec.implement({name: lambda message, name=name: log.do(name) for name in names})
    assert answers(sleec, log) == EXPECTED


def test_an_object_implements_by_mark_or_by_name(sleec: Sleec) -> None:
    class Arm(Log):
        @sleec_runtime.obligation("OpenCurtains")
        def pull(self, message):
            self.log.append("OpenCurtains")

        def open_curtains(self, message):
            raise AssertionError("a mark goes before a name")

        def refuse_request(self, message):
            self.log.append("RefuseRequest")

        @sleec_runtime.obligation("ExplainWhy")
        @staticmethod
        def say(message):
            log.append("ExplainWhy")

        @sleec_runtime.obligation("WarnUser")
        @classmethod
        def warn(cls, message):
            log.append("WarnUser")

        @property
        def broken(self):
            raise AssertionError("a property is not to be read")

    robot = Arm()
    log = robot.log
    sleec.implement(robot)
    with sleec_runtime.recording() as seen:
        for undressed, distressed in EXPECTED:
            sleec.update({"UserUndressed": undressed, "UserDistressed": distressed})
            sleec.trigger(REQUEST, "message")
    assert seen.executed == log == [name for names in EXPECTED.values() for name in names]


def test_a_method_goes_before_callables(sleec: Sleec) -> None:
    robot = curtain_class(sleec)()
    sleec.bind(robot)
    sleec.implement({"OpenCurtains": lambda message: robot.do("callable")})
    sleec.trigger(REQUEST, "message")
    assert robot.taken() == ["OpenCurtains"]


def test_what_is_missing_is_told_beforehand(sleec: Sleec) -> None:
    assert list(sleec.missing()) == ["dress_assist"]
    sleec.implement({"OpenCurtains": lambda message: None})
    assert "RefuseRequest" in str(sleec.missing()["dress_assist"])
    sleec.trigger(REQUEST, "message")
    sleec.update({"UserUndressed": True})
    with pytest.raises(NotBound, match="no callable for `RefuseRequest`, `ExplainWhy`"):
        sleec.trigger(REQUEST, "message")


def test_a_layer_with_no_obligation_suppresses_the_base() -> None:
    sleec = running("RULE r WHEN A THEN Open UNLESS c")

    class Robot(Log):
        @sleec.rule("r")
        @cop.base
        def request(self):
            self.do("Open")

    robot = Robot()
    sleec.bind(robot)
    assert not sleec.missing()
    assert "r.hc1" in sleec.layers
    sleec.update({"c": True})
    done = sleec.trigger("A")
    assert (robot.taken(), done.obligations, done.results) == ([], (), {})
    assert done.clauses == (("r", 1),)


def test_a_variant_with_a_guard_of_its_own_is_refused(sleec: Sleec) -> None:
    class Curtains(Log):
        @sleec.rule("dress_assist")
        @cop.base
        def request(self, message):
            pass

        @cop.around(sleec.layers["dress_assist.hc1"], guard=lambda layers: False)
        def request(self, message):
            pass

    with pytest.raises(Unbindable, match="guard"):
        sleec.bind(Curtains())


def test_marks_of_another_instance_do_not_count(sleec: Sleec) -> None:
    other = running(CURTAINS)
    with pytest.raises(Unbindable, match="nothing"):
        other.bind(curtain_class(sleec)())
