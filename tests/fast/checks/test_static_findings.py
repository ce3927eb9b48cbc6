"""What can be said of a text without asking what follows from it: each finding where it should be, and no other."""

from __future__ import annotations

import pytest
from hypothesis import given, settings

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse
from sleec_runtime.model import And, Comparison, Not, Or, Ruleset, ScaleValue, formulas_of
from sleec_verify.checks import checks_for, run_checks
from sleec_verify.checks.constant_conditions import CONSTANT_CONDITION
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Unknown
from tests.support import brute_force as brute
from tests.support.small_rulesets import small_rulesets

DEFINED = """def_start
  event Called
  event Answer
  event Wait
  event Ring
  event B
  measure asleep: boolean
  measure heat: numeric
  measure risk: scale(low, moderate, severe)
  measure pain: scale(none, some)
  constant LIMIT = 20
  constant NONE = 0
  constant BUFFER = 30
def_end
"""


def dsl(rules: str, beside: str = "") -> str:
    return f"{DEFINED}rule_start\n{rules}\nrule_end\n{beside}\n"


def said(text: str | Ruleset, *names: str) -> list[tuple[str, str]]:
    """The code and the place of what these checks find, the place as the text that it points at."""
    ruleset = parse(text) if isinstance(text, str) else text
    results = run_checks(ruleset, names)
    assert not any(isinstance(result.verdict, Unknown) for result in results)
    findings = sorted((f for result in results for f in result.findings), key=lambda f: f.span)
    return [(f.code, ruleset.source.text[f.span.start : f.span.end]) for f in findings]


# What others read over ------------------------------------------------------------------------------------

QUIRKS = [
    ("R1 when Called and ({risk} > LIMIT) then Answer", "", [("SLEEC508", "LIMIT")]),
    ("R1 when Called and ({risk} >= 1) then Answer", "", [("SLEEC508", "1")]),
    ("R1 when Called then Answer unless (2 = {risk}) then Wait", "", [("SLEEC508", "2")]),
    ("R1 when Called and ({pain} = low) then Answer", "", [("SLEEC507", "low")]),
    ("R1 when Called and ({pain} <= severe) then Answer", "", [("SLEEC507", "severe")]),
    ("R1 when Called then Answer within BUFFER seconds", "", []),
    ("R1 when Called then Answer R1 when Called then Wait", "", [("SLEEC506", "R1")]),
    (
        "R1 when Called then Answer",
        "def_start event Called constant LIMIT = 20 def_end",
        [("SLEEC519", name) for name in ("Called", "LIMIT")],
    ),
    (
        "R1 when Called then Answer",
        "purpose_start P6 exists Called and (risk >= moderate) P6 exists Answer purpose_end",
        [("SLEEC506", "P6")],
    ),
    ("R1 when Called then Answer", "concern_start c1 exists Wait and (asleep or heat > 3) concern_end", []),
]


@pytest.mark.parametrize(("rules", "beside", "expected"), QUIRKS)
def test_quirks_of_published_studies_are_read_with_a_finding(rules, beside, expected):
    ruleset = parse(dsl(rules, beside))
    assert said(ruleset, "defect") == expected
    assert not any(isinstance(result.verdict, Unknown) for result in run_checks(ruleset))


def test_a_constant_that_a_scale_is_compared_with_is_used():
    unused = said(dsl("R1 when Called and ({risk} > LIMIT) then Answer"), "unused-name")
    assert ("SLEEC501", "constant LIMIT = 20") not in unused
    assert ("SLEEC501", "constant NONE = 0") in unused


def test_a_comparison_with_what_lies_past_the_scale_never_holds():
    results = {r.name: r for r in run_checks(parse(dsl("R1 when Called and ({risk} > LIMIT) then Answer")))}
    assert [f.rules for f in results["dead-rule"].findings] == [("R1",)]


# Duplicates -----------------------------------------------------------------------------------------------


