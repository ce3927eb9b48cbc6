"""Other rules while the robot runs: replaced atomically, with the same layers, code and context."""

from __future__ import annotations

import pytest

import sleec_runtime
from sleec_runtime import Sleec, errors
from sleec_runtime.dispatch.execution import plan, run
from sleec_runtime.dispatch.instance import Instance
from sleec_runtime.dispatch.rule_index import RuleIndex
from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.language import parse
from tests.support.robots import CURTAINS, Log, listing_2, running

SWAPPED = """
RULE dress_assist
WHEN CurtainOpenRequest THEN OpenCurtains
UNLESS UserDistressed IN WHICH CASE (RefuseRequest AND ExplainWhy)
UNLESS UserUndressed IN WHICH CASE (WarnUser AND OpenCurtains)
"""
REQUEST = "CurtainOpenRequest"


def test_decorated_code_goes_on_working_under_the_same_layers() -> None:
    sleec = running(CURTAINS)
    robot = listing_2(sleec)
    layers = dict(sleec.layers)
    sleec.update({"UserUndressed": True})
    sleec.replace(parse(SWAPPED))
    assert dict(sleec.layers) == layers
    assert dict(sleec.conditions) == {"UserUndressed": True}
    sleec.trigger(REQUEST)
    assert robot.taken() == ["OpenCurtains"]
    sleec.update({"UserDistressed": True, "UserUndressed": False})
    sleec.trigger(REQUEST)
    assert robot.taken() == ["RefuseRequest", "ExplainWhy"]


def test_a_trigger_under_way_finishes_under_the_old_rules() -> None:
    sleec = running("RULE r1 WHEN a THEN First\nRULE r2 WHEN a THEN Second")
    log = Log()

    def first() -> None:
        sleec.replace(parse("RULE r1 WHEN a THEN Third"), implement={"Third": lambda: log.do("Third")})
        log.do("First")

    sleec.implement({"First": first, "Second": lambda: log.do("Second")})
    assert sleec.trigger("a").obligations == ("First", "Second")
    assert log.taken() == ["First", "Second"]
    assert sleec.trigger("a").obligations == ("Third",)
    assert log.taken() == ["Third"]


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        (CURTAINS + "RULE other WHEN Knock THEN Greet", errors.NotBound),
        (CURTAINS + "UNLESS UserAsleep IN WHICH CASE Whisper", errors.NotBound),
        (
            "MEASURE UserUndressed: number\nRULE r WHEN a THEN o UNLESS UserUndressed > 1 IN WHICH CASE p",
            errors.WrongType,
        ),
    ],
)
def test_what_cannot_run_does_not_come_into_force(text: str, kind: type[errors.SleecError]) -> None:
    sleec = running(CURTAINS)
    robot = listing_2(sleec)
    sleec.update({"UserUndressed": True})
    before = sleec.ruleset
    with pytest.raises(kind):
        sleec.replace(parse(text), implement={"o": print, "p": print} if kind is errors.WrongType else None)
    assert sleec.ruleset is before
    sleec.trigger(REQUEST)
    assert robot.taken() == ["RefuseRequest", "ExplainWhy"]


def test_new_rules_come_with_their_code() -> None:
    sleec = running(CURTAINS)
    listing_2(sleec)
    longer = parse(CURTAINS + "RULE knock WHEN Knock THEN Greet UNLESS Night IN WHICH CASE Whisper")
    with pytest.raises(errors.UnknownLabel):
        sleec.rule("knock")
    sleec.prepare(longer)
    robot = type("Unbound", (Log,), {})()

    class Door(Log):
        @sleec.rule("knock")
        def greet(self) -> None:
            self.do("Greet")

    door = Door()
    with pytest.raises(errors.NotBound, match=r"knock\.hc1"):
        sleec.replace(longer, bind=[door])
    sleec.replace(longer, implement={"Greet": lambda: robot.do("Greet"), "Whisper": lambda: robot.do("Whisper")})
    sleec.update({"Night": True})
    sleec.trigger("Knock")
    assert robot.taken() == ["Whisper"]


def test_a_late_plan_of_the_old_rules_leaves_nothing_to_the_new_ones() -> None:
    """A thread may have read the old context, and make its plan when the new rules are in force."""
    log = Log()
    old, new = (Snapshot.first(RuleIndex(parse(f"RULE r1 WHEN a THEN {name}")), {}) for name in ("First", "Second"))
    code = Instance(old.index.whole)
    code.admit(new.index.whole)
    code.implement(
        {name: lambda name=name: log.do(name) for name in ("First", "Second")}, frozenset({"First", "Second"})
    )
    for snapshot in (old, new, old):
        run(plan(snapshot, ("a",), code), (), {})
    assert log.taken() == ["First", "Second", "First"]


def test_what_had_no_code_before_may_stay_without() -> None:
    sleec = running(CURTAINS)
    sleec.replace(parse(SWAPPED))
    assert list(sleec.missing()) == ["dress_assist"]


def test_the_reading_of_the_caller_stays() -> None:
    sleec = Sleec(parse(CURTAINS), reading="priority")
    sleec.replace(parse(CURTAINS))
    sleec.update({"UserDistressed": True})
    assert sleec.due(REQUEST).obligations == ("WarnUser", "OpenCurtains")


def test_a_robot_may_enter_another_domain() -> None:
    sleec = sleec_runtime.load("rulesets/care-robot.sleec", domain="hospital")
    everywhere = sleec_runtime.load("rulesets/care-robot.sleec")
    log = Log()
    sleec.implement({name: lambda name=name: log.do(name) for name in everywhere.ruleset.obligations})
    sleec.update({"UserUndressed": True})
    sleec.trigger(REQUEST)
    assert log.taken() == []
    sleec.enter_domain("household")
    sleec.trigger(REQUEST)
    assert log.taken() == ["RefuseRequest", "ExplainWhy"]
    assert sleec.domain == "household"
    sleec.enter_domain(None)
    assert len(sleec.ruleset.rules) == 8
