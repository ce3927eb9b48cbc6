"""What the timeline of a conflict tells: what is due in place of what was not kept, and what relations make of it."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_runtime.trace import Instant, Trace, broken, broken_so_far
from sleec_verify.checks import run_checks
from sleec_verify.report.flow import steps
from sleec_verify.report.timeline import chart_of, in_words
from tests.timed_strategies import timed_ruleset


def conflict(text, rule):
    ruleset = parse(text)
    (result,) = run_checks(ruleset, ["conflict"])
    (finding,) = (finding for finding in result.findings if finding.rules[0] == rule)
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
        "at first, A, D and F occur",
        "  r calls for B within 2 minutes, otherwise C",
        "  s forbids C within 5 minutes",
        "  t forbids B within 10 minutes",
        "after 2 minutes, in place of B, r calls for C",
        "and then there is no way to keep every rule",
    ]
    assert heads.split() == ["0", "s", "now", "2", "min"]
    column = heads.index("2 min")
    assert rows["B"][column - 1 : column + 2] == "!!x"
    assert rows["C"][column - 1 : column + 2] == "x!x"


def test_what_falls_due_has_a_window_of_its_own():
    words, heads, rows = told(OTHERWISE.replace("{otherwise}", "C WITHIN 1 minute"), "r")
    assert "after 2 minutes, in place of B, r calls for C within 1 minute" in words
    assert rows["C"][heads.index("2 min") :].startswith("!!")


@pytest.mark.parametrize(("given", "due"), [("p", "E"), ("NOT p", "C")])
def test_the_hedges_of_what_falls_due_are_decided_by_the_moment(given, due):
    text = OTHERWISE.replace("{otherwise}", "(C UNLESS p IN WHICH CASE E)").replace("WHEN A", f"WHEN A AND {given}")
    words, _, rows = told(text.replace("NOT C", f"NOT {due}"), "r")
    assert f"after 2 minutes, in place of B, r calls for {due}" in words
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
    words, _, _ = told(text, "s")
    assert words[2].startswith("after 2 minutes, in place of B, r calls for C")
    assert words[3].startswith("after 4 minutes 50 seconds, F occurs")


def test_a_prohibition_that_something_is_due_in_place_of():
    text = """RULE r WHEN A THEN NOT B WITHIN 2 minutes OTHERWISE C
RULE s WHEN D THEN B WITHIN 1 minute
RULE t WHEN D THEN NOT C WITHIN 5 minutes
"""
    words, _, _ = told(text, "r")
    assert "after 2 minutes, in place of NOT B, r calls for C" in words


def test_the_steps_to_the_finding_tell_of_it_too():
    ruleset, finding = conflict(OTHERWISE.replace("{otherwise}", "C"), "r")
    assert "after 2 minutes, in place of B, r calls for C" in [step.words for step in steps(ruleset, finding)]


RELATED = {
    "RELATION A EXCLUDES B\nRULE r WHEN T THEN A AND B\n": ("forbids A and B together", "A!", "B!"),
    "RELATION A EXCLUDES B\nRULE q WHEN A THEN C WITHIN 5 minutes\nRULE r WHEN T THEN B\n": ("forbids B", "A*", "B!"),
    "EXCLUSIVE A, B, C\nRULE q WHEN B THEN D WITHIN 5 minutes\nRULE r WHEN T THEN A AND C\n": (
        "forbids A and C together",
        "A!",
        "C!",
    ),
    "NEVER A AND B\nRULE q WHEN B THEN D WITHIN 5 minutes\nRULE r WHEN T THEN A AND B\n": (
        "forbids A and B together",
        "A!",
        "B!",
    ),
    "RELATION A WITNESSES B\nRULE r WHEN T THEN A AND NOT B\n": ("calls for B", "A-", "B!"),
    "RELATION A EQUALS B\nRULE r WHEN T THEN A AND NOT B\n": ("calls for B", "A-", "B!"),
    "RELATION A PRECEDES B\nRULE r WHEN T THEN B\n": ("forbids B before A", "B!"),
    "RELATION A FORBIDS p\nRULE r WHEN T AND p THEN A\n": ("forbids A", "A!"),
    "RELATION A INCLUDES p\nRULE r WHEN T THEN A\n": ("forbids A", "A!"),
    "RELATION A CAUSES p\nRULE r WHEN T AND p THEN NOT A\n": ("calls for A", "A!"),
}


@pytest.mark.parametrize("text", RELATED)
def test_what_a_relation_forbids_or_calls_for_is_told_and_marked(text):
    says, *marks = RELATED[text]
    ruleset, finding = conflict(text, "r")
    kind = "constraint" if text.startswith(("EXCLUSIVE", "NEVER")) else "relation"
    assert f"  the {kind} in line 1 {says}" in list(in_words(finding.timeline))
    heads, *rows = chart_of(finding.timeline)
    column = heads.index("0 s")
    assert {row.split()[0] + row[column] for row in rows} >= set(marks)
    assert ruleset.source.place(finding.related[-1][0]).line == 1
    # What code and editors are shown leads there as well.
    there = [step.words for step in steps(ruleset, finding) if ruleset.source.place(step.span).line == 1]
    assert any(words.endswith(says) for words in there)


def test_what_must_not_occur_without_what_is_forbidden_is_told_for_as_long():
    text = """RELATION Give WITNESSES Wake
