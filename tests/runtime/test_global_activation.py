"""The paper's own mode: what it does right, and the race that it has."""

# ruff: noqa: F811 - the variants of a method share its name
# mypy: disable-error-code=no-redef

from __future__ import annotations

import contextpy3 as cop
import pytest

from sleec_runtime.errors import ConflictInContext, SleecError, Unbindable
from sleec_runtime.language import parse
from tests.runtime.robots import CURTAINS, Log, listing_2, running

TWO = "RULE r1 WHEN a THEN o1 UNLESS c IN WHICH CASE o2\nRULE r2 WHEN a THEN o3 UNLESS c IN WHICH CASE o4"


def called(robot: Log, *methods: str) -> list[str]:
    for method in methods:
        getattr(robot, method)()
    return robot.taken()


def test_methods_called_without_a_trigger_run_the_variant_of_the_active_clause() -> None:
    sleec = running(CURTAINS)
    robot = listing_2(sleec)
    with sleec.activate_globally():
        assert called(robot, "rule_0") == ["OpenCurtains"]
        sleec.update({"UserUndressed": True})
        assert called(robot, "rule_0") == ["RefuseRequest", "ExplainWhy"]
        sleec.update({"UserDistressed": True})
        assert called(robot, "rule_0") == ["WarnUser", "OpenCurtains"]
        sleec.update({"UserDistressed": False})
        assert called(robot, "rule_0") == ["RefuseRequest", "ExplainWhy"]
        sleec.trigger("CurtainOpenRequest")
        assert robot.taken() == ["RefuseRequest", "ExplainWhy"]
    assert called(robot, "rule_0") == ["OpenCurtains"]
    assert cop._BASELAYERS == (None,)


def test_it_follows_a_replaced_ruleset() -> None:
    sleec = running(CURTAINS + "RULE gone WHEN a THEN o1 UNLESS UserUndressed IN WHICH CASE o2")
    robot = listing_2(sleec)
    sleec.update({"UserUndressed": True})
    with sleec.activate_globally():
        assert len(cop._BASELAYERS) == 3
        sleec.replace(parse(CURTAINS))
        assert cop._BASELAYERS[1:] == (sleec.layers["dress_assist.hc1"],)
        assert called(robot, "rule_0") == ["RefuseRequest", "ExplainWhy"]


def test_a_conflict_in_the_context_keeps_it_from_starting() -> None:
    sleec = running(
        "RULE r1 WHEN a THEN o1 UNLESS c IN WHICH CASE o2\nRULE r2 WHEN a THEN o3 UNLESS c IN WHICH CASE NOT o2"
    )
    sleec.update({"c": True})
    with pytest.raises(ConflictInContext):
        sleec.activate_globally()
    assert cop._BASELAYERS == (None,)


def test_a_layer_that_is_active_already_keeps_it_from_starting() -> None:
    sleec = running(TWO)
    sleec.update({"c": True})
    with sleec.activate_globally(), pytest.raises(SleecError, match="already"):
        sleec.activate_globally()
    assert cop._BASELAYERS == (None,)


def test_it_ends_once() -> None:
    activation = running(TWO).activate_globally()
    activation.stop()
    with pytest.raises(SleecError, match="not on"):
        activation.stop()


def test_a_call_within_a_change_sees_half_of_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """What threads do by chance is done here by design: a call comes between two layers of one change. What it
    executes, o2 and o3, is due in no context; a dispatch at the same moment executes what is due in one."""
    sleec = running(TWO)
    robot = listing_2(sleec)
    by_call, by_trigger = [], []
    activate = cop.global_activate_layer

    def activate_and_call(layer: cop.Layer) -> None:
        activate(layer)
        by_call.append(called(robot, "rule_0", "rule_1"))
        sleec.trigger("a")
        by_trigger.append(robot.taken())

    with sleec.activate_globally():
        monkeypatch.setattr(cop, "global_activate_layer", activate_and_call)
        sleec.update({"c": True})
    assert by_call == [["o2", "o3"], ["o2", "o4"]]
    assert by_trigger == [["o2", "o4"], ["o2", "o4"]]


def test_the_base_never_runs_between_two_hedges_of_one_rule(monkeypatch: pytest.MonkeyPatch) -> None:
    sleec = running(CURTAINS)
    robot = listing_2(sleec)
    seen = []
    for name in ("global_activate_layer", "global_deactivate_layer"):
        change = getattr(cop, name)

        def change_and_call(layer: cop.Layer, change=change) -> None:
            change(layer)
            seen.append(called(robot, "rule_0"))

        monkeypatch.setattr(cop, name, change_and_call)
    sleec.update({"UserUndressed": True})
    activation = sleec.activate_globally()
    seen.clear()
    sleec.update({"UserDistressed": True})
    assert seen == [["WarnUser", "OpenCurtains"], ["WarnUser", "OpenCurtains"]]
    activation.stop()


def test_a_change_into_a_conflicting_context_is_refused_whole() -> None:
    sleec = running(
        "RULE r1 WHEN a THEN o1 UNLESS c IN WHICH CASE o2\nRULE r2 WHEN a THEN o3 UNLESS c AND d IN WHICH CASE NOT o2"
    )
    with sleec.activate_globally():
        sleec.update({"c": True})
        before = cop._BASELAYERS
        with pytest.raises(ConflictInContext):
            sleec.update({"d": True, "c": True})
        assert sleec.conditions.get("d") is None
        assert before == cop._BASELAYERS
        with pytest.raises(ConflictInContext):
            sleec.replace(parse("RULE r1 WHEN a THEN o1 UNLESS c IN WHICH CASE NOT o1\nRULE r2 WHEN a THEN o1"))
        assert "r2" in sleec.ruleset.by_label
        assert before == cop._BASELAYERS
    sleec.update({"d": True})


def test_a_hedge_that_obliges_nothing_needs_a_variant_that_does_nothing() -> None:
    sleec = running("RULE r WHEN a THEN o1 UNLESS c")

    class Robot(Log):
        @sleec.rule("r")
        @cop.base
        def method(self) -> None:
            self.do("o1")

    robot = Robot()
    sleec.bind(robot)
    with pytest.raises(Unbindable, match=r"runs the base where r\.hc1 decides"):
        sleec.activate_globally()
    assert cop._BASELAYERS == (None,)
    sleec.unbind("r")

    class Silent(Log):
        @sleec.rule("r")
        @cop.base
        def method(self) -> None:
            self.do("o1")

        @cop.around(sleec.layers["r.hc1"])
        def method(self) -> None:
            pass

    silent = Silent()
    sleec.bind(silent)
    with sleec.activate_globally():
        sleec.update({"c": True})
        assert called(silent, "method") == []
        sleec.update({"c": False})
        assert called(silent, "method") == ["o1"]


def test_an_override_that_hides_the_variants_is_refused() -> None:
    sleec = running(CURTAINS)
    robot = listing_2(sleec)

    class Hiding(type(robot)):  # type: ignore[misc]
        def rule_0(self) -> None:
            self.do("OpenCurtains")

    sleec.unbind("dress_assist")
    sleec.bind(Hiding())
    with pytest.raises(Unbindable, match="a definition in a subclass hides it"):
        sleec.activate_globally()
