"""Windows and what is due in place of a response, and the bounds of a comparison."""

from __future__ import annotations

from dataclasses import replace

import pytest

from sleec_runtime.language import parse
from sleec_runtime.model import Rule
from sleec_verify.changes.compare import compare
from sleec_verify.changes.diagram import decision_diagram
from tests.support.differences import CURTAINS, differ, edit, gained, lost


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
        ("X WITHIN 5 minutes AND Y", "X WITHIN 5 minutes", "laxer"),
        ("X WITHIN 5 minutes", "X WITHIN [1, 5] minutes", "stricter"),
        ("X WITHIN [1, 5] minutes", "X WITHIN [2, 6] minutes", "incomparable"),
        ("NOT X WITHIN [1, 5] minutes", "NOT X WITHIN 5 minutes", "stricter"),
        ("NOT X WITHIN 5 minutes", "NOT X EVENTUALLY", "stricter"),
        ("X WITHIN 5 minutes", "NOT X WITHIN 5 minutes", "incomparable"),
        ("X EVENTUALLY", "X WITHIN [0, 9] minutes", "stricter"),
        ("X EVENTUALLY", "X EVENTUALLY ELSE Y", "laxer"),
        ("X EVENTUALLY OTHERWISE Y", "X EVENTUALLY", "stricter"),
        ("X WITHIN 5 minutes", "X WITHIN 5 minutes ELSE Y", "laxer"),
        ("X WITHIN 5 minutes ELSE Y", "X WITHIN 5 minutes ELSE Y WITHIN 1 minute", "laxer"),
        ("X WITHIN 5 minutes ELSE Y", "X WITHIN 4 minutes ELSE Y", "stricter"),
        ("X WITHIN 5 minutes ELSE Y", "X WITHIN 5 minutes OTHERWISE Y", "incomparable"),
        ("X WITHIN 5 minutes OTHERWISE Y OTHERWISE Z", "X WITHIN 5 minutes OTHERWISE Y", "stricter"),
        ("X WITHIN 5 minutes OTHERWISE NOT Y", "X WITHIN 5 minutes OTHERWISE NOT Y WITHIN 1 minute", "stricter"),
        ("NOT X WITHIN 5 minutes OTHERWISE Y", "NOT X WITHIN 5 minutes", "stricter"),
        ("X WITHIN 5 minutes OTHERWISE X EVENTUALLY", "X EVENTUALLY", "equivalent"),
        ("X WITHIN 5 minutes UNLESS c", "X WITHIN 5 minutes", "stricter"),
        ("X WITHIN 5 minutes UNLESS c", "X WITHIN 4 minutes UNLESS c", "stricter"),
        ("X WITHIN 5 minutes UNLESS c IN WHICH CASE X WITHIN 9 minutes", "X WITHIN 9 minutes", "laxer"),
        ("X WITHIN 5 minutes UNLESS c IN WHICH CASE Y", "X WITHIN 5 minutes UNLESS c IN WHICH CASE Z", "incomparable"),
        ("X WITHIN 5 minutes OTHERWISE (Y UNLESS c)", "X WITHIN 5 minutes OTHERWISE (Y UNLESS d)", "incomparable"),
        ("X WITHIN n minutes", "X WITHIN n minutes", "equivalent"),
        ("X WITHIN n minutes", "X WITHIN n minutes AND Y", "stricter"),
        ("X WITHIN n minutes", "X WITHIN 5 minutes", "unknown"),
    ],
)
def test_windows(before: str, after: str, relation: str) -> None:
    beside = "MEASURE n: integer\nRULE s\nWHEN u AND n > 3 THEN W\n"
    sides = [f"{beside}RULE r\nWHEN t THEN {response}\n" for response in (before, after)]
    mirrored = {"stricter": "laxer", "laxer": "stricter"}
    for (old, new), expected in ((sides, relation), (sides[::-1], mirrored.get(relation, relation))):
        found = differ(old, new)
        assert found.relation == expected
        assert bool(found.undecided) == (expected == "unknown")


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
        assert found.undecided == (("m", "`m` is true or false in one version and a measure in the other"),)
