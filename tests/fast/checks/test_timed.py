"""Rulesets with times: what needs them stays undecided and says so, all else is answered."""

from __future__ import annotations

import pytest

from sleec_runtime.facade.sleec import Sleec
from sleec_runtime.language import parse
from sleec_runtime.model import Context
from sleec_verify.checks import CHECKS, run_checks
from sleec_verify.entailment.entailment import entail
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Proved, Refuted, Unknown
from sleec_verify.traces.components import components
from sleec_verify.traces.index import trace_index_of

TEXT = """def_start
  event A
  event B
  event C
  event Unused
  measure m: boolean
  measure n: boolean
  measure x: numeric
  constant K = 5
  constant J = 6
def_end
rule_start
  R1 when A then {response}
  R2 when A then not B
  R3 when A then C unless (m and (not m)) then B
  R4 when A and (x > 3 and x < 3) then B
rule_end
"""


def verdicts(text):
    return {result.name: result for result in run_checks(parse(text))}


def text(response, beside=""):
    return TEXT.replace("{response}", response) + beside


def unknown(found):
    return [name for name, result in found.items() if isinstance(result.verdict, Unknown)]


@pytest.mark.parametrize(
    "response",
    [
        "B unless n",
        "B within 5 minutes",
        "B eventually",
        "B otherwise C",
        "B else {C unless n}",
        "C unless n then B within K days",
    ],
)
def test_all_is_decided(response):
    found = verdicts(text(response))
    # What is done happens there, so a name that is both is nothing to note.
    assert "trigger-obligation" not in found
    # And some are for windows, or for SLEEC-TK's dialect, only.
    not_asked = {"trigger-obligation", "bare-prohibition", "stray-event", "zero-window", "realizability", "confusable"}
    assert set(CHECKS) - set(found) <= not_asked
    assert unknown(found) == []
    assert [f.rules for f in found["dead-rule"].findings] == [("R4",)]
    assert [f.rules for f in found["dead-hedge"].findings] == [("R3",)]


def test_a_window_leaves_room_that_now_does_not():
    (finding,) = verdicts(text("B"))["conflict"].findings
    assert (finding.rules, finding.timeline) == (("R1", "R2"), None)
    # R2 forbids B at its own instant only, which is the last one that is left to R1 five minutes after its trigger.
    (finding,) = verdicts(text("B within 5 minutes"))["conflict"].findings
    assert finding.rules == ("R1", "R2")
    assert [moment.time for moment in finding.timeline.moments] == [0, 300]


def test_what_no_rule_requires_is_no_conflict():
    asked = "def_start event A event B event C def_end rule_start R1 when A then B R2 when {} then not C {} rule_end"
    assert verdicts(asked.format("B", ""))["conflict"].verdict == Proved()
    (finding,) = verdicts(asked.format("A", "R3 when A then C"))["conflict"].findings
    assert finding.rules == ("R2", "R3")


def test_a_window_that_a_measure_says_is_a_matter_of_the_rules_around_it_only():
    rules = ("R1 when A then B within {x} seconds", "R2 when C then D", "R3 when C and {m} then not D")
    names = "".join(f" event {e}" for e in "ABCD")
    for more, concerned in (("", "`R1`"), (" R4 when D then not B", "`R1`, `R2`, `R3` and `R4`")):
        found = verdicts(
            f"def_start{names} measure x: numeric measure m: boolean def_end "
            f"rule_start {' '.join(rules)}{more} rule_end"
        )
        assert {f.rules for f in found["conflict"].findings} == (set() if more else {("R2", "R3")})
        if more:
            assert found["conflict"].verdict.why.startswith(f"{concerned}: nothing bounds `x`")
        assert found["vacuous-conflict"].verdict.why.startswith("`R1`: ")


def test_a_window_without_a_bound_is_not_analysed():
    found = verdicts(text("B within x seconds"))
    assert set(unknown(found)) == {"conflict", "vacuous-conflict", "redundant-rule", "redundant-hedge"}
    assert "nothing bounds `x`" in found["conflict"].verdict.why


