"""Conflicts over time that edits add and remove."""

from __future__ import annotations

from random import Random

import pytest

from sleec_runtime.language import parse
from sleec_verify.changes.compare import Difference, compare
from tests.support.differences import differ
from tests.support.explicit.conflicts import Explicit

FALL = "RULE fall\nWHEN Fell THEN Call WITHIN 3 seconds\n"
REST = "RULE rest\nWHEN Slept THEN NOT Call WITHIN 2 seconds\n"
DUST = "RULE dust\nWHEN Seen THEN Sweep WITHIN 2 seconds\n"


def changed(found: Difference) -> list[tuple[str, set[str]]]:
    return [(one.way, set(one.rules)) for one in found.timed_conflicts]


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        (FALL, FALL + REST, [("added", {"fall", "rest"})]),
        (FALL + REST, FALL, [("removed", {"fall", "rest"})]),
        (FALL + REST, FALL + REST.replace("2", "1"), []),
        (FALL + REST, (FALL + REST).replace("fall", "falls"), []),
        (FALL + REST, FALL + REST + DUST, []),
        (FALL + REST, FALL + REST.replace("Slept", "Slept AND Night"), []),
        (FALL + REST, FALL + REST.strip() + "\nUNLESS Night\n", []),
        (FALL + REST, FALL.strip() + " OTHERWISE Ring\n" + REST, [("removed", {"fall", "rest"})]),
        (
            FALL + REST,
            FALL.replace("3 seconds", "EVENTUALLY").replace("WITHIN ", "") + REST,
            [("removed", {"fall", "rest"})],
        ),
        (
            FALL + REST.strip() + "\nUNLESS Night IN WHICH CASE NOT Sweep WITHIN 2 seconds\n" + DUST,
            FALL + REST.strip() + "\nUNLESS Late\nUNLESS Night IN WHICH CASE NOT Sweep WITHIN 2 seconds\n" + DUST,
            [],
        ),
        (FALL, f"{FALL}RELATION Ring PRECEDES Call\n", [("added", {"fall"})]),
        (
            f"DOMAIN home, ward\n{FALL}DOMAIN ward\n{REST}",
            f"DOMAIN home, ward\n{FALL}DOMAIN home, ward\n{REST}",
            [("added", {"fall", "rest"})],
        ),
    ],
)
def test_edits(old: str, new: str, expected: list[tuple[str, set[str]]]) -> None:
    assert changed(differ(old, new)) == expected


def test_a_conflict_at_one_instant_is_told_once() -> None:
    found = differ(FALL, FALL + "RULE a\nWHEN A THEN X\nRULE b\nWHEN B THEN NOT X AND Call WITHIN 1 second\n")
    assert [one.way for one in found.conflicts] == ["added"]
    assert changed(found) == []


def test_a_conflict_has_its_timeline() -> None:
    (conflict,) = differ(FALL, FALL + REST).timed_conflicts
    assert conflict.finding.timeline is not None
    assert conflict.finding.code == "SLEEC101"
    assert conflict.domains == ()


def random_rules(random: Random) -> list[str]:
    """Three rules over few events, with windows of at most two seconds."""

    def response(depth: int) -> str:
        text = f"{random.choice(('', '', 'NOT '))}{random.choice('ABCD')}"
        text += random.choice(("", " WITHIN 2 seconds", " WITHIN 1 TO 2 seconds"))
        return f"({text} OTHERWISE {response(0)})" if depth and random.random() < 0.25 else text

    return [f"RULE r{number}\nWHEN {random.choice('ABCD')} THEN {response(1)}\n" for number in range(3)]


def conflicts_of_rules(text: str) -> set[frozenset[str]]:
    """The sets of rules in conflict, by the list of all states, without those that contain another one."""
    every = {frozenset(rules) for rules in Explicit(parse(text)).conflicts()}
    return {rules for rules in every if not any(fewer < rules for fewer in every)}


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(40))
def test_random_edits_against_the_list_of_all_states(seed: int) -> None:
    """No smallest set of rules in conflict appears or disappears unreported."""
    random = Random(seed)
    rules = random_rules(random)
    edited = [random_rules(random)[0] if number == 0 else rule for number, rule in enumerate(rules)]
    declared = "EVENT A, B, C, D\n"
    old, new = declared + "".join(rules), declared + "".join(edited)
    found = compare(parse(old), parse(new))
    if found.undecided:
        return
    before, after = conflicts_of_rules(old), conflicts_of_rules(new)
    told = {(one.way, frozenset(one.rules)) for one in found.all_conflicts}
    assert {("added", rules) for rules in after - before} <= told
    assert {("removed", rules) for rules in before - after} <= told
    for one in found.all_conflicts:
        every = Explicit(parse(new if one.way == "added" else old)).conflicts()
        assert any(frozenset(one.rules) >= rules for rules in every)
    back = compare(parse(new), parse(old))
    mirrored = {"added": "removed", "removed": "added"}
    assert {(mirrored[one.way], frozenset(one.rules)) for one in back.all_conflicts} == told
    assert (back.more, back.less) == (found.less, found.more)
