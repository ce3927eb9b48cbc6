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


BELL = "situations in which `Bell` occurs"
HERE = "in the situation of the conflict, the rules then require"
LESS = f"rule `a`, in 1 of 2 {BELL}: `Speak` and `Rise` are no longer required; {HERE} `NOT Speak`"
SHORTER = "rule `a`, in every situation in which `Bell` occurs: `Speak` is no longer required"
NEVER = "NEVER Speak\nRULE a\nWHEN Bell THEN Speak AND Rise\n"
POLITE = "ALWAYS smile\nRULE a\nWHEN Bell THEN NOT smile\nRULE b\nWHEN Bell THEN smile AND Rise\n"


@pytest.mark.parametrize(
    ("text", "code", "title", "effect"),
    [
        (f"{CLASH}UNLESS Storm AND NOT Storm IN WHICH CASE Wait\n", "SLEEC202", "remove .*", "the rules mean the same"),
        (CLASH, "SLEEC101", "add to the trigger of rule `a`: .*", f"{LESS}; nothing else changes"),
        (
            CLASH,
            "SLEEC101",
            "remove `Speak` from rule `a`",
            f"{SHORTER}; {HERE} `Rise` and `NOT Speak`; nothing else changes",
        ),
        (EXCLUSIVE, "SLEEC101", "add `ASSUME .*", "1 of 4 situations is assumed not to occur; nothing else changes"),
        (
            f"{CLASH}RULE c\nWHEN Bell AND Storm THEN NOT Rise\n",
            "SLEEC101",
            "remove rule `a`",
            (
                "rule `a`, in every situation in which `Bell` occurs: `Speak` and `Rise` are no longer required; "
                f"{HERE} `NOT Speak`; 1 other conflict is resolved; nothing else changes"
            ),
        ),
        (
            f"{CLASH}PURPOSE p EXISTS Bell AND Late WHILE Speak\n",
            "SLEEC105",
            "remove rule `b`",
            f"rule `b`, in 1 of 2 {BELL}: `Speak` is no longer forbidden; 1 conflict is resolved; nothing else changes",
        ),
        (
            TIMED,
            "SLEEC101",
            "remove rule `R2`.*",
            "this conflict is resolved, and 1 other one of its rules remains; nothing else changes",
        ),
        (
            NEVER,
            "SLEEC101",
            "remove `NEVER Speak`",
            (
                f"`NEVER Speak`, in every situation: `Speak` is no longer forbidden; {HERE} `Speak` and `Rise`; "
                "nothing else changes"
            ),
        ),
        (
            NEVER.replace("NEVER Speak", "NEVER Speak AND Rise"),
            "SLEEC101",
            "add to `NEVER Speak AND Rise`: `UNLESS Bell`",
            (
                "`NEVER Speak AND Rise`, in 1 of 2 situations: this is no longer forbidden; "
                f"{HERE} `Speak` and `Rise`; nothing else changes"
            ),
        ),
        (
            POLITE,
            "SLEEC101",
            "remove `ALWAYS smile`",
            "in the situation of the conflict, the rules still contradict each other; nothing else changes",
        ),
        (
            f"{POLITE}RULE c\nWHEN Night THEN Sleep\n",
            "SLEEC101",
            "remove `ALWAYS smile`",
            (
                "`ALWAYS smile`, in every situation in which `Night` occurs: `smile` is no longer required; "
                "in the situation of the conflict, the rules still contradict each other; nothing else changes"
            ),
        ),
    ],
)
def test_effects(text: str, code: str, title: str, effect: str) -> None:
    assert effect_in_words(repair(text, code, title)) == effect


def test_an_unknown_effect_is_no_unchanged_meaning() -> None:
    found = repair(CLASH, "SLEEC101", "add to the trigger of rule `a`: .*")
    difference = found.effect.difference._replace(undecided=(Undecidable("rules", "the solver gave up"),))
    unknown = replace(found, effect=replace(found.effect, difference=difference, situations=None))
    assert effect_in_words(unknown) == f"{LESS}; the rest of the effect is unknown: the solver gave up"


def test_a_repair_that_leaves_a_contradiction_comes_last() -> None:
    ruleset = parse(POLITE)
    results = run_checks(ruleset)
    search = RepairSearch(ruleset, results)
    finding = next(f for result in results for f in result.findings if "a" in f.rules and f.code == "SLEEC101")
    effects = [repair.effect.after_conflict for repair in search.repairs(finding)]
    assert [effect is not None and effect.is_conflict for effect in effects] == [False, True]
