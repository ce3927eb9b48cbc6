"""What is due until when: `explain` and `entail` of rules with time."""

from __future__ import annotations

from dataclasses import replace

import pytest

from sleec_runtime.evaluation.trace import Instant, Trace
from sleec_runtime.evaluation.trace_violations import violations, violations_so_far
from sleec_runtime.language import parse
from sleec_runtime.model import Context
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.entailment.answer import ScheduledResponse
from sleec_verify.entailment.consequence_tree import chain
from sleec_verify.entailment.entailment import entail
from sleec_verify.entailment.schedule import schedule
from sleec_verify.entailment.situation_text import parse_situation
from sleec_verify.report.entailment import caveats
from sleec_verify.report.palette import PLAIN
from sleec_verify.report.schedule import chart, in_words

SMOKE = """RULE smoke
WHEN SmokeDetected
THEN CallHelp WITHIN 5 minutes OTHERWISE (SoundAlarm WITHIN 2 minutes UNLESS Night IN WHICH CASE Ring)
UNLESS Cooking IN WHICH CASE AskUser
RULE ask
WHEN AskUser THEN NOT CallHelp WITHIN 1 minutes
RULE called
WHEN CallHelp THEN OpenDoor WITHIN 10 TO 30 seconds AND Report EVENTUALLY
"""


def _entries(text: str, trigger: str, untimed: Untimed = "at", **conditions: object) -> tuple[ScheduledResponse, ...]:
    ruleset = parse(text)
    context = Context(frozenset({trigger}), conditions)  # type: ignore[arg-type]
    answer = entail(ruleset, context)
    return schedule(ruleset, context, replace(answer, chain=chain(ruleset, context, answer).steps), untimed)


def _times(entries: tuple[ScheduledResponse, ...]) -> list[tuple[str, int | None, int | None, str | None]]:
    return [(entry.event, entry.start, entry.end, entry.after) for entry in entries]


@pytest.mark.parametrize("amount", [10**16 + 1, 10**99 + 1, 10**400 + 1])
def test_lengths_are_exact(amount: int) -> None:
    text = "MEASURE wait: integer\nWHEN A THEN B WITHIN wait seconds\n"
    assert _times(_entries(text, "A", wait=amount)) == [("B", 0, amount, None)]


def test_windows_are_clock_times_and_chains_count_from_what_is_done() -> None:
    assert _times(_entries(SMOKE, "SmokeDetected")) == [
        ("CallHelp", 0, 300, None),
        ("SoundAlarm", 300, 420, None),
        ("OpenDoor", 10, 30, "CallHelp"),
        ("Report", 0, None, "CallHelp"),
    ]


def test_the_hedges_of_what_is_due_instead_are_decided_by_the_situation() -> None:
    entries = _entries(SMOKE, "SmokeDetected", Night=True)
    assert ("Ring", 300, 300, None) in _times(entries)
    (ring,) = (entry for entry in entries if entry.event == "Ring")
    assert (ring.instead_of, ring.overdue) == ("CallHelp", True)


def test_words() -> None:
    assert [" ".join(line.split()) for line in in_words(_entries(SMOKE, "SmokeDetected"))] == [
        "CallHelp within 5 minutes by smoke",
        "or SoundAlarm from 5 minutes to 7 minutes by smoke, if `CallHelp` was not done in time",
        "after `CallHelp` (times count from then):",
        "OpenDoor from 10 seconds to 30 seconds by called",
        "Report eventually by called",
    ]


def test_prohibitions_alternatives_and_what_has_no_end() -> None:
    text = (
        "WHEN A THEN NOT B EVENTUALLY AND C WITHIN 1 hour ELSE D\nWHEN A THEN NOT E WITHIN 2 days AND F\n"
        "WHEN A AND Late THEN G WITHIN 1 minutes OTHERWISE NOT H EVENTUALLY\n"
    )
    words = [" ".join(line.split()) for line in in_words(_entries(text, "A", Late=True))]
    assert words == [
        "not B always by rule_1",
        "C within 1 hour by rule_1",
        "or D immediately by rule_1, instead of `C`",
        "not E for 2 days by rule_2",
        "F immediately by rule_2",
        "G within 1 minute by rule_3",
        "or not H always from 1 minute on by rule_3, if `G` was not done in time",
    ]


def test_a_response_without_a_window_may_have_time() -> None:
    text = "WHEN A THEN B\nWHEN A THEN C WITHIN 1 minutes OTHERWISE D\n"
    words = [" ".join(line.split()) for line in in_words(_entries(text, "A", "eventually"))]
    assert words[0] == "B eventually by rule_1"
    assert words[-1] == "or D eventually from 1 minute on by rule_2, if `C` was not done in time"


