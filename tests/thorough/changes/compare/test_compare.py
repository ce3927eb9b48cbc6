"""What `compare` says of edits that people make, one by one. `test_compare_against_brute_force` has the random ones."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_runtime.errors import Unsayable
from sleec_runtime.language import load, parse
from sleec_runtime.model import Obligation, Rule
from sleec_verify.changes.compare import Difference, NameChange, compare
from sleec_verify.changes.diagram import decision_diagram
from sleec_verify.checks import run_checks
from sleec_verify.exchange.conversion import convert
from sleec_verify.exchange.conversion.readings import reread
from tests.support.paths import ROOT
from tests.support.small_rulesets import small_rulesets
from tests.support.studies import each_study

RULESETS = ROOT / "rulesets"
CURTAINS = """\
RULE dress_assist
WHEN CurtainOpenRequest THEN OpenCurtains
UNLESS UserUndressed IN WHICH CASE RefuseRequest AND ExplainWhy
UNLESS UserDistressed IN WHICH CASE WarnUser AND OpenCurtains
"""


def differ(old: str, new: str) -> Difference:
    return compare(parse(old, "old"), parse(new, "new"))


def edit(old: str, *changes: str) -> Difference:
    """`changes` are texts and, behind each, what takes its place."""
    new = old
    for before, after in zip(changes[::2], changes[1::2]):
        assert before in new
        new = new.replace(before, after)
    return differ(old, new)


def gained(found: Difference) -> set[str]:
    return {str(o) for change in found.changes for o in change.added}


def lost(found: Difference) -> set[str]:
    return {str(o) for change in found.changes for o in change.removed}


# Equivalent -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("path", sorted(RULESETS.glob("*.sleec")), ids=lambda path: path.stem)
def test_a_ruleset_is_equivalent_to_itself(path: Path) -> None:
    found = compare(load(path), load(path))
    assert found.relation == "equivalent"
    assert found.same == len(found.new.rules)
    assert found == Difference(found.old, found.new, same=found.same)


@each_study
def test_a_study_is_equivalent_to_itself_and_stricter_than_without_a_rule(path: Path) -> None:
    study = load(path)
    assert compare(study, study).relation == "equivalent"
    named = {
        r for result in run_checks(study, ["conflict", "redundant-rule"]) for f in result.findings for r in f.rules
    }
    rule = next((rule for rule in study.rules if rule.label not in named), study.rules[-1])
    without = replace(study, statements=tuple(s for s in study.statements if s is not rule))
    assert compare(study, without).relation == "laxer"
    assert compare(without, study).relation == "stricter"


def test_renamed_reordered_and_rewritten_rules_are_told_and_equivalent() -> None:
    old = CURTAINS + "RULE b\nWHEN t THEN o UNLESS NOT (c AND d) IN WHICH CASE p\nRULE z\nWHEN u THEN q\n"
    new = "RULE z\nWHEN u THEN q\nRULE b\nWHEN t THEN o UNLESS NOT c OR NOT d IN WHICH CASE p\n" + CURTAINS.replace(
        "dress_assist", "curtains"
    )
    found = differ(old, new)
    assert found.relation == "equivalent"
    assert found.renamed == (("dress_assist", "curtains"),)
    assert found.rewritten == (("b",),)
    assert found.reordered


@pytest.mark.parametrize("path", sorted(RULESETS.glob("*.sleec")), ids=lambda path: path.stem)
@pytest.mark.parametrize("reading", ["cascade", "priority"])
def test_between_readings(path: Path, reading: str) -> None:
    ruleset = load(path)
    found = compare(ruleset, reread(ruleset, "cascade" if reading == "cascade" else "priority"))
    assert found.relation == "equivalent"


@settings(max_examples=50)
@given(small_rulesets(rules=3), st.sampled_from(("cascade", "priority")))
def test_between_readings_of_random_rules(ruleset, reading) -> None:
    assert compare(ruleset, reread(ruleset, reading)).relation in ("equivalent", "unknown")


@settings(max_examples=50)
@given(small_rulesets(constraints=False, assumptions=False, measures=True))
def test_between_syntaxes(ruleset) -> None:
    try:
        converted = convert(ruleset, "legos").ruleset
    except Unsayable:
        return
    found = compare(ruleset, converted)
    assert found.relation == "equivalent"
    assert not found.undecided


def test_what_changes_only_where_the_assumptions_forbid_it_is_equivalent() -> None:
    old = "ASSUME NOT (UserUndressed AND UserDistressed)\n" + CURTAINS
    assert edit(old, "WarnUser AND OpenCurtains", "CallNurse").relation == "equivalent"
    assert edit(CURTAINS, "WarnUser AND OpenCurtains", "CallNurse").relation == "incomparable"


def test_what_another_rule_obliges_anyway_is_no_loss() -> None:
    old = "RULE a\nWHEN t THEN o\nRULE b\nWHEN t AND c THEN o AND p\n"
    assert edit(old, "THEN o AND p", "THEN p").relation == "equivalent"


# Changes --------------------------------------------------------------------------------------------------


def test_stricter_and_laxer() -> None:
    stricter = edit(CURTAINS, "WarnUser AND OpenCurtains", "WarnUser AND OpenCurtains AND CallNurse")
    assert stricter.relation == "stricter"
    assert (gained(stricter), lost(stricter)) == ({"CallNurse"}, set())
    assert compare(stricter.new, stricter.old).relation == "laxer"
    assert stricter.names == (NameChange("added", "obligation", "CallNurse"),)


def test_before_and_after_in_the_smallest_situation() -> None:
    (change,) = edit(CURTAINS, "UNLESS UserUndressed IN", "UNLESS UserUndressed OR WindowOpen IN").changes[:1]
    assert change.witness.triggers == ("CurtainOpenRequest",)
    assert change.witness.conditions == {"UserUndressed": False, "WindowOpen": True, "UserDistressed": False}
    assert [one.clause for one in change.before] == [0]
    assert [one.clause for one in change.after] == [1]


def test_forty_contexts_with_one_cause_are_one_change() -> None:
    conditions = " OR ".join(f"c{n}" for n in range(6))
    found = edit(f"RULE r\nWHEN t THEN o\nUNLESS {conditions} IN WHICH CASE p\n", "CASE p", "CASE q")
    (change,) = found.changes
    assert (change.added, change.removed) == ((Obligation("q"),), (Obligation("p"),))
    assert (change.extent.affected, change.extent.possible) == (63, 64)


def test_two_causes_are_two_changes() -> None:
    old = "RULE a\nWHEN t THEN o\nRULE b\nWHEN u THEN o\n"
    found = edit(old, "WHEN t THEN o", "WHEN t THEN p", "WHEN u THEN o", "WHEN u THEN p")
    assert [change.rules for change in found.changes] == [("a",), ("b",)]


def test_numbers_are_counted_by_regions() -> None:
    old = "CONSTANT LegalAge = 18\nRULE r\nWHEN t THEN o\nUNLESS UserAge < LegalAge IN WHICH CASE p\n"
    (change,) = edit(old, "= 18", "= 21").changes
    assert change.witness.conditions["UserAge"] in range(18, 21)
    # Below 18, from 18 below 21, from 21 on.
    assert (change.extent.affected, change.extent.possible) == (1, 3)


def test_numbers_compared_with_one_another_are_counted_by_their_orders() -> None:
    old = "RULE r\nWHEN t THEN o\nUNLESS x < y IN WHICH CASE p\n"
    (change,) = edit(old, "x < y", "x <= y").changes
    assert (change.extent.affected, change.extent.possible) == (1, 3)
    assert change.extent.over[0].orders == (("x", "y"),)


def test_constants_by_another_name_are_the_same_number() -> None:
    old = "CONSTANT LegalAge = 18\nRULE r\nWHEN t THEN o\nUNLESS UserAge < LegalAge IN WHICH CASE p\n"
    assert edit(old, "UserAge < LegalAge", "UserAge < 18").relation == "equivalent"


def test_prohibitions_are_gained_and_lost_as_what_they_are() -> None:
    found = edit("RULE r\nWHEN t THEN o\n", "THEN o", "THEN NOT p AND o")
    assert found.relation == "stricter"
    assert gained(found) == {"NOT p"}


def test_a_new_rule_and_one_that_is_gone() -> None:
    found = differ("RULE a\nWHEN t THEN o\n", "RULE b\nWHEN u THEN p\n")
    assert [(change.old_rule, change.new_rule) for change in found.changes] == [(None, "b"), ("a", None)]
    assert {(n.way, n.kind, n.name) for n in found.names} == {
        ("added", "trigger", "u"),
        ("added", "obligation", "p"),
        ("removed", "trigger", "t"),
        ("removed", "obligation", "o"),
    }


def test_a_rule_that_changes_its_trigger() -> None:
    found = edit(CURTAINS, "WHEN CurtainOpenRequest", "WHEN BlindOpenRequest")
    assert found.relation == "incomparable"
    assert {change.witness.triggers for change in found.changes} == {("CurtainOpenRequest",), ("BlindOpenRequest",)}


def test_rules_without_labels_meet_though_their_numbers_shift() -> None:
    found = differ("WHEN t THEN o\nWHEN u THEN p\n", "WHEN n THEN q\nWHEN t THEN o\nWHEN u THEN r\n")
    assert found.same == 1
    assert not found.renamed
    assert {(change.old_rule, change.new_rule) for change in found.changes} == {(None, "rule_1"), ("rule_2", "rule_3")}


def test_domains_are_kept_apart() -> None:
    old = "DOMAIN home\nRULE a\nWHEN t THEN o\nDOMAIN ward\nRULE b\nWHEN t THEN p\n"
    found = edit(old, "DOMAIN ward\nRULE b\nWHEN t THEN p", "DOMAIN ward\nRULE b\nWHEN t THEN q")
    assert [change.domains for change in found.changes] == [("ward",)]
    assert [one.rule for one in found.changes[0].before] == ["b"]
    everywhere = compare(
        parse("DOMAIN home\nRULE a\nWHEN t THEN o\nDOMAIN ward\nRULE b\nWHEN t THEN p\n"),
        parse("RULE c\nWHEN u THEN q\nDOMAIN home\nRULE a\nWHEN t THEN o\nDOMAIN ward\nRULE b\nWHEN t THEN p\n"),
    )
    assert [change.domains for change in everywhere.changes] == [("home", "ward")]
    assert compare(found.old, found.new, domain="home").relation == "equivalent"


def test_a_rule_that_moves_to_another_domain() -> None:
    found = edit("DOMAIN home\nRULE a\nWHEN t THEN o\n", "DOMAIN home", "DOMAIN ward")
    assert found.relation == "incomparable"
    assert [(change.domains, change.added, change.removed) for change in found.changes] == [
        (("home",), (), (Obligation("o"),)),
        (("ward",), (Obligation("o"),), ()),
    ]


# Conflicts ------------------------------------------------------------------------------------------------


def test_a_new_conflict_is_no_obligation_gained() -> None:
    old = "RULE a\nWHEN t THEN o\nRULE b\nWHEN u THEN p\n"
    found = edit(old, "THEN p", "THEN p AND NOT o")
    (conflict,) = found.conflicts
    assert (conflict.way, set(conflict.rules)) == ("added", {"a", "b"})
    assert conflict.witness.triggers == ("t", "u")
    assert found.relation == "incomparable"
    # Where only u occurs there is no conflict, and the prohibition is one.
    assert gained(found) == {"NOT o"}
    assert all("t" not in change.witness.triggers for change in found.changes)


def test_where_only_one_side_conflicts_nothing_is_gained_or_lost() -> None:
    found = edit("RULE a\nWHEN t THEN o\n", "THEN o", "THEN o AND NOT o AND p")
    assert not found.changes
    assert [conflict.way for conflict in found.conflicts] == ["added"]


def test_a_constraint_can_bring_a_conflict_and_its_end() -> None:
    old = "RULE a\nWHEN t THEN o\nRULE b\nWHEN u THEN p\n"
    found = differ(old, "EXCLUSIVE o, p\n" + old)
    (conflict,) = found.conflicts
    assert [str(o) for o in conflict.literals] == ["o", "p"]
    assert len(conflict.origins) == 1
    (gone,) = compare(found.new, found.old).conflicts
    assert gone.way == "removed"


def test_a_constraint_that_rules_out_nothing_is_equivalent() -> None:
    assert differ("RULE a\nWHEN t THEN o\n", "EXCLUSIVE o, p\nRULE a\nWHEN t THEN o\n").relation == "equivalent"


def test_a_constraint_that_speaks_of_another_trigger() -> None:
    old = "RULE a\nWHEN t THEN o\nRULE b\nWHEN u THEN p\n"
    found = differ(old, "NEVER o AND u\n" + old)
    (conflict,) = found.conflicts
    assert conflict.witness.triggers == ("t", "u")


def test_the_order_of_literals_makes_no_difference_where_constraints_alone_cannot_be_kept() -> None:
    old = "NEVER NightBegins AND NOT OpenDoor\nNEVER OpenDoor\nRULE a\nWHEN GuestComes THEN OpenDoor\n"
    found = edit(old, "NightBegins AND NOT OpenDoor", "NOT OpenDoor AND NightBegins")
    assert (found.relation, found.undecided) == ("equivalent", ())


def test_constraints_that_together_leave_nothing_to_do_are_a_new_conflict() -> None:
    old = "RULE a\nWHEN GuestComes THEN tea\nRULE b\nWHEN NightBegins THEN CloseBlinds\n"
    (conflict,) = differ(old, "NEVER NightBegins AND NOT OpenDoor\nNEVER OpenDoor\n" + old).conflicts
    assert (conflict.literals, conflict.rules, len(conflict.origins)) == ((), (), 2)
    assert conflict.witness.triggers == ("NightBegins",)


# Names that only constraints mention ----------------------------------------------------------------------

FALL = "RULE fall\nWHEN FallDetected AND Alone THEN CallNurse\n"
TEA = "RULE tea\nWHEN TeaTime THEN ServeTea AND NOT Hurry\n"


@pytest.mark.parametrize(
    "constraint",
    [
        "ASSUME NOT (FallDetected AND TeaTime)",
        "ASSUME NOT FallDetected OR Alone",
        "NEVER ServeTea AND FallDetected",
        "NEVER ServeTea AND Alone",
        "NEVER NOT ServeTea AND FallDetected AND NOT Alone",
        "NEVER ServeTea AND FallDetected\nASSUME NOT FallDetected OR Alone",
        "DOMAIN ward\nASSUME NOT (FallDetected AND TeaTime)\nDOMAIN everywhere",
    ],
)
def test_a_name_keeps_its_kind_when_the_last_rule_that_uses_it_is_deleted(constraint: str) -> None:
    old, new = f"{constraint}\n{FALL}{TEA}", f"{constraint}\n{TEA}"
    found = differ(old, new)
    assert found.relation == "laxer"
    assert (lost(found), found.situations, found.conflicts) == ({"CallNurse"}, (), ())
    assert {name.way for name in found.names} <= {"removed"}
    back = differ(new, old)
    assert (back.relation, gained(back), back.situations) == ("stricter", {"CallNurse"}, ())


@pytest.mark.parametrize("constraint", ["", "ASSUME NOT (FallDetected AND Asleep)\n", "NEVER Tea AND FallDetected\n"])
def test_a_name_in_a_hedge_keeps_its_kind_when_its_last_rule_is_deleted(constraint: str) -> None:
    rest = f"{constraint}{TEA}\nUNLESS FallDetected AND Asleep IN WHICH CASE Wait\n"
    old, new = FALL + rest, rest
    found = differ(old, new)
    assert found.relation == "laxer"
    assert (lost(found), gained(found), found.situations, found.conflicts) == ({"CallNurse"}, set(), (), ())
    assert {name.way for name in found.names} <= {"removed"}
    back = differ(new, old)
    assert (back.relation, gained(back), back.situations) == ("stricter", {"CallNurse"}, ())
    declared = differ(old, f"CONDITION FallDetected, Asleep\n{rest}")
    assert {(name.way, name.kind, name.name) for name in declared.names} >= {("added", "condition", "FallDetected")}


def test_a_declared_kind_is_not_taken_from_the_other_ruleset() -> None:
    constraint = "ASSUME NOT (FallDetected AND TeaTime)\n"
    found = differ(constraint + FALL + TEA, "CONDITION FallDetected\n" + constraint + TEA)
    assert NameChange("added", "condition", "FallDetected") in found.names
    assert found.situations


_NAMES = st.sampled_from(("t1", "t2", "t3", "c1", "c2"))
_LITERALS = st.tuples(st.sampled_from(("", "NOT ")), _NAMES).map("".join)
_CASES = st.lists(_LITERALS, min_size=1, max_size=3, unique=True).map(" AND ".join)
_CONSTRAINTS = st.one_of(
    _CASES.map("ASSUME NOT ({})\n".format),
    st.tuples(st.sampled_from(("o1", "NOT o1", "o2")), _CASES).map(lambda parts: "NEVER {} AND {}\n".format(*parts)),
)
_RULES = st.builds(
    "WHEN t{} AND {}c{} THEN {}o{}\n".format,
    st.integers(1, 3),
    st.sampled_from(("", "NOT ")),
    st.integers(1, 2),
    st.sampled_from(("", "NOT ")),
    st.integers(1, 3),
)


@settings(max_examples=150)
@given(
    st.lists(_CONSTRAINTS, min_size=1, max_size=3).map("".join),
    st.lists(_RULES, min_size=2, max_size=4),
    st.lists(st.booleans(), min_size=4, max_size=4),
)
def test_what_is_left_after_deleting_rules_demands_nothing_new(constraints, rules, keep) -> None:
    left = [rule for rule, kept in zip(rules, keep) if kept] or rules[:1]
    found = differ(constraints + "".join(rules), constraints + "".join(left))
    assert not gained(found)
    assert not found.situations
    assert all(conflict.way == "removed" for conflict in found.conflicts)
    assert all(name.way == "removed" for name in found.names)


# Situations -----------------------------------------------------------------------------------------------


def test_an_assumption_rules_situations_out() -> None:
    found = differ(CURTAINS, "ASSUME NOT (UserUndressed AND UserDistressed)\n" + CURTAINS)
    (situation,) = found.situations
    assert situation.way == "removed"
    assert situation.witness is not None
    assert situation.witness.conditions == {"UserUndressed": True, "UserDistressed": True}
    assert situation.extent is not None
    assert (situation.extent.affected, situation.extent.possible) == (1, 4)
    assert found.relation == "laxer"
    assert compare(found.new, found.old).relation == "stricter"


def test_an_assumption_that_says_nothing_new_is_equivalent() -> None:
    old = "ASSUME NOT UserUndressed\n" + CURTAINS
    assert differ(old, "ASSUME NOT UserUndressed OR NOT UserDistressed\n" + old).relation == "equivalent"


def test_nothing_is_compared_where_no_situation_is_shared() -> None:
    found = differ("ASSUME c\nWHEN t THEN o\n", "ASSUME NOT c\nWHEN t THEN p\n")
    assert [what for what, _ in found.undecided] == ["the obligations"]
    assert found.relation == "incomparable"  # by the situations
    assert not found.changes


def test_a_value_that_a_scale_gains() -> None:
    old = "MEASURE Risk: low < high\nRULE r\nWHEN t THEN o\nUNLESS Risk > low IN WHICH CASE p\n"
    found = edit(old, "low < high", "low < middle < high")
    (situation,) = found.situations
    assert situation.witness is not None
    assert situation.witness.conditions == {"Risk": "middle"}
    assert not found.changes
    moved = edit(old, "low < high", "high < low")
    assert {str(o) for change in moved.changes for o in (*change.added, *change.removed)} == {"o", "p"}


def test_a_number_that_becomes_a_whole_one() -> None:
    old = "MEASURE Age: number\nRULE r\nWHEN t THEN o\nUNLESS Age > 17 IN WHICH CASE p\n"
    found = edit(old, "number", "integer", "Age > 17", "Age >= 18")
    assert not found.changes
    assert [situation.what for situation in found.situations] == ["Age is a whole number"]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("MEASURE Risk: low < high\nWHEN t THEN o UNLESS Risk > low", "WHEN t THEN o UNLESS Risk > 3"),
        ("WHEN t THEN o UNLESS Risk", "WHEN t THEN o UNLESS Risk > 3"),
        ("WHEN t THEN o UNLESS Risk > 3", "WHEN t THEN o UNLESS Risk"),
    ],
)
def test_a_name_that_is_something_else_now_is_not_compared(old: str, new: str) -> None:
    found = differ(f"{old}\n", f"{new}\n")
    assert found.relation == "unknown"
    assert [what for what, _ in found.undecided] == ["Risk"]


# Times ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("before", "after", "relation"),
    [
        ("X WITHIN 5 minutes", "X WITHIN 300 seconds", "equivalent"),
        ("X WITHIN 5 minutes", "X WITHIN 10 minutes", "laxer"),
        ("X WITHIN 10 minutes", "X WITHIN 5 minutes", "stricter"),
        ("X WITHIN 5 minutes", "X EVENTUALLY", "laxer"),
        ("X", "X WITHIN 5 minutes", "laxer"),
        ("NOT X WITHIN 5 minutes", "NOT X WITHIN 10 minutes", "stricter"),
        ("NOT X WITHIN 5 minutes", "NOT X", "laxer"),
        ("X WITHIN 5 minutes OTHERWISE Y", "X WITHIN 5 minutes", "stricter"),
        ("X WITHIN 5 minutes", "X WITHIN 5 minutes OTHERWISE Y", "laxer"),
        ("X WITHIN 5 minutes OTHERWISE Y", "X WITHIN 5 minutes OTHERWISE Z", "incomparable"),
        ("X WITHIN 5 minutes OTHERWISE Y", "X WITHIN 6 minutes OTHERWISE Y", "incomparable"),
        ("X WITHIN 5 minutes OTHERWISE Y", "X WITHIN 5 minutes OTHERWISE Y WITHIN 1 minute", "laxer"),
        ("X WITHIN 5 minutes OTHERWISE Y", "X WITHIN 5 minutes OTHERWISE (Y AND Z)", "stricter"),
        ("X WITHIN 5 minutes OTHERWISE Y", "X WITHIN 300 seconds OTHERWISE Y", "equivalent"),
        ("X WITHIN 5 minutes OTHERWISE X WITHIN 1 minute", "X WITHIN 6 minutes", "equivalent"),
        ("X WITHIN 5 minutes OTHERWISE Y", "X WITHIN 5 minutes ELSE Y WITHIN [5, 5] minutes", "equivalent"),
        ("X WITHIN 5 minutes OTHERWISE Y", "X WITHIN 5 minutes OTHERWISE (Y UNLESS c)", "laxer"),
        ("X WITHIN 5 minutes OTHERWISE Y", "X WITHIN 5 minutes OTHERWISE (Y UNLESS c IN WHICH CASE Z)", "incomparable"),
        ("X ELSE Y", "Y ELSE X", "equivalent"),
        ("X ELSE NOT X", "Y ELSE NOT Y", "equivalent"),
        ("X WITHIN n minutes OTHERWISE Y", "X WITHIN n minutes OTHERWISE Z", "unknown"),
        ("X WITHIN 5 minutes AND Y", "X WITHIN 5 minutes AND Z", "incomparable"),
    ],
)
def test_windows(before: str, after: str, relation: str) -> None:
    beside = "MEASURE n: integer\nRULE s\nWHEN u AND n > 3 THEN W\n"
    found = differ(f"{beside}RULE r\nWHEN t THEN {before}\n", f"{beside}RULE r\nWHEN t THEN {after}\n")
    assert found.relation == relation
    assert bool(found.undecided) == (relation == "unknown")


def test_the_hedges_of_what_is_due_in_place_are_counted() -> None:
    old = "RULE r\nWHEN t THEN X WITHIN 5 minutes OTHERWISE (Y UNLESS c IN WHICH CASE Z UNLESS d)\n"
    (change,) = edit(old, "CASE Z", "CASE W").changes
    assert (change.extent.affected, change.extent.possible) == (1, 4)
    assert change.witness.conditions == {"c": True, "d": False}
    assert [str(o.timing) for o in change.added] == ["within 5 minutes, otherwise W"]
    # The reading decides these hedges, too.
    (change,) = differ(f"READING cascade\n{old}", f"READING priority\n{old}").changes
    assert change.witness.conditions == {"c": False, "d": True}


def test_windows_with_hedges_are_compared_where_they_apply() -> None:
    old = "RULE r\nWHEN t THEN X WITHIN 5 minutes\nUNLESS c IN WHICH CASE Y\n"
    (change,) = edit(old, "UNLESS c IN", "UNLESS c OR d IN").changes
    assert [str(o) for o in change.added] == ["Y"]
    assert [str(o.timing) for o in change.removed] == ["within 5 minutes"]


def test_a_response_that_may_come_at_any_time() -> None:
    old, new = (
        parse(f"RULE r\nWHEN t THEN {x}\nRULE s\nWHEN u THEN Z WITHIN 1 minute\n") for x in ("X", "X EVENTUALLY")
    )
    assert compare(old, new).relation == "laxer"
    assert compare(old, new, untimed="eventually").relation == "equivalent"


def test_relations_of_one_moment_are_kept_and_those_of_several_named() -> None:
    old = "RELATION ALWAYS c IMPLIES d\nRULE r\nWHEN t THEN X WITHIN 1 minute\nUNLESS c AND NOT d IN WHICH CASE Y\n"
    assert edit(old, "CASE Y", "CASE Z").relation == "equivalent"
    found = edit(old, "RELATION ALWAYS c IMPLIES d", "RELATION t PRECEDES u")
    assert [what for what, _ in found.undecided] == ["the relation happenBefore"]
    assert [situation.way for situation in found.situations] == ["added"]


# Bounds ---------------------------------------------------------------------------------------------------


def test_what_is_not_counted_is_told_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(decision_diagram, "MOST_NODES", 5)
    found = edit(CURTAINS, "UNLESS UserUndressed IN", "UNLESS UserUndressed OR WindowOpen IN")
    assert {change.extent.affected for change in found.changes} == {None}
    assert all("more than 5 nodes" in str(change.extent.why) for change in found.changes)
    assert (gained(found), lost(found)) == ({"RefuseRequest", "ExplainWhy", "WarnUser"}, {"OpenCurtains"})


def test_many_rules_that_change_are_all_told() -> None:
    rules = "".join(f"RULE r{n}\nWHEN t{n} THEN o UNLESS c IN WHICH CASE p{n}\n" for n in range(300))
    found = compare(parse(rules), parse(rules.replace("UNLESS c", "UNLESS d")))
    assert len({change.rules for change in found.changes}) == 300


def test_labels_that_two_rules_have() -> None:
    old = parse("RULE a\nWHEN t THEN o\nRULE b\nWHEN u THEN p\n")
    twice = replace(old, statements=tuple(replace(r, label="a") for r in old.statements if isinstance(r, Rule)))
    assert compare(old, twice).relation == "equivalent"
    assert compare(twice, old).relation == "equivalent"


_PLACES = {
    "a guard": "WHEN T AND {} THEN X",
    "a hedge": "WHEN T THEN X UNLESS {} IN WHICH CASE Y",
    "an assumption": "WHEN T THEN X ASSUME c OR {}",
    "a prohibition": "WHEN T THEN X NEVER X AND {}",
    "a relation": "WHEN T THEN X RELATION ALWAYS {} IMPLIES c",
}


@pytest.mark.parametrize("comparison", ["m > 1", "m = low"])
@pytest.mark.parametrize("other", _PLACES)
@pytest.mark.parametrize("one", _PLACES)
def test_a_condition_that_is_a_measure_in_the_other_text_is_undecided(one: str, other: str, comparison: str) -> None:
    condition = "CONDITION m, c " + _PLACES[one].format("m")
    measure = f"MEASURE m: {'number' if '>' in comparison else 'low < high'} " + _PLACES[other].format(comparison)
    for found in (differ(condition, measure), differ(measure, condition)):
        assert found.relation == "unknown"
        assert found.undecided == (("m", "m is true or false in the one text and a measure in the other"),)