RELATION Wake WITNESSES Noise
RULE r WHEN Due THEN Give WITHIN 30 minutes
RULE s WHEN Sleeps THEN NOT Noise WITHIN 1 hour
"""
    words, heads, rows = told(text, "r")
    assert "  the relation in line 2 forbids Wake without Noise" in words
    assert "  the relation in line 1 forbids Give without Wake" in words
    assert rows["Give"][heads.index("0 s") :].startswith("!!!!")


def test_a_rule_that_meets_what_it_called_for_before():
    text = "RULE r WHEN A THEN B WITHIN 10 minutes UNLESS p IN WHICH CASE NOT B WITHIN 2 hours\n"
    _, finding = conflict(text, "r")
    assert finding.message == "r can be triggered where it cannot be kept together with what it called for before"
    assert finding.help == "decide which should give way, and say so with a hedge"


def test_a_relation_gives_way_to_nothing():
    _, finding = conflict("RELATION A EXCLUDES B\nRULE q WHEN A THEN C EVENTUALLY\nRULE r WHEN T THEN B\n", "r")
    assert finding.help == "give r a hedge for this case, or mend what it cannot be kept with"


@pytest.mark.parametrize("seed", range(150))
def test_what_is_told_of_a_law_is_so(seed):
    """The evaluator of traces, which knows nothing of timelines, finds the law broken where it is not heeded."""
    ruleset = timed_ruleset(seed, relations=4)
    (result,) = run_checks(ruleset, ["conflict"])
    for timeline in (finding.timeline for finding in result.findings):
        assert timeline is not None
        moments = timeline.moments
        for place, moment in enumerate(moments):
            before = [Instant(m.time, frozenset(m.events), m.conditions) for m in moments[:place]]
            called = [d for m in moments for d in m.due if not d.negated and d.start == d.end == moment.time]
            called = [d for d in called if d.law is None and (d.overdue or d.instead_of is None)]
            done = {*moment.events, *(d.event for d in called)}
            for due in (due for due in moment.due if due.law is not None):
                spread = " without " in due.words
                if spread:
                    events = frozenset({due.event})
                elif due.negated:
                    together = {d.event for d in moment.due if (d.law, d.words) == (due.law, due.words)}
                    events = frozenset({*moment.events, *together})
                else:
                    events = frozenset(done)
                    done.add(due.event)
                trace = Trace((*before, Instant(moment.time, events, moment.conditions)))
                # More may occur at the same time, but for what is called for.
                found = broken_so_far(ruleset, trace) if due.negated and not spread else broken(ruleset, trace)
                assert due.law in [one.statement.span for one in found]
