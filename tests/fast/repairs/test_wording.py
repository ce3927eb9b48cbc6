"""Names that read like something else are replaced by what they say."""

from __future__ import annotations

from typing import Any

import pytest

from sleec_runtime.language import parse
from sleec_runtime.model import Ruleset
from sleec_verify.checks import run_checks
from sleec_verify.checks.misread_names import misreadings
from sleec_verify.repairs.search import RepairSearch
from tests.support.repairs import findings, repairs_of, texts_after

CHANGES = {
    "SLEEC520": ("the robot is not allowed to leave", "NOT leave"),
    "SLEEC521": ("the robot has to leave", "leave"),
    "SLEEC524": ("leave IMMEDIATELY", "leave"),
}
TEXT = "WHEN the bell rings THEN {} // at last\n\nWHEN a guest comes THEN greet\nUNLESS it rains IN WHICH CASE {}\n"


@pytest.mark.parametrize("code", CHANGES)
def test_an_obligation_changes_at_all_its_places(code: str) -> None:
    wrong, right = CHANGES[code]
    text = TEXT.format(wrong, wrong)
    (repair,) = repairs_of(text, code)
    assert repair.candidate.operator == "canonical-form"
    assert repair.candidate.title == f"replace `{wrong}` with `{right}` in 2 places"
    assert texts_after(text, [repair]) == [TEXT.format(right, right)]


def test_a_condition_becomes_a_comparison() -> None:
    text = "WHEN a guest comes THEN greet\nUNLESS the guest is under 6 IN WHICH CASE wave\n"
    assert texts_after(text, repairs_of(text, "SLEEC522")) == [text.replace("the guest is under 6", "age < 6")]


def test_one_of_two_opposites_is_a_negation() -> None:
    text = "WHEN a guest comes THEN greet UNLESS the door is open\nWHEN it rains THEN wait UNLESS the door is closed\n"
    (new,) = texts_after(text, repairs_of(text, "SLEEC523"))
    assert new.count("NOT the door is") == 1


def test_one_of_two_similar_names_is_used_everywhere() -> None:
    text = TEXT.format("take photos", "take photo") + "WHEN it snows THEN take photo\n"
    (repair,) = repairs_of(text, "SLEEC525")
    assert repair.candidate.operator == "renaming"
    assert texts_after(text, [repair]) == [text.replace("photos", "photo")]


def test_the_definition_of_a_variant_is_removed_from_the_dsl() -> None:
    text = (
        "def_start\n  event Called\n  event Photo\n  event Bell\n  event TakePhoto as system // once\n"
        "  event TakePhotos\ndef_end\nrule_start\n"
        "  R1 when Called then TakePhotos\n  TakePhoto when Photo then TakePhoto\n"
        "  R3 when Bell then TakePhotos\nrule_end\n"
    )
    defined = text.replace("  event TakePhoto as system // once\n", "")
    assert texts_after(text, repairs_of(text, "SLEEC525")) == [defined.replace("then TakePhoto\n", "then TakePhotos\n")]


def test_a_name_that_hides_a_conflict_stays_for_the_author() -> None:
    text = "WHEN the user falls THEN call the nurse\nWHEN the user sleeps THEN NOT call nurse\n"
    assert not repairs_of(text, "SLEEC525")
    assert not repairs_of("WHEN the bell rings THEN greet UNLESS is less than 10 IN WHICH CASE wave\n", "SLEEC522")


def test_replacements_of_equal_rules_have_the_places_of_their_text() -> None:
    text = "WHEN the user sleeps THEN the robot has to wait\n"
    for written in (text, f"\n\n{text}", f"// sleep\n{text}"):
        (repair,) = repairs_of(written, "SLEEC521")
        assert texts_after(written, [repair]) == [written.replace("the robot has to wait", "wait")]


def test_misread_names_are_found_once_for_all_findings(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Ruleset] = []

    def noting(ruleset: Ruleset, *used: Any) -> Any:
        asked.append(ruleset)
        return misreadings(ruleset, *used)

    ruleset = parse("".join(f"WHEN the bell rings THEN the robot has to do task{n}x\n" for n in range(5)))
    results = run_checks(ruleset)
    found = [finding for finding in findings(results) if finding.code == "SLEEC521"]
    assert len(found) == 5
    monkeypatch.setattr("sleec_verify.checks.misread_names.misreadings", noting)
    search = RepairSearch(ruleset, results)
    assert all(search.candidates(finding) for finding in found)
    assert len(asked) == 1
