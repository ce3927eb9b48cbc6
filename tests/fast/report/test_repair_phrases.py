"""The effect of a repair in one line."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from sleec_runtime.language import parse
from sleec_verify.changes.compare import Undecidable
from sleec_verify.checks import run_checks
from sleec_verify.repairs.repair import Repair
from sleec_verify.repairs.search import RepairSearch
from sleec_verify.report.repair_phrases import effect_in_words

CLASH = "RULE a\nWHEN Bell THEN Speak AND Rise\nRULE b\nWHEN Bell AND Late THEN NOT Speak\n"
EXCLUSIVE = "EXCLUSIVE Open, Lock\nRULE a\nWHEN Bell THEN Open\nRULE b\nWHEN Night THEN Lock\n"
TIMED = """\
def_start
    event Bell
    event Speak
    measure Storm: boolean
def_end
rule_start
    R1 when Bell then not Speak within 5 minutes
    R2 when Bell and {Storm} then Speak within 2 minutes
    R3 when Bell then Speak
rule_end
"""


def repair(text: str, code: str, title: str) -> Repair:
    """The first repair with this title of a finding with this code."""
    ruleset = parse(text)
    results = run_checks(ruleset)
    search = RepairSearch(ruleset, results)
    found = [f for result in results for f in result.findings if f.code == code]
    return next(one for f in found for one in search.repairs(f) if re.fullmatch(title, one.candidate.title))


HERE = "in the situation of the conflict, the rules then require"
INSTEAD = f"{HERE} `NOT Speak`"
SHORTER = f"{HERE} `Rise` and `NOT Speak`; rule `a`, in 1 of 2 situations in which `Bell` occurs: "
REMOVED = f"{HERE} `NOT Speak`; 1 other conflict is resolved; rule `a`, in 1 of 4 situations in which "


@pytest.mark.parametrize(
    ("text", "code", "title", "effect"),
    [
        (f"{CLASH}UNLESS Storm AND NOT Storm IN WHICH CASE Wait\n", "SLEEC202", "remove .*", "the rules mean the same"),
        (CLASH, "SLEEC101", "add to the trigger of rule `a`: .*", f"{INSTEAD}; nothing else changes"),
        (CLASH, "SLEEC101", "remove `Speak` from rule `a`", f"{SHORTER}`Speak` is no longer required"),
        (EXCLUSIVE, "SLEEC101", "add `ASSUME .*", "1 of 4 situations is assumed not to occur"),
        (
            f"{CLASH}RULE c\nWHEN Bell AND Storm THEN NOT Rise\n",
            "SLEEC101",
            "remove rule `a`",
            f"{REMOVED}`Bell` occurs: `Speak` and `Rise` are no longer required",
        ),
        (
            f"{CLASH}PURPOSE p EXISTS Bell AND Late WHILE Speak\n",
            "SLEEC105",
            "remove rule `b`",
            "1 conflict is resolved; nothing else changes",
        ),
        (TIMED, "SLEEC101", "remove rule `R2`.*", "the conflict is resolved; nothing else changes"),
    ],
)
def test_effects(text: str, code: str, title: str, effect: str) -> None:
    assert effect_in_words(repair(text, code, title)) == effect


def test_an_unknown_effect_is_no_unchanged_meaning() -> None:
    found = repair(CLASH, "SLEEC101", "add to the trigger of rule `a`: .*")
    difference = found.effect.difference._replace(undecided=(Undecidable("rules", "the solver gave up"),))
    unknown = replace(found, effect=replace(found.effect, difference=difference, situations=None))
    assert effect_in_words(unknown) == f"{INSTEAD}; the rest of the effect is unknown: the solver gave up"


def test_more_than_two_changes_are_counted() -> None:
    found = repair(CLASH, "SLEEC101", "remove `Speak` from rule `a`")
    difference = found.effect.difference._replace(changes=found.effect.difference.changes * 4)
    many = replace(found, effect=replace(found.effect, difference=difference))
    assert effect_in_words(many).endswith("; 2 more changes")
