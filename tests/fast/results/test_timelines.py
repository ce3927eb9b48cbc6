"""What the timeline of a conflict tells: what is due in place of what was not kept, and what relations make of it."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.report.flow import steps
from sleec_verify.report.timeline import chart_of, in_words


def conflict(text, rule):
    ruleset = parse(text)
    (result,) = run_checks(ruleset, ["conflict"])
    (finding,) = (finding for finding in result.findings if rule in finding.rules)
    return ruleset, finding


def told(text, rule):
    """The words of its timeline, with the first moment left out, and the rows of its chart, with what of them is not
    blank in columns."""
    _, finding = conflict(text, rule)
    heads, *rows = chart_of(finding.timeline)
    return list(in_words(finding.timeline)), heads, {row.split()[0]: row for row in rows}


OTHERWISE = """RULE r WHEN A THEN B WITHIN 2 minutes OTHERWISE {otherwise}
RULE s WHEN D THEN NOT C WITHIN 5 minutes
RULE t WHEN F THEN NOT B WITHIN 10 minutes
"""


def test_what_falls_due_in_place_of_what_was_not_done_is_told_with_its_time():
    words, heads, rows = told(OTHERWISE.replace("{otherwise}", "C"), "r")
    assert words == [
        "at first, `A`, `D` and `F` occur",
        "  rule `r` requires `B within 2 minutes, otherwise C`",
        "  rule `s` forbids `C within 5 minutes`",
        "  rule `t` forbids `B within 10 minutes`",
        "after 2 minutes, instead of `B`, rule `r` requires `C`",
        "from the first moment on, it is impossible to follow every rule",
    ]
    assert heads.split() == ["0", "s", "now", "2", "min"]
    column = heads.index("2 min")
    assert rows["B"][column - 1 : column + 2] == "!!x"
    assert rows["C"][column - 1 : column + 2] == "x!x"


def test_what_falls_due_has_a_window_of_its_own():
    words, heads, rows = told(OTHERWISE.replace("{otherwise}", "C WITHIN 1 minute"), "r")
    assert "after 2 minutes, instead of `B`, rule `r` requires `C within 1 minute`" in words
    # Once the two minutes are over, s suffices: no rule needs to forbid B.
    assert rows["C"][heads.index("2 min 1 s now") :].startswith("!!")


@pytest.mark.parametrize(("given", "due"), [("p", "E"), ("NOT p", "C")])
def test_the_hedges_of_what_falls_due_are_decided_by_the_moment(given, due):
    text = OTHERWISE.replace("{otherwise}", "(C UNLESS p IN WHICH CASE E)").replace("WHEN A", f"WHEN A AND {given}")
    words, _, rows = told(text.replace("NOT C", f"NOT {due}"), "r")
    assert f"after 2 minutes, instead of `B`, rule `r` requires `{due}`" in words
    assert {"C", "E"} & rows.keys() == {due}


def test_what_was_done_in_time_leaves_nothing_due_in_its_place():
    text = "RULE r WHEN A THEN B WITHIN 2 minutes OTHERWISE C\nCONCERN late EXISTS A WHILE B WITHIN 1 minute\n"
    (result,) = run_checks(parse(text), ["concern"])
    (finding,) = result.findings
    assert finding.timeline is not None
    assert all("C" not in line.split() for line in chart_of(finding.timeline))


def test_what_fell_due_before_now_is_told_where_it_did():
    text = """RULE r WHEN A THEN B WITHIN 2 minutes OTHERWISE C WITHIN 3 minutes
RULE s WHEN F THEN NOT C WITHIN 10 seconds
RULE t WHEN C THEN NOT F
"""
    words, _, _ = told(text, "r")
    assert words[2].startswith("after 2 minutes, instead of `B`, rule `r` requires `C within")
    assert words[3].startswith("after 4 minutes 50 seconds, `F` occurs")


def test_a_prohibition_that_something_is_due_in_place_of():
    text = """RULE r WHEN A THEN NOT B WITHIN 2 minutes OTHERWISE C
RULE s WHEN D THEN B WITHIN 1 minute
RULE t WHEN D THEN NOT C WITHIN 5 minutes
"""
    words, _, _ = told(text, "r")
    assert "after 2 minutes, instead of `NOT B`, rule `r` requires `C`" in words


def test_the_steps_to_the_finding_tell_of_it_too():
    ruleset, finding = conflict(OTHERWISE.replace("{otherwise}", "C"), "r")
    assert "after 2 minutes, instead of `B`, rule `r` requires `C`" in [step.words for step in steps(ruleset, finding)]


RELATED = {
    "RELATION A EXCLUDES B\nRULE r WHEN T THEN A AND B\n": "`A` and `B` are required, but the relation in line 1",
    "EXCLUSIVE A, B, C\nRULE r WHEN T THEN A AND C WITHIN 0 seconds\n": "`A` and `C` are required, but the EXCLUSIVE",
    "NEVER A AND B\nRULE r WHEN T THEN A AND B WITHIN 0 seconds\n": "`A` and `B` are required, but the NEVER in line 1",
    "RELATION A WITNESSES B\nRULE r WHEN T THEN A AND NOT B\n": "`A` is required and `B` is forbidden, but the",
    "RELATION A EQUALS B\nRULE r WHEN T THEN A AND NOT B\n": "`A` is required and `B` is forbidden, but the relation",
    "RELATION A PRECEDES B\nRULE r WHEN T THEN B\n": "`B` is required, but the relation in line 1 excludes this",
    "RELATION A FORBIDS p\nRULE r WHEN T AND p THEN A\n": "`A` is required, but the relation in line 1 excludes this",
    "RELATION A INCLUDES p\nRULE r WHEN T AND NOT p THEN A\n": "`A` is required, but the relation in line 1",
    "RELATION A CAUSES p\nRULE r WHEN T AND p THEN NOT A\n": "`A` is forbidden, but the relation in line 1",
}


@pytest.mark.parametrize("text", RELATED)
def test_a_relation_that_rules_out_what_is_due_is_named(text):
    ruleset, finding = conflict(text, "r")
    assert finding.message.split(": ")[1].startswith(RELATED[text])
    assert ruleset.source.place(finding.related[-1][0]).line == 1


def test_a_rule_that_meets_what_it_required_before():
    text = "RULE r WHEN A THEN B WITHIN 10 minutes UNLESS p IN WHICH CASE NOT B WITHIN 2 hours\n"
    _, finding = conflict(text, "r")
    assert (
        finding.message
        == "rule `r` and the exception `UNLESS p` of rule `r` contradict each other: `B` is both required and forbidden"
    )
    assert finding.rules == ("r",)
    assert [clause.clause for clause in finding.clauses] == [0, 1]
