"""Situations that edits rule out, and times."""

from __future__ import annotations

import pytest

from sleec_verify.changes.compare import compare
from tests.support.differences import CURTAINS, differ, edit


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
    assert [situation.what for situation in found.situations] == ["`Age` is a whole number"]


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