def test_the_readings_part_where_only_times_differ():
    found = verdicts(text("B within 1 hours unless m then B within 2 hours unless n then B within 3 hours"))
    (finding,) = found["reading"].findings
    assert finding.rules == ("R1",)
    assert finding.note == (
        "if nothing else holds: with READING priority, the exception `UNLESS n` applies: `B within 3 hours`; "
        "with READING cascade, no exception applies: `B within 1 hour`"
    )


def test_what_is_forbidden_is_said_as_the_language_says_it():
    found = verdicts(text("B unless m then B within 2 hours unless n then not B within 3 hours"))
    (finding,) = found["reading"].findings
    assert "the exception `UNLESS n` applies: `not B within 3 hours`" in finding.note


def test_a_hedge_without_a_response_has_none_to_be_checked():
    def said(response):
        findings = verdicts(text(response))["redundant-hedge"].findings
        return [finding.help for finding in findings if finding.clauses[0] == ("R1", 1)]

    with_one = "check whether its response is the one that you meant, or remove it and check again"
    without = "it has no response: add the response that you meant, or remove it and check again"
    assert said("B within 1 hours unless m then B within 1 hours") == [with_one]
    assert said("B within 1 hours unless m\n  R9 when A then B within 1 hours") == [without]


def test_relations_rule_out():
    found = verdicts(text("B unless n", "relation_start measure invariant (not {n}) relation_end"))
    assert unknown(found) == []
    assert [f.clauses for f in found["dead-hedge"].findings] == [(("R1", 1),), (("R3", 1),)]


def test_concerns_and_purposes_disturb_nothing():
    beside = "concern_start c1 when A then not B within 2 minutes concern_end purpose_start p1 exists A purpose_end"
    found = verdicts(text("B", beside))
    assert isinstance(found["concern"].verdict, Proved), "nothing keeps both R1 and R2, so there is no trace with A"
    assert [f.obligations for f in found["purpose"].findings] == [("p1",)]
    assert isinstance(found["conflict"].verdict, Refuted)
    (result,) = run_checks(parse(text("B", beside)), ["purpose"])
    assert result.name == "purpose"


def test_names_are_used_wherever_they_stand():
    def unused(found):
        return {finding.message.split(" is ")[0] for finding in found["unused-name"].findings}

    assert unused(verdicts(text("B"))) == {
        "the event `Unused`",
        "the condition `n`",
        "the constant `K`",
        "the constant `J`",
    }
    assert unused(verdicts(text("B within K days otherwise {C unless n}"))) == {
        "the event `Unused`",
        "the constant `J`",
    }
    beside = "relation_start causation Unused {n} when A then {n} for J days relation_end"
    assert unused(verdicts(text("B", beside))) == {"the constant `K`"}
    beside = "concern_start c1 when Unused and {n} then B within J days concern_end"
    assert unused(verdicts(text("B", beside))) == {"the constant `K`"}


def test_defects_are_errors():
    ruleset = parse(
        text("B")
        .replace("R2 when", "R1 when")
        .replace("numeric", "scale(low, high)\nmeasure y: scale(a, b)")
        .replace("x > 3", "x = b")
        .replace("x < 3", "x = low")
    )
    (result,) = run_checks(ruleset, ["defect"])
    assert [finding.code for finding in result.findings] == ["SLEEC506", "SLEEC507"]
    assert isinstance(run_checks(parse(text("B")), ["defect"])[0].verdict, Proved)


def test_what_is_due_is_said_with_its_time():
    ruleset = parse(text("B within 5 minutes otherwise not C"))
    answer = entail(ruleset, Context(frozenset({"A"})))
    assert answer.consistent, "forbidden now and due within five minutes may both be kept"
    assert answer.obligations == ("C",), "the robot may do B later, or leave it out"
    assert answer.prohibitions == ("B",)
    assert answer.timed == ()
    assert [one.words for one in answer.alternatives] == ["B within 5 minutes, or else NOT C"]
    assert answer.because[0].in_words() == ("B within 5 minutes, or else NOT C",)


def test_the_runtime_takes_rules_of_the_dsl_without_times():
    sleec = Sleec(parse(text("B unless m").replace("R2 when A then not B", "R2 when A then C")))
    sleec.implement({"B": lambda: None, "C": lambda: None})
    assert sleec.trigger("A").obligations == ("B", "C")
    sleec.update({"m": True})
    assert sleec.trigger("A").obligations == ("C",)


