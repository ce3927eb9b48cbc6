"""Conflicts that edits bring and take away."""

from __future__ import annotations

from sleec_verify.changes.compare import compare
from tests.support.differences import differ, edit, gained


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