def test_a_rule_that_says_the_same_names_the_first_one():
    text = "RULE a\nWHEN t THEN o UNLESS c\nRULE b\nWHEN t THEN o UNLESS c\n"
    text += "RULE c\nWHEN t THEN o UNLESS d\nWHEN t THEN o UNLESS c"
    (result,) = run_checks(parse(text), ["duplicate-rule"])
    assert [f.rules for f in result.findings] == [("b", "a"), ("rule_4", "a")]
    assert said(text, "duplicate-rule") == [("SLEEC509", "b"), ("SLEEC509", "WHEN t THEN o UNLESS c")]


def test_rules_of_different_domains_are_no_duplicates():
    text = "DOMAIN home\nRULE a\nWHEN t THEN o\nDOMAIN ward\nRULE b\nWHEN t THEN o\n"
    text += "DOMAIN home, ward\nRULE c\nWHEN t THEN o"
    (result,) = run_checks(parse(text), ["duplicate-rule"])
    assert [f.rules for f in result.findings] == [("c", "a")]


def test_another_time_is_another_rule():
    assert said(dsl("R1 when Called then Answer R2 when Called then Answer within 1 minute"), "duplicate-rule") == []


# Events that no rule knows --------------------------------------------------------------------------------

RULE = "R1 when Called then Answer"


@pytest.mark.parametrize(
    ("rules", "beside", "expected"),
    [
        (RULE, "concern_start c1 exists Wait concern_end", [("SLEEC510", "Wait")]),
        (
            RULE,
            "concern_start c1 when Called then not Wait within 1 minute concern_end",
            [("SLEEC510", "not Wait within 1 minute")],
        ),
        (
            RULE,
            "purpose_start p1 exists Called while Answer unless asleep then Wait purpose_end",
            [("SLEEC510", "Wait")],
        ),
        (RULE, "purpose_start p1 exists Wait while Wait purpose_end", [("SLEEC510", "Wait")]),
        (
            RULE,
            "purpose_start p1 exists Called meanwhile (exists Wait) p2 exists Wait purpose_end",
            [("SLEEC510", "Wait"), ("SLEEC510", "Wait")],
        ),
        ("R1 when Called then Answer within 1 minute otherwise Wait", "concern_start c1 exists Wait concern_end", []),
        (RULE, "concern_start c1 exists Wait concern_end relation_start equal Called Wait relation_end", []),
        (RULE, "relation_start equal Called Wait relation_end", [("SLEEC511", "equal Called Wait")]),
        (RULE, "relation_start forbid Wait {asleep} relation_end", [("SLEEC511", "forbid Wait {asleep}")]),
        (RULE, "relation_start witness Called Wait mutualExclusive Wait Answer relation_end", []),
        (RULE, "relation_start equal Called Answer measure invariant {asleep} relation_end", []),
    ],
)
def test_events_that_no_rule_knows(rules, beside, expected):
    assert said(dsl(rules, beside), "stray-event") == expected


def test_the_nearest_event_is_suggested_where_none_is_declared():
    ruleset = parse("RULE r\nWHEN UserFalls THEN CallHelp WITHIN 1 minute\nPURPOSE p EXISTS UserFals WHILE CallHelp")
    (result,) = run_checks(ruleset, ["stray-event"])
    (finding,) = result.findings
    assert finding.obligations == ("p",)
    assert finding.help == "did you mean `UserFalls`?"
    assert not said("RULE r\nWHEN t THEN o WITHIN 1 minute\nEXCLUSIVE o, p\nCONCERN c EXISTS p", "stray-event")


