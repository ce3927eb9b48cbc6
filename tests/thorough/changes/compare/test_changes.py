"""Obligations that edits bring and take away."""

from __future__ import annotations

from sleec_runtime.language import parse
from sleec_runtime.model import Obligation
from sleec_verify.changes.compare import NameChange, compare
from tests.support.differences import CURTAINS, differ, edit, gained, lost


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
