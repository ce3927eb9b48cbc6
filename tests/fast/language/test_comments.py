"""Spans and comments of structured English."""

from __future__ import annotations

from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import (
    Truth,
    leaves,
)


def test_spans() -> None:
    text = (
        "RULE here\r\nWHEN the bell AND x < 3 THEN (Answer UNLESS a IN WHICH CASE NOT Wait).\r\n"
        "UNLESS NOT (a AND b) IN WHICH CASE (Go AND\r\nCall)."
    )
    ruleset = parse("\ufeff" + text)
    (rule,) = ruleset.rules

    def shown(value: object) -> str:
        start, end = value.span  # type: ignore[attr-defined]
        return text[start:end]

    assert shown(rule) == text[:-1]
    assert text[slice(*rule.label_span)] == "here"
    assert text[slice(*rule.trigger_span)] == "the bell"
    assert shown(rule.guard) == "x < 3"
    assert shown(rule.default).startswith("WHEN the bell")
    assert shown(rule.default).endswith("Wait)")
    assert shown(rule.default.obligations[0]) == "Answer"
    assert shown(rule.default.hedges[0]) == "UNLESS a IN WHICH CASE NOT Wait"
    assert shown(rule.default.hedges[0].obligations[0]) == "NOT Wait"
    assert shown(rule.hedges[0]) == "UNLESS NOT (a AND b) IN WHICH CASE (Go AND\r\nCall)"
    assert shown(rule.hedges[0].condition) == "NOT (a AND b)"
    assert [shown(leaf) for leaf in leaves(rule.hedges[0].condition or Truth(True))] == ["a", "b"]
    assert ruleset.source.place(rule.hedges[0].span) == (3, 1, 4, 6)


def test_lines_of_old_editors_are_counted() -> None:
    ruleset = parse("// one\rWHEN A THEN B\rWHEN A THEN C")
    assert [ruleset.source.place(rule.span).line for rule in ruleset.rules] == [2, 3]


COMMENTED = """\
// Rules of the house
# second line

// about times

READING cascade // as the paper
DOMAIN house
// the curtain rule

// again
RULE curtains # label
// default
WHEN CurtainOpenRequest THEN OpenCurtains // go
// hedge
UNLESS UserUndressed // behind the condition
  // in the middle
  AND Awake IN WHICH CASE (RefuseRequest // one more
    // nested
    UNLESS Fire) // end
// last

# very last
"""


def test_comments_are_kept() -> None:
    ruleset = parse(COMMENTED)
    assert print_ruleset(ruleset) == (
        "// Rules of the house\n// second line\n\n// about times\n\n// as the paper\n\n// the curtain rule\n\n"
        "READING cascade\nDOMAIN house\n\n// again\nRULE curtains  // label\n// default\n"
        "WHEN CurtainOpenRequest THEN OpenCurtains  // go\n// hedge\n// in the middle\n// one more\n"
        "UNLESS UserUndressed AND Awake IN WHICH CASE (RefuseRequest  // behind the condition\n"
        "    // nested\n    UNLESS Fire)  // end\n\n// last\n\n// very last\n"
    )
    assert print_ruleset(parse(print_ruleset(ruleset))) == print_ruleset(ruleset)


def test_comments_of_programs_stay_on_one_line() -> None:
    from dataclasses import replace

    from sleec_runtime.model import Comments

    ruleset = parse("WHEN A THEN B")
    (rule,) = ruleset.rules
    rule = replace(rule, comments=Comments(("one\ntwo",), "three\nWHEN"))
    assert print_ruleset(replace(ruleset, statements=(rule,))) == "// one two\nWHEN A THEN B  // three WHEN\n"