# Conditions that never change -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("condition", "expected"),
    [
        ("({heat} > 3) or ({heat} <= 3)", ["({heat} > 3) or ({heat} <= 3)"]),
        ("{asleep} or (({heat} > 3) and ({heat} < 4))", ["({heat} > 3) and ({heat} < 4)"]),
        ("{asleep} and ({risk} >= low)", ["{risk} >= low"]),
        ("{risk} >= low", ["{risk} >= low"]),
        ("{asleep} and (not ({risk} > severe))", ["{risk} > severe"]),
        ("{asleep} or ({heat} <> {heat})", ["{heat} <> {heat}"]),
        ("not (not ({asleep} or (not {asleep})))", ["{asleep} or (not {asleep})"]),
        ("true", ["true"]),
        ("0 < LIMIT", ["0 < LIMIT"]),
        ("{asleep} and (50 <> 34)", ["50 <> 34"]),
        ("{asleep} or (0 > 1)", ["0 > 1"]),
        # That the whole is never true is said by dead-rule.
        ("({heat} > 3) and ({heat} < 4)", []),
        ("{asleep} and false", []),
        # That it is past the end of the scale is said by defect.
        ("{asleep} or ({risk} > LIMIT)", []),
        ("{asleep} or ({pain} < severe)", []),
        ("({heat} > 3) or ({heat} <= 2)", []),
        ("({risk} > low) and ({pain} > none)", []),
        ("{asleep} or ({heat} > 3)", []),
    ],
)
def test_conditions_that_never_change(condition, expected):
    found = said(dsl(f"R1 when Called and ({condition}) then Answer"), "constant-condition")
    assert [(code, place.strip("()")) for code, place in found] == [("SLEEC512", e.strip("()")) for e in expected]


def test_conditions_are_looked_at_wherever_they_stand():
    rules = (
        "R1 when Called then Answer within 1 minute otherwise {Wait unless ({risk} >= low) then Ring}\n"
        "R2 when Called and ({risk} >= low) then Wait"
    )
    beside = (
        "concern_start c1 exists Called and (({heat} > 3) and ({heat} < 4)) concern_end\n"
        "relation_start measure invariant (({asleep}) or (not {asleep})) relation_end"
    )
    results = run_checks(parse(dsl(rules, beside)), ["constant-condition"])
    found = [(f.rules, f.message) for f in results[0].findings]
    assert found == [
        (("R1",), "this condition is always true"),
        (("R2",), "this condition is always true"),
        ((), "this condition is always false"),
        ((), "this condition is always true"),
    ]


@settings(max_examples=60)
@given(small_rulesets(measures=True, rules=2, constraints=False, assumptions=False))
def test_what_never_changes_is_found_as_by_brute_force(ruleset):
    worlds = list(brute.contexts(ruleset))

    def always(formula):
        first = brute.value(formula, worlds[0], measures=ruleset.measures)
        same = all(brute.value(formula, world, measures=ruleset.measures) == first for world in worlds)
        return first if same else None

    def parts(formula):
        """The smallest constant parts."""
        operands = [formula.operand] if isinstance(formula, Not) else []
        if isinstance(formula, (And, Or)):
            operands = list(formula.operands)
        inner = [found for operand in operands for found in parts(operand)]
        value = always(formula)
        return inner or ([] if value is None else [value])

    expected = [
        (rule.label, value)
        for rule in ruleset.rules
        for condition in formulas_of(rule)
        if always(condition) is not False
        for value in parts(condition)
    ]
    (result,) = run_checks(ruleset, ["constant-condition"])
    # The rulesets have no text, so that findings of one rule have one place and are one.
    found = {(f.rules[0], f.message.endswith("true")) for f in CONSTANT_CONDITION.run(RulesetIndex(ruleset))}
    assert found == set(expected)
    assert bool(result.findings) == bool(expected)


