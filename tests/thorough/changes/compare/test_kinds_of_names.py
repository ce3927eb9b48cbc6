"""Names that only constraints mention keep their kind."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sleec_verify.changes.compare import NameChange
from tests.support.differences import differ, gained, lost

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