TIMED = "WHEN X THEN Y WITHIN 5 minutes\n"


@pytest.mark.parametrize(
    "response",
    [
        "B AND NOT B",
        "B WITHIN 5 minutes AND NOT B WITHIN 10 minutes",
        "B EVENTUALLY AND NOT B EVENTUALLY",
        "B AND (NOT B ELSE (C AND NOT C))",
        "(NOT A ELSE (C AND NOT C))",
        "(NOT A WITHIN 1 second OTHERWISE (C WITHIN 2 seconds AND NOT C WITHIN 3 seconds))",
    ],
)
def test_a_response_that_contradicts_itself_is_a_conflict(response):
    """As it is without times, and as it is when each of its obligations is a rule of its own."""
    found = verdicts(f"{TIMED}RULE r WHEN A THEN B UNLESS m IN WHICH CASE ({response})")
    assert found["vacuous-conflict"].verdict == Proved()
    (finding,) = found["conflict"].findings
    assert (finding.rules, finding.help) == (("r",), "correct the response, or exclude the situation with ASSUME")
    always = verdicts(f"{TIMED}RULE r WHEN A THEN ({response})")
    (finding,) = always["conflict"].findings
    (vacuous,) = always["vacuous-conflict"].findings
    assert (finding.rules, vacuous.rules, vacuous.note) == (
        ("r",),
        ("r",),
        None if response == "B AND NOT B" else "it contradicts itself",
    )


def test_what_comes_to_no_end_is_told_from_what_contradicts_itself():
    (vacuous,) = verdicts(f"{TIMED}WHEN A THEN A WITHIN 1 TO 5 minutes")["vacuous-conflict"].findings
    assert vacuous.note == "its consequences never end"
    (vacuous,) = verdicts(f"{TIMED}WHEN A THEN NOT A WITHIN 5 minutes")["vacuous-conflict"].findings
    assert vacuous.note == "it contradicts itself"


@pytest.mark.parametrize("rules", [7, 14])
@pytest.mark.parametrize("window", ["3 minutes", "{} minutes", "1 TO {} minutes"])
def test_many_rules_that_call_for_one_event_are_decided(rules, window):
    """One occurrence does for all of them, so that there are instants enough; no event comes back to its trigger."""
    found = verdicts("".join(f"WHEN A THEN B WITHIN {window.format(n)}\n" for n in range(1, rules + 1)))
    assert found["conflict"].verdict == Proved()
    assert found["vacuous-conflict"].verdict == Proved()
    assert found["redundant-rule"].verdict != Proved()


ROLES = """def_start
  event A
  event B
  event C as environment
  measure m: boolean
def_end
rule_start
  {}
rule_end
"""


@pytest.mark.parametrize(
    "rules",
    [
        "R1 when A then B within 5 seconds unless C then not C within 3 seconds",
        "R1 when A then {not B else C unless C then not C}",
        "R1 when A then B unless C then not C R2 when B then C",
    ],
)
def test_an_input_that_a_condition_names_and_a_response_forbids_is_an_input(rules):
    """The declaration says who causes an event, in every part of the ruleset."""
    ruleset = parse(ROLES.format(rules))
    (result,) = run_checks(ruleset, ["conflict"])
    assert isinstance(result.verdict, Refuted)
    assert any("`C` occurs but is forbidden" in finding.message for finding in result.findings)
    traces = trace_index_of(RulesetIndex(ruleset))
    for part in components(traces.part(traces.rules, traces.relations)):
        assert part.mere_inputs == part.stated.mere_inputs == traces.mere_inputs == {"A", "C"}


@pytest.mark.parametrize("scale", [1, 2, 60])
def test_the_unit_of_time_does_not_decide_whether_a_concern_is_decided(scale: int) -> None:
    one, five, ten, thirty = (f"{number * scale} seconds" for number in (1, 5, 10, 30))
    text = f"""def_start event A event C event D def_end
rule_start
R1 when C then A within [{one}, {ten}] otherwise D within {five}
R2 when A then D within {one}
rule_end
concern_start
C1 when C then not D within [{one}, {thirty}]
concern_end
"""
    (result,) = run_checks(parse(text), ["concern"])
    assert isinstance(result.verdict, Proved)