# Windows --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("rules", "beside", "expected"),
    [
        ("R1 when Called then Answer within 0 minutes", "", ["within 0 minutes"]),
        ("R1 when Called then not Answer within NONE hours", "", ["within NONE hours"]),
        ("R1 when Called then Answer within [0, 0] days", "", ["within [0, 0] days"]),
        ("R1 when Called then Answer within [0, 1] days", "", []),
        ("R1 when Called then Answer within {heat} seconds", "", []),
        ("R1 when Called then Answer eventually", "", []),
        ("R1 when Called then Wait else {Answer unless asleep then Ring within 0 days}", "", ["within 0 days"]),
        (
            RULE,
            "concern_start c1 exists Called meanwhile (when Answer then Called within 0 days) concern_end",
            ["within 0 days"],
        ),
        (RULE, "relation_start when Called then {asleep} for NONE days relation_end", ["NONE days"]),
        (RULE, "relation_start when Called then {asleep} for 1 day relation_end", []),
    ],
)
def test_windows_without_length(rules, beside, expected):
    assert said(dsl(rules, beside), "zero-window") == [("SLEEC513", place) for place in expected]


@pytest.mark.parametrize("window", ["[5, 2]", "[LIMIT, NONE]", "[1 hour, 30 minutes]", "-1", "[-1, 2]"])
def test_empty_and_negative_windows_are_refused(window):
    with pytest.raises(LanguageError, match=r"before it begins|negative"):
        parse(dsl(f"R1 when Called then Answer within {window} minutes".replace("minutes] minutes", "minutes]")))


def test_a_prohibition_without_a_window_in_the_dialect_that_has_none():
    rules = (
        "R1 when Called and asleep then not Answer\n"
        "unless heat > 3 then not Answer within 1 hour\n"
        "unless heat > 4 then Wait within 1 hour otherwise not Ring"
    )
    assert said(dsl(rules), "bare-prohibition") == [("SLEEC514", "not Answer"), ("SLEEC514", "not Ring")]
    assert "bare-prohibition" in checks_for(parse(dsl(rules)))
    # LEGOS-SLEEC reads it as it is read here.
    assert "bare-prohibition" not in checks_for(parse(dsl("R1 when Called and {asleep} then not Answer")))


# Hedges of what is due in place of a response --------------------------------------------------------------

DEEP = "{Ring else {Wait unless ({heat} > 2) then Ring unless ({heat} < 3) then Ring}}"


@pytest.mark.parametrize(
    ("response", "dead"),
    [
        ("Answer within 1 hour otherwise {Wait unless (not {asleep}) then Ring}", ["unless (not {asleep}) then Ring"]),
        ("Answer within 1 minute otherwise {Wait unless {asleep} then Ring}", []),
        ("Answer else {Wait unless ({risk} < low) then Ring}", ["unless ({risk} < low) then Ring"]),
        (f"Answer else {{Wait unless ({{heat}} > 3) then {DEEP}}}", ["unless ({heat} < 3) then Ring"]),
        (
            "Answer unless ({heat} > 3) then {Wait else {Ring unless ({heat} < 4) then Wait}}",
            ["unless ({heat} < 4) then Wait"],
        ),
        (
            "B unless ({heat} > 3) then Wait unless ({heat} < 2) then {Wait else {Ring unless ({heat} > 3) then B}}",
            ["unless ({heat} > 3) then B"],
        ),
        # The clause itself is dead: what is inside it needs no word of its own.
        (
            "Answer unless ({risk} < low) then {Wait else {Ring unless {asleep} then B}}",
            ["unless ({risk} < low) then {Wait else {Ring unless {asleep} then B}}"],
        ),
    ],
)
def test_hedges_inside_otherwise_and_else(response, dead):
    found = said(dsl(f"R1 when Called and {{asleep}} then {response}"), "dead-hedge")
    assert found == [("SLEEC202", place) for place in dead]


def test_a_scale_that_is_compared_past_its_end_is_read_and_not_crashed_on():
    ruleset = parse(dsl("R1 when Called and ({pain} < severe) then Answer"))
    guard = ruleset.rules[0].guard
    assert isinstance(guard, Comparison)
    assert guard.right == ScaleValue("severe", 2)
