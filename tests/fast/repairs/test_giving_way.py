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


def test_the_smallest_change_is_first() -> None:
    sizes = [repair.effect.situations for repair in repairs_of(CURTAINS)]
    assert sizes[0] == 0
    assert sizes == sorted(size for size in sizes if size is not None)


def test_no_repair_leaves_or_adds_a_finding() -> None:
    for repair in repairs_of(CURTAINS):
        again = [f for result in run_checks(repair.repaired) for f in result.findings]
        assert not again, repair.candidate.title
