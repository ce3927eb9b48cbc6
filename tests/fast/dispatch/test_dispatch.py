"""Dispatch: from a trigger to the variants that run."""


# mypy: disable-error-code=no-redef

from __future__ import annotations

import pytest

from sleec_runtime.errors import ConflictInContext, UndeterminedDecision
from sleec_runtime.evaluation.conflicts import Conflict
from sleec_runtime.model import Obligation
from tests.support.robots import CURTAINS, listing_2, running

PROPOSITION_1 = """
RULE R1 WHEN a THEN o1 UNLESS c IN WHICH CASE o2
RULE R2 WHEN b THEN o3 UNLESS d IN WHICH CASE o4
"""


def test_proposition_1_holds_with_one_epsilon_for_each_rule() -> None:
    """With one ε for all, R2 yields it and R1 would run its base besides its hedge."""
    sleec = running(PROPOSITION_1)
    robot = listing_2(sleec)
    sleec.update({"c": True})
    done = sleec.trigger_all(["a", "b"])
    assert robot.taken() == list(done.obligations) == ["o2", "o3"]
    assert done.clauses == (("R1", 1), ("R2", 0))


def test_definition_2_over_all_contexts_of_the_counterexample() -> None:
    sleec = running(PROPOSITION_1)
    robot = listing_2(sleec)
    for bits in range(16):
        a, b, c, d = (bool(bits >> n & 1) for n in range(4))
        sleec.update({"c": c, "d": d})
        sleec.trigger_all([name for name, occurs in (("a", a), ("b", b)) if occurs])
        assert robot.taken() == ["o2" if c else "o1"] * a + ["o4" if d else "o3"] * b


def test_rules_run_in_their_order_whatever_the_order_of_the_triggers() -> None:
    sleec = running("RULE r1 WHEN b THEN o1\nRULE r2 WHEN a THEN o2\nRULE r3 WHEN b THEN o3")
    robot = listing_2(sleec)
    done = sleec.trigger_all(["a", "b", "a"])
    assert robot.taken() == list(done.obligations) == ["o1", "o2", "o3"]
    assert done.triggers == ("a", "b")


def test_an_obligation_due_by_two_rules_is_done_by_each_of_their_variants() -> None:
    sleec = running("RULE r1 WHEN a THEN Log\nRULE r2 WHEN a THEN Log AND Help")
    robot = listing_2(sleec)
    done = sleec.trigger("a")
    assert robot.taken() == ["Log", "Log", "Help"]
    assert done.obligations == ("Log", "Help")


def test_a_guard_that_is_false_silences_the_rule() -> None:
    sleec = running("RULE r WHEN a AND g THEN Log")
    robot = listing_2(sleec)
    assert sleec.trigger("a").clauses == ()
    sleec.update({"g": True})
    assert sleec.trigger("a").clauses == (("r", 0),)
    assert robot.taken() == ["Log"]


def test_a_nested_chain_has_layers_in_the_order_of_the_text() -> None:
    sleec = running(
        "RULE r WHEN a THEN o0 UNLESS b IN WHICH CASE (o1 UNLESS c IN WHICH CASE (o2)) UNLESS d IN WHICH CASE o3"
    )
    robot = listing_2(sleec)
    assert list(sleec.layers) == ["r.hc1", "r.hc2", "r.hc3"]
    for bits in range(8):
        b, c, d = (bool(bits >> n & 1) for n in range(3))
        sleec.update({"b": b, "c": c, "d": d})
        sleec.trigger("a")
        assert robot.taken() == ["o0" if not b else "o3" if d else "o2" if c else "o1"]


def test_a_prohibition_is_told_and_never_executed() -> None:
    sleec = running("RULE r WHEN a THEN NOT Open AND Warn UNLESS c IN WHICH CASE NOT Warn")
    robot = listing_2(sleec)
    done = sleec.trigger("a")
    assert (robot.taken(), done.obligations, done.prohibitions) == (["Warn"], ("Warn",), ("Open",))
    sleec.update({"c": True})
    done = sleec.trigger("a")
    assert (robot.taken(), done.obligations, done.prohibitions) == ([], (), ("Warn",))


def test_a_conflict_is_refused_before_anything_runs() -> None:
    sleec = running("RULE r1 WHEN a THEN Log AND Open\nRULE r2 WHEN a THEN Wait UNLESS c IN WHICH CASE NOT Open")
    robot = listing_2(sleec)
    sleec.trigger("a")
    assert robot.taken() == ["Log", "Open", "Wait"]
    sleec.update({"c": True})
    with pytest.raises(ConflictInContext, match=r"Open \(r1\) and NOT Open \(r2\) are both due") as refusal:
        sleec.trigger("a")
    assert refusal.value.conflict == Conflict((Obligation("Open"), Obligation("Open", negated=True)))
    assert robot.taken() == []


def test_a_conflict_between_rules_of_triggers_that_occur_together() -> None:
    sleec = running("EXCLUSIVE Open, Close\nRULE r1 WHEN a THEN Open\nRULE r2 WHEN b THEN Close")
    robot = listing_2(sleec)
    sleec.trigger("a")
    sleec.trigger("b")
    assert robot.taken() == ["Open", "Close"]
    with pytest.raises(ConflictInContext, match="EXCLUSIVE Open, Close"):
        sleec.trigger_all(["a", "b"])
    assert robot.taken() == []


