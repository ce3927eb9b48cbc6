"""Excerpts of sources, situations in words, and the renderers on what the documents do not show."""

from __future__ import annotations

import json
from fractions import Fraction

import pytest

from sleec_runtime.language import parse
from sleec_runtime.model import Context, Source, Span, Value
from sleec_verify.cli import exits
from sleec_verify.report import FORMATS, renderer
from sleec_verify.report.escape import as_line
from sleec_verify.report.excerpt import Mark, excerpt
from sleec_verify.report.outcome import CheckedRuleset
from sleec_verify.report.palette import PLAIN, Palette
from sleec_verify.results.finding import CheckResult, Finding, Proved, Refuted, Unknown, Witness
from sleec_verify.results.json_values import values_json
from sleec_verify.wording.phrases import context_text, listed, value_text, witness_text


def shown(text: str, *marks: Mark) -> str:
    return "\n".join(excerpt(Source("a", text), marks, PLAIN))


def main_mark(start: int, end: int) -> Mark:
    return Mark(Span(start, end), "error", main=True)


def test_marks_are_below_what_they_mark() -> None:
    assert shown("one two three", main_mark(4, 7)) == "  |\n1 | one two three\n  |     ^^^"


def test_other_marks_have_words_and_lines_between_are_left_out() -> None:
    text = "one\ntwo\nthree\nfour"
    marked = shown(text, main_mark(0, 3), Mark(Span(14, 18), word="the other"))
    assert marked == "  |\n1 | one\n  | ^^^\n…\n4 | four\n  | ---- the other"


def test_several_lines() -> None:
    assert shown("when a\n  then b\n\nend", main_mark(5, 21)) == (
        "  |\n1 | when a\n  |      ^\n2 |   then b\n  |   ^^^^^^\n…\n4 | end\n  | ^^^"
    )


def test_many_lines_are_cut() -> None:
    text = "".join(f"line {number}\n" for number in range(1, 21))
    lines = shown(text, main_mark(0, len(text) - 1)).splitlines()
    assert [line for line in lines if "line" in line] == [f" {n} | line {n}" for n in range(1, 6)] + ["20 | line 20"]


def test_end_of_text_is_marked() -> None:
    assert shown("ab", main_mark(2, 2)) == "  |\n1 | ab\n  |   ^"
    assert shown("", main_mark(0, 0)) == "  |\n1 |\n  | ^"


def test_long_line_is_cut_around_the_mark() -> None:
    text = "x" * 5_000_000 + "here" + "y" * 5_000_000
    lines = shown(text, main_mark(5_000_000, 5_000_004)).splitlines()
    assert max(map(len, lines)) < 140
    at = lines[2].index("^")
    assert lines[1][at : at + 4] == "here"
    assert lines[2].count("^") == 4


def test_long_mark_is_cut() -> None:
    lines = shown("x" * 1000, main_mark(0, 1000)).splitlines()
    assert len(lines[2]) == len("  | ") + 120


def test_nothing_steers_the_terminal() -> None:
    marked = shown("a\x1b[31m\u202eb\tc", main_mark(7, 8))
    assert marked == "  |\n1 | a\ufffd[31m\ufffdb c\n  |        ^"


def test_wide_and_combining_characters_keep_marks_in_place() -> None:
    assert shown("窓 e\u0301 x", main_mark(5, 6)).splitlines()[-1] == "  |      ^"
    assert shown("窓", main_mark(0, 1)).splitlines()[-1] == "  | ^^"


def test_no_marks_no_excerpt() -> None:
    assert shown("text") == ""


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (True, "true"),
        (False, "false"),
        (15, "15"),
        (Fraction(366, 10), "36.6"),
        (Fraction(1, 3), "1/3"),
        ("low", "low"),
    ],
)
def test_values_as_the_language_writes_them(value: Value, text: str) -> None:
    assert value_text(value) == text


def test_values_in_json_are_exact() -> None:
    tiny = Fraction(1, 10**30)
    values: dict[str, Value] = {
        "a": Fraction(366, 10),
        "b": Fraction(1, 3),
        "c": 10**30,
        "d": True,
        "e": "low",
        "f": tiny,
    }
    assert values_json(values) == {"a": 36.6, "b": "1/3", "c": 10**30, "d": True, "e": "low", "f": 1e-30}
    assert value_text(tiny) == f"0.{1:030}"


def test_situations_in_words() -> None:
    assert witness_text(Witness(("a",), {})) == "When `a` occurs (whatever else holds)"
    assert witness_text(Witness(("a", "b c"), {"d": False, "e": 2})) == (
        "When `a` and `b c` occur, `d` is false and `e` is 2 (whatever else holds)"
    )
    assert witness_text(Witness((), {"d": True})) == "When `d` is true (whatever else holds)"
    assert context_text(Context(frozenset(), {})) == "When nothing occurs (if nothing else holds)"


def test_lists() -> None:
    assert [listed("a"), listed("ab"), listed("abc")] == ["a", "a and b", "a, b and c"]


# What no ruleset of the documents leads to


RULES = parse("WHEN a THEN b\nWHEN c THEN d\n", "rules.sleec")


def outcome(*results: CheckResult) -> CheckedRuleset:
    return CheckedRuleset(RULES, results)


UNDECIDED = outcome(
    CheckResult("conflict", Unknown("the solver gave up"), 1.0), CheckResult("dead-rule", Proved(), 0.5)
)


@pytest.mark.parametrize("name", FORMATS)
def test_unknown_is_never_shown_as_fine(name: str) -> None:
    text = "".join(renderer(name)([UNDECIDED], PLAIN))
    assert "unknown" in text or "inconclusive" in text
    assert "the solver gave up" in text
    assert "passed" not in text


def test_unknown_exits_with_3_and_findings_with_1() -> None:
    finding = Finding("conflict", "SLEEC101", "error", "they clash", Span(0, 13))
    found = outcome(CheckResult("conflict", Unknown("gave up", (finding,)), 1.0))
    assert exits.code(UNDECIDED.results, "error") == 3
    assert exits.code((*UNDECIDED.results, *found.results), "error") == 1
    assert exits.code([CheckResult("conflict", Proved(), 1.0)], "note") == 0


def test_a_list_that_was_cut_says_so() -> None:
    finding = Finding("conflict", "SLEEC101", "error", "they clash", Span(0, 13))
    cut = outcome(CheckResult("conflict", Refuted((finding,)), 1.0, "the first 1000 are listed"))
    for name in FORMATS:
        assert "the first 1000 are listed" in "".join(renderer(name)([cut], PLAIN))
    (check,) = json.loads("".join(renderer("json")([cut], PLAIN)))["rulesets"][0]["checks"]
    assert (check["verdict"], check["reason"]) == ("refuted", "the first 1000 are listed")


def test_findings_are_in_the_order_of_the_text() -> None:
    def finding(start: int, severity: str, code: str) -> Finding:
        return Finding("x", code, severity, "m", Span(start, start + 1))  # type: ignore[arg-type]

    results = (
        CheckResult("one", Refuted((finding(9, "note", "SLEEC500"), finding(0, "warning", "SLEEC200"))), 0.0),
        CheckResult("two", Refuted((finding(0, "error", "SLEEC300"),)), 0.0),
    )
    assert [f.code for f in outcome(*results).findings] == ["SLEEC300", "SLEEC200", "SLEEC500"]


def test_palette_paints_only_where_it_may() -> None:
    assert PLAIN("error", "x") == "x"
    assert as_line(Palette(coloured=True)("error", "x")) == "\033[1;31mx\033[0m"
    assert Palette(coloured=True)("error", "") == ""