def test_a_length_that_a_measure_says_is_taken_from_the_situation() -> None:
    text = "MEASURE delay: integer\nWHEN A THEN B WITHIN delay minutes OTHERWISE C\n"
    assert _times(_entries(text, "A", delay=2)) == [("B", 0, 120, None), ("C", 120, 120, None)]
    entries = _entries(text, "A")
    assert _times(entries) == [("B", None, None, None), ("C", None, None, None)]
    assert "whose value is not given" in next(iter(in_words(entries)))


def test_a_length_without_a_value_shows_its_range() -> None:
    text = "MEASURE delay: integer\nASSUME delay >= 1 AND delay <= 30\nWHEN A THEN B WITHIN delay minutes OTHERWISE C\n"
    first, second = _entries(text, "A")
    assert (first.lengths, second.lengths) == ((60, 1800), None)
    (line, _) = in_words([first, second])
    assert "within delay minutes, whose value is not given (1 minute to 30 minutes)" in line


def test_a_window_of_negative_length_has_no_place_in_the_chart() -> None:
    entries = _entries("MEASURE delay: integer\nWHEN A THEN B WITHIN delay minutes\n", "A", delay=-1)
    (line,) = in_words(entries)
    assert line == "B  within -1 minute  by rule_1"
    assert chart(entries, Context(frozenset({"A"}), {})) == []


def test_the_chart_has_a_column_for_each_time() -> None:
    entries = _entries(SMOKE, "SmokeDetected")
    lines = chart(entries, Context(frozenset({"SmokeDetected"}), {}))
    assert lines[0].split() == ["0", "s", "now", "5", "min", "7", "min"]
    assert any(line.startswith("CallHelp") and "-----" in line for line in lines)


def test_rules_without_time_have_no_schedule() -> None:
    assert _entries("WHEN A THEN B\n", "A") == ()
    assert chart((), Context(frozenset(), {})) == []


def test_rules_at_odds_have_none() -> None:
    assert _entries("WHEN A THEN B AND C WITHIN 1 minutes\nWHEN A THEN NOT B\n", "A") == ()


@pytest.mark.parametrize("late", [False, True])
def test_to_do_all_as_scheduled_keeps_the_rules(late: bool) -> None:
    """The evaluator of traces, which knows nothing of schedules, agrees with their times: done at the last moment all
    is kept, done a second later it is not."""
    text = "WHEN A THEN B WITHIN 2 minutes\nWHEN B THEN C WITHIN 10 TO 30 seconds\n"
    b, c = _entries(text, "A")
    assert b.end is not None
    assert c.end is not None
    times = {"A": 0, "B": b.end, "C": b.end + c.end + late}
    trace = Trace(tuple(Instant(time, frozenset({event})) for event, time in times.items()))
    assert bool(violations(parse(text), trace)) == late


RELATED = """MEASURE n: integer
RELATION A EXCLUDES B
RELATION A INCLUDES p
RELATION B FORBIDS q AND n > 3
RELATION ALWAYS p IMPLIES r
RELATION ALWAYS p EQUALS r
RELATION ALWAYS p EXCLUDES s
RELATION ALWAYS n < 9
RELATION C CAUSES s
RELATION A WITNESSES C
RELATION D EQUALS C
RELATION D PRECEDES A
RELATION WHEN A THEN p FOR 5 minutes
ASSUME NOT (A AND t)
WHEN A THEN C
WHEN B THEN D UNLESS t
"""


@pytest.mark.parametrize("when", ["", "A", "B", "A,B", "A,D", "C,D"])
@pytest.mark.parametrize("given", ["", "p,r", "p", "q", "q,n=4", "q,n=3,s", "p,r,s,t", "p,r,n=9"])
def test_a_situation_that_relations_rule_out_is_told(when: str, given: str) -> None:
    """What the evaluator of traces finds broken, whatever else occurs at this instant; where a measure is not given, a
    relation that asks for it says nothing."""
    ruleset = parse(RELATED)
    context = parse_situation(ruleset, when, given)
    lasting = (" PRECEDES ",)
    told = {ruleset.source.place(law.span).line for law in entail(ruleset, context).broken_assumptions}
    instant = Instant(0, context.triggers, {"n": 0, **context.conditions})
    found = {ruleset.source.place(b.statement.span).line for b in violations_so_far(ruleset, Trace((instant,)))}
    lines = RELATED.splitlines()
    assert told == {
        line
        for line in found
        if lines[line - 1].startswith(("RELATION", "ASSUME")) and not any(w in lines[line - 1] for w in lasting)
    }


def test_the_warning_names_assumptions_and_relations() -> None:
    ruleset = parse(RELATED)
    answer = entail(ruleset, parse_situation(ruleset, "A,B", "p,r,t"))
    (line, *_) = caveats(ruleset, answer, PLAIN)
    assert "by ASSUME (line 14) and RELATION (line 2);" in line
