"""What two checks find of one rule or hedge is one finding for people, and two for programs."""

from __future__ import annotations

import json

import pytest

from tests.support.cli import Cli

DEAD = "MEASURE Heat: number\nWHEN Rung THEN Open\nUNLESS Heat > 4 AND Heat < 3 IN WHICH CASE Wait\n"
DEAD_AND_NEEDED = "READING cascade\nASSUME NOT a OR b\nWHEN Rung THEN Open\nUNLESS a IN WHICH CASE Wait\nUNLESS b\n"
REPEATED = "WHEN Rung THEN Open\nUNLESS a IN WHICH CASE Open\n"
NEVER = "MEASURE Heat: number\nRULE never\nWHEN Rung AND Heat > 4 AND Heat < 3 THEN Open\n"
TIMED = (
    "def_start event A event B measure x: numeric def_end\n"
    "rule_start R1 when A then B within 2 seconds unless (({x} > 4) and ({x} < 3)) then not B within 2 seconds\n"
    "rule_end\n"
)


@pytest.mark.parametrize(
    ("text", "told", "found"),
    [
        (DEAD, ["SLEEC202"], ["SLEEC202", "SLEEC302"]),
        (TIMED, ["SLEEC202"], ["SLEEC202", "SLEEC302"]),
        (DEAD_AND_NEEDED, ["SLEEC202"], ["SLEEC202"]),
        (REPEATED, ["SLEEC302"], ["SLEEC302"]),
        (NEVER, ["SLEEC201"], ["SLEEC201", "SLEEC301"]),
    ],
)
def test_a_dead_rule_or_hedge_is_told_once(cli: Cli, text: str, told: list[str], found: list[str]) -> None:
    codes = {"SLEEC201", "SLEEC202", "SLEEC301", "SLEEC302"}
    concise = cli("check", "a.sleec", "--format", "concise", files={"a.sleec": text}).out
    assert [code for line in concise.splitlines() for code in sorted(codes) if f"[{code}]" in line] == told
    report = json.loads(cli("check", "a.sleec", "--format", "json", files={"a.sleec": text}).out)
    assert [f["code"] for f in report["rulesets"][0]["findings"] if f["code"] in codes] == found


def test_that_a_dead_hedge_can_go_is_told_with_it(cli: Cli) -> None:
    both = cli("check", "a.sleec", files={"a.sleec": DEAD}).out
    assert "help: correct its condition, or remove it; the rules mean the same without it\n" in both
    one = cli("check", "a.sleec", files={"a.sleec": DEAD_AND_NEEDED}).out
    assert "help: correct its condition or the exception `UNLESS b` and the ASSUME in line 2, or remove it\n" in one
