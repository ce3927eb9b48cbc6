"""The paper's own mode: what it does right, and the race that it has."""

# ruff: noqa: F811 - the variants of a method share its name
# mypy: disable-error-code=no-redef

from __future__ import annotations

import asyncio

import contextpy3 as cop
import pytest

from sleec_runtime.errors import ConflictInContext, NotBound, SleecError, Unbindable
from sleec_runtime.language import parse
from tests.support.robots import CURTAINS, Log, listing_2, running

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


@pytest.mark.parametrize("hedge", ["UNLESS c", "UNLESS c IN WHICH CASE NOT o1"])
def test_a_hedge_that_obliges_nothing_runs_nothing_without_a_variant(hedge: str) -> None:
    sleec = running(f"RULE r WHEN a THEN o1 {hedge}")

    class Robot(Log):
        @sleec.rule("r")
        @cop.base
        def method(self) -> None:
            self.do("o1")

    robot = Robot()
    taken_early = robot.method
    sleec.bind(robot)
    for _ in range(2):
        with sleec.activate_globally():
            sleec.update({"c": True})
            assert called(robot, "method") == []
            taken_early()
            assert robot.taken() == []
            sleec.trigger("a")
            assert robot.taken() == []
            sleec.update({"c": False})
            assert called(robot, "method") == ["o1"]
    assert len(vars(Robot)["method"].get_methods()) == 2


def test_it_runs_nothing_beside_other_variants_on_coroutines_and_in_subclasses() -> None:
    sleec = running("RULE r WHEN a THEN o1 UNLESS c IN WHICH CASE o2 UNLESS d\nRULE s WHEN b THEN o3 UNLESS d")

    class Robot(Log):
        @sleec.rule("r")
        @cop.base
        def method(self) -> None:
            self.do("o1")

        @cop.around(sleec.layers["r.hc1"])
        def method(self) -> None:
            self.do("o2")

        @sleec.rule("s")
        async def other(self) -> None:
            self.do("o3")

    class Heir(Robot):
        pass

    robot = Heir()
    with sleec.activate_globally():
        sleec.bind(robot)
        sleec.update({"c": True})
        assert called(robot, "method") == ["o2"]
        asyncio.run(robot.other())
        assert robot.taken() == ["o3"]
        sleec.update({"d": True})
        assert called(robot, "method") == []
        asyncio.run(robot.other())
        assert robot.taken() == []


def test_what_is_silenced_still_lacks_its_variant_when_the_hedge_comes_to_oblige_something() -> None:
    sleec = running("RULE r WHEN a THEN o1 UNLESS c")

    @sleec.rule("r")
    def method() -> None: ...

    sleec.bind(method)
    with sleec.activate_globally():
        sleec.update({"c": True})
        with pytest.raises(NotBound, match=r"no variant for r\.hc1"):
            sleec.replace(parse("RULE r WHEN a THEN o1 UNLESS c IN WHICH CASE o2"))


def test_a_function_without_layers_is_refused_where_a_hedge_comes_to_oblige_nothing() -> None:
    sleec = running("RULE r WHEN a THEN o1")

    @sleec.rule("r")
    def method() -> None: ...

    sleec.bind(method)
    with sleec.activate_globally():
        with pytest.raises(Unbindable, match=r"runs its base if r\.hc1 is active"):
            sleec.replace(parse("RULE r WHEN a THEN o1 UNLESS c"))
        assert not sleec.ruleset.by_label["r"].hedges


def test_a_never_about_the_context_is_at_odds_with_rules_that_do_not_mention_what_changed() -> None:
    sleec = running("NEVER o1 AND c\nRULE r WHEN a THEN o1\nRULE q WHEN b THEN o2 UNLESS c IN WHICH CASE o3")
    with sleec.activate_globally():
        with pytest.raises(ConflictInContext):
            sleec.update({"c": True})
        assert dict(sleec.conditions) == {}
        assert cop._BASELAYERS == (None,)


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
    sleec.unbind("dress_assist")
    with sleec.activate_globally():
        with pytest.raises(Unbindable, match="a definition in a subclass hides it"):
            sleec.bind(Hiding())
        assert "dress_assist" in sleec.missing()
        sleec.bind(robot)


def test_it_is_on_once_and_gives_way_to_no_one() -> None:
    sleec = running("RULE r WHEN a THEN o1 UNLESS c IN WHICH CASE o2")
    layer = sleec.layers["r.hc1"]
    with sleec.activate_globally():
        with pytest.raises(SleecError, match="already on"):
            sleec.activate_globally()
        cop.global_activate_layer(layer)
        with pytest.raises(SleecError, match=r"layer `r\.hc1` is already globally active"):
            sleec.update({"c": True})
        assert dict(sleec.conditions) == {}
        cop.global_deactivate_layer(layer)
        sleec.update({"c": True})
        assert layer in cop._BASELAYERS
        cop.global_deactivate_layer(layer)
        sleec.update({"c": False})
    assert cop._BASELAYERS == (None,)
