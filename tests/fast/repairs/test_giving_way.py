"""Repairs of a conflict: one of its rules gives way to the others."""

from __future__ import annotations

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.repairs.edit import edited
from sleec_verify.repairs.repair import Repair
from sleec_verify.repairs.search import RepairSearch

CURTAINS = """RULE privacy
WHEN CurtainOpenRequest THEN OpenCurtains
UNLESS UserUndressed IN WHICH CASE NOT OpenCurtains
RULE air // fresh air
WHEN CurtainOpenRequest AND RoomStuffy THEN OpenCurtains AND OpenWindow // because
"""


def repairs_of(text: str, code: str = "SLEEC101") -> list[Repair]:
    ruleset = parse(text)
    results = run_checks(ruleset)
    search = RepairSearch(ruleset, results)
    return [one for result in results for f in result.findings if f.code == code for one in search.repairs(f)]


def test_a_rule_gives_way_by_a_condition_at_its_trigger() -> None:
    texts = {edited(CURTAINS, repair.candidate.edits) for repair in repairs_of(CURTAINS)}
    assert CURTAINS.replace("AND RoomStuffy", "AND RoomStuffy AND NOT UserUndressed") in texts


def test_what_takes_away_least_is_first() -> None:
    found = repairs_of(CURTAINS)
    harms = [repair.effect.harm for repair in found]
    assert harms == sorted(harm for harm in harms if harm is not None)
    # The window and the curtains are two duties.
    titles = [repair.candidate.title for repair in found]
    assert titles.index("add to rule `air`: `UNLESS UserUndressed IN WHICH CASE OpenWindow`") < titles.index(
        "add to the trigger of rule `air`: `AND NOT UserUndressed`"
    )


def test_no_repair_leaves_or_adds_a_finding() -> None:
    for repair in repairs_of(CURTAINS):
        again = [f for result in run_checks(repair.repaired) for f in result.findings]
        assert not again, repair.candidate.title