def test_a_never_is_looked_at_again_when_its_conditions_change() -> None:
    sleec = running(
        "CONDITION Wet\nNEVER Mop AND Wet\nNEVER Leave AND Mop\nRULE r1 WHEN a THEN Mop\nRULE r2 WHEN b THEN Wait"
    )
    robot = listing_2(sleec)
    sleec.trigger("a")
    sleec.update({"Wet": True})
    with pytest.raises(ConflictInContext, match=r"Mop \(r1\) is due, but forbidden by NEVER Mop AND Wet"):
        sleec.trigger("a")
    sleec.trigger("b")
    sleec.update({"Wet": False})
    sleec.trigger("a")
    assert robot.taken() == ["Mop", "Wait", "Mop"]


def test_a_consequence_of_a_constraint_is_not_executed() -> None:
    sleec = running("OBLIGATION Open, Warn\nNEVER Open AND NOT Warn\nRULE r WHEN a THEN Open")
    robot = listing_2(sleec)
    assert sleec.trigger("a").obligations == ("Open",)
    assert robot.taken() == ["Open"]


def test_a_situation_that_must_not_be_refuses_every_trigger() -> None:
    sleec = running("CONDITION Fire\nNEVER Fire AND (Open OR NOT Open)\nRULE r WHEN a THEN Wait")
    sleec.update({"Fire": True})
    with pytest.raises(ConflictInContext, match="forbid this situation: NEVER Fire AND"):
        sleec.trigger("a")


def test_many_constraints_are_joined_where_they_share_obligations() -> None:
    sleec = running(
        "EXCLUSIVE A, B\nEXCLUSIVE C, D\nEXCLUSIVE B, C\nEXCLUSIVE X, Y\n"
        "NEVER A AND NOT B AND NOT E\nNEVER E AND C\n"
        "RULE r1 WHEN t THEN A AND C\nRULE r2 WHEN u THEN A AND D"
    )
    listing_2(sleec)
    with pytest.raises(ConflictInContext):
        sleec.trigger("t")
    sleec.trigger("u")


def test_strict_mode_refuses_what_is_undetermined_and_names_what_is_missing() -> None:
    sleec = running(CURTAINS, strict=True)
    robot = listing_2(sleec)
    with pytest.raises(UndeterminedDecision, match="UserUndressed") as refusal:
        sleec.trigger("CurtainOpenRequest")
    assert refusal.value.missing == ("UserUndressed", "UserDistressed")
    sleec.update({"UserUndressed": False})
    assert sleec.trigger("CurtainOpenRequest").obligations == ("OpenCurtains",)
    sleec.update({"UserUndressed": None})
    with pytest.raises(UndeterminedDecision):
        sleec.trigger("CurtainOpenRequest")
    assert robot.taken() == ["OpenCurtains"]


def test_strict_mode_refuses_a_conflict_that_may_be() -> None:
    text = "CONDITION Wet\nNEVER Mop AND Wet\nRULE r WHEN a THEN Mop"
    listing_2(lenient := running(text))
    lenient.trigger("a")
    listing_2(strict := running(text, strict=True))
    with pytest.raises(UndeterminedDecision) as refusal:
        strict.trigger("a")
    assert refusal.value.missing == ("Wet",)
    strict.update({"Wet": False})
    strict.trigger("a")


def test_every_dispatch_says_which_rule_clause_and_conditions_decided() -> None:
    sleec = running(
        "CONSTANT LegalAge = 18\n"
        "RULE r1 WHEN a AND g THEN Log UNLESS Age < LegalAge OR Ill IN WHICH CASE (Help AND NOT Leave)\n"
        "RULE r2 WHEN a AND NOT g THEN Wait"
    )
    listing_2(sleec)
    sleec.update({"g": True, "Age": 17.5})
    assert sleec.trigger("a").explain().splitlines() == [
        "a, in the context of change 1:",
        "r1: exception r1.hc1 requires Help, NOT Leave",
        "  guard: g is true",
        "  clause 1: Age < LegalAge OR Ill is true (Age = 17.5, Ill = unreported)",
        "r2: nothing, because its guard is false",
    ]
    assert "obligations=('Help',)" in repr(sleec.trigger("a"))


def test_an_explanation_is_of_the_context_of_the_dispatch() -> None:
    sleec = running(CURTAINS)
    listing_2(sleec)
    sleec.update({"UserUndressed": True})
    done = sleec.trigger("CurtainOpenRequest")
    sleec.update({"UserUndressed": False})
    assert "clause 1: UserUndressed is true" in done.explain()
    assert "clause 2: UserDistressed is false (unreported)" in done.explain()
    assert done.decisions[0].layer == "dress_assist.hc1"


def test_a_trigger_with_no_rule_in_this_domain_says_so() -> None:
    sleec = running(
        "RULE r1 WHEN a THEN Log\nDOMAIN ward\nRULE r2 WHEN b THEN Log\nDOMAIN home\nRULE r3 WHEN c THEN Log",
        domain="home",
    )
    listing_2(sleec)
    done = sleec.trigger("b")
    assert done.obligations == ()
    assert "no rule has this trigger in the domain home" in done.explain()


def test_the_assumptions_that_a_context_breaks_can_be_asked_for() -> None:
    sleec = running(
        "TRIGGER a\nASSUME NOT (Asleep AND Walking)\nRULE r WHEN a THEN Log UNLESS Asleep OR Walking IN WHICH CASE Help"
    )
    assert sleec.broken_assumptions("a") == ()
    sleec.update({"Asleep": True, "Walking": True})
    assert len(sleec.broken_assumptions("a")) == 1
