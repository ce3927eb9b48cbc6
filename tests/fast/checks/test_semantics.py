"""The readings on which the project rests, one test for each: what rules mean, and where the paper to the letter goes
wrong."""

from __future__ import annotations

import pytest

from sleec_runtime.language import parse
from sleec_runtime.model import Context, Not, Or
from sleec_verify.checks import run_checks
from sleec_verify.encoding.equation import implications
from sleec_verify.entailment.entailment import entail
from sleec_verify.exchange.compilation.clauses import encode_ruleset
from sleec_verify.exchange.compilation.equation_one import EquationOne
from tests.support import brute_force as brute

EIGHT = """
MEASURE UserAge: number
MEASURE InstructionRepeat: number
MEASURE TimeElapsed: number
MEASURE RiskLevel: r_low < r_moderate < r_severe
CONSTANT LegalAge = 18

RULE human_on_floor
WHEN HumanOnFloor THEN CallEmergencyServices
UNLESS UserResponsive IN WHICH CASE AskForUserStatus
UNLESS UserWithCompanion IN WHICH CASE AskCompanionToCheck
RULE mealtime
WHEN MonitorMealTime THEN InformUser
UNLESS UserOccupied IN WHICH CASE RemindLater

DOMAIN hospital
RULE daisy_addressing
WHEN AddressUserName THEN UsePreferredName
UNLESS UserNameUnknown IN WHICH CASE AddressSirOrMadam
UNLESS UserDirectsOtherwise IN WHICH CASE UseUserChosenName
RULE daisy_instruction
WHEN InstructionFail THEN RepeatInstruction
UNLESS InstructionRepeat >= 3 OR TimeElapsed > 20 IN WHICH CASE CallSupport
RULE daisy_examination
WHEN PreparingExamination THEN EnsurePrivateSpace
UNLESS UserAge < LegalAge IN WHICH CASE AskLegalPresence

DOMAIN household
RULE dress_assist
WHEN CurtainOpenRequest THEN OpenCurtains
UNLESS UserUndressed IN WHICH CASE (RefuseRequest AND ExplainWhy)
UNLESS UserDistressed IN WHICH CASE (WarnUser AND OpenCurtains)
RULE dressing_started
WHEN DressingStarted THEN CloseDoor
UNLESS MedicalEmergency OR UserAdvices IN WHICH CASE DoNothing
RULE dressing_stop
WHEN UserSaysStop THEN RobotStop
UNLESS RiskLevel < r_low IN WHICH CASE AskToFinishFirst
"""


def due(text, *triggers, reading=None, **conditions):
    ruleset = parse(text)
    if reading is not None:
        ruleset = ruleset.read_as(reading)
    return entail(ruleset, Context(frozenset(triggers), conditions))


def found(text: str, *checks: str):
    return [finding for result in run_checks(parse(text), checks or None) for finding in result.findings]


def test_the_eight_rules_have_eleven_hedges_and_nineteen_branches():
    rules = parse(EIGHT).rules
    assert len(rules) == 8
    assert sum(len(rule.hedges) for rule in rules) == 11
    assert sum(len(list(rule.clauses())) for rule in rules) == 19


# A context is total over T and C, and O is open.


def test_what_is_not_in_the_context_is_false():
    answer = due(EIGHT, "CurtainOpenRequest")
    assert answer.obligations == ("OpenCurtains",)


def test_nothing_is_assumed_of_an_obligation():
    # Were O closed, what no rule obliges would be false, and this NEVER would come true.
    text = "NEVER Wait AND NOT Tell\nWHEN UserCalls THEN Wait\nWHEN UserAsks THEN Tell"
    assert due(text, "UserCalls").consistent


# Guards are mutually exclusive and, given C0, exhaustive.


@pytest.mark.parametrize("reading", ["cascade", "priority"])
def test_guards_exclude_one_another_and_leave_nothing_out(reading):
    ruleset = parse(EIGHT).read_as(reading)
    for rule in ruleset.rules:
        alone = type(ruleset)((*ruleset.measures.values(), rule), reading=reading)
        for context in brute.contexts(alone):
            true = [
                number
                for number, guard, _ in implications(rule, reading)
                if brute.value(guard, context, measures=ruleset.measures)
            ]
            assert len(true) == (rule.trigger in context.triggers)


def test_equation_1_is_built_linear():
    sizes = []
    for hedges in (50, 100, 200):
        text = "WHEN t THEN o" + "".join(f" UNLESS c{n} IN WHICH CASE p{n}" for n in range(hedges))
        sizes.append(sum(map(len, encode_ruleset(EquationOne(parse(text))).clauses)))
    assert sizes[1] / sizes[0] < 2.1
    assert sizes[2] / sizes[1] < 2.1


# Two readings of a chain of hedges.

THREE_POINTS = [
    ("AddressUserName", "UserNameUnknown", "UserDirectsOtherwise", ["UsePreferredName"], ["UseUserChosenName"]),
    ("CurtainOpenRequest", "UserUndressed", "UserDistressed", ["OpenCurtains"], ["OpenCurtains", "WarnUser"]),
    ("HumanOnFloor", "UserResponsive", "UserWithCompanion", ["CallEmergencyServices"], ["AskCompanionToCheck"]),
]


@pytest.mark.parametrize(("trigger", "first", "second", "cascade", "priority"), THREE_POINTS)
def test_the_three_points_at_which_the_readings_part(trigger, first, second, cascade, priority):
    given = {first: False, second: True}
    assert list(due(EIGHT, trigger, **given).obligations) == cascade, "the structured-English form means cascade"
    assert list(due(EIGHT, trigger, reading="priority", **given).obligations) == priority


def test_a_rule_whose_meaning_depends_on_the_reading_is_reported():
    reported = {finding.rules[0] for finding in found(EIGHT, "reading")}
    assert reported == {"daisy_addressing", "dress_assist", "human_on_floor"}


@pytest.mark.parametrize("hedges", [2, 3, 4])
def test_each_reading_can_be_rewritten_into_the_other(hedges):
    """priority → cascade: Ci becomes Ci ∨ … ∨ Cn. cascade → priority: Ci becomes C1 ∧ … ∧ Ci."""
    names = [f"c{n}" for n in range(1, hedges + 1)]

    def rule(conditions):
        chain = "".join(f" UNLESS {c} IN WHICH CASE o{n}" for n, c in enumerate(conditions, 1))
        return parse(f"WHEN t THEN o0{chain}")

    plain = rule(names)
    as_cascade = rule([" OR ".join(names[n:]) for n in range(hedges)])
    as_priority = rule([" AND ".join(names[: n + 1]) for n in range(hedges)])
    for context in brute.contexts(plain):
        assert brute.due(plain, context, "priority") == brute.due(as_cascade, context, "cascade")
        assert brute.due(plain, context, "cascade") == brute.due(as_priority, context, "priority")
        for ruleset, reading in ((as_cascade, "cascade"), (as_priority, "priority")):
            answer = entail(ruleset.read_as(reading), context)
            assert set(answer.obligations) == {o.name for o in brute.due(ruleset, context, reading)}


# Where the paper to the letter is wrong.


def test_1_entailment_does_not_share_an_epsilon():
    text = "RULE R1 WHEN a THEN o1 UNLESS c IN WHICH CASE o2\nRULE R2 WHEN b THEN o3 UNLESS d IN WHICH CASE o4"
    assert due(text, "a", "b", c=True).obligations == ("o2", "o3")


def test_2_a_rule_without_hedges_has_its_default():
    answer = due("RULE R WHEN a THEN o", "a")
    assert answer.obligations == ("o",)
    assert [(b.clause, b.layer) for b in answer.because] == [(0, None)]


def test_3_positive_rules_alone_never_conflict():
    assert not found(EIGHT, "conflict")
    assert found("WHEN a THEN o\nWHEN b THEN NOT o", "conflict")
    assert found("EXCLUSIVE o, p\nWHEN a THEN o\nWHEN b THEN p", "conflict")
    assert found("CONDITION c\nNEVER o AND c\nWHEN a THEN o", "conflict")


def test_4_a_conflict_is_no_list_of_things_to_do():
    answer = due("RULE x WHEN a THEN o\nRULE y WHEN a THEN NOT o AND p", "a")
    assert not answer.consistent
    assert answer.obligations == answer.prohibitions == ()
    assert [finding.rules for finding in answer.conflicts] == [("x", "y")]


def test_5_it_happened_and_it_is_to_be_done_are_two_things():
    text = "WHEN SmokeDetected THEN SoundAlarm\nWHEN SoundAlarm THEN CallOperator"
    answer = due(text, "SmokeDetected")
    assert answer.consistent
    assert answer.obligations == ("SoundAlarm",)
    assert due(text, "SoundAlarm").obligations == ("CallOperator",)
    encoder = encode_ruleset(EquationOne(parse(text)))
    assert {("trigger", "SoundAlarm"), ("obligation", "SoundAlarm")} <= set(encoder.variables)


def test_5_a_prohibition_is_nothing_to_do():
    answer = due("WHEN a THEN NOT o AND p", "a")
    assert answer.obligations == ("p",)
    assert answer.prohibitions == ("o",)


def test_6_a_hedge_without_response_obliges_nothing_and_lifts_the_default():
    answer = due("RULE R WHEN a THEN o UNLESS c", "a", c=True)
    assert answer.obligations == ()
    assert [(b.clause, b.layer) for b in answer.because] == [(1, "R.hc1")]


# Constraints.


def test_constraints_forbid_and_oblige_nothing():
    text = "NEVER Undress AND NOT CloseDoor\nWHEN a THEN Undress\nWHEN b THEN CloseDoor"
    answer = due(text, "a")
    assert answer.obligations == ("Undress",), "CloseDoor is a consequence, and not due"
    assert [str(c.literal) for c in answer.consequences] == ["CloseDoor"]


def test_constraints_conflict_together_through_what_no_rule_obliges():
    text = "NEVER A AND NOT B\nEXCLUSIVE B, C\nRULE x WHEN t THEN A\nRULE y WHEN t THEN C\nRULE z WHEN u THEN B"
    assert not due(text, "t").consistent
    assert {finding.rules for finding in found(text, "conflict")} == {("x", "y"), ("y", "z")}


def test_a_conflict_of_three_rules_that_clash_only_together():
    text = "NEVER A AND B AND C\nRULE x WHEN t THEN A\nRULE y WHEN u THEN B\nRULE z WHEN v THEN C"
    (finding,) = found(text, "conflict")
    assert finding.rules == ("x", "y", "z")
    assert finding.witness.triggers == ("t", "u", "v")
    assert finding.obligations == ("A", "B", "C")


def test_assumptions_remove_situations():
    text = "WHEN t THEN o UNLESS c\nWHEN u THEN NOT o"
    assert found(text, "conflict")
    assert not found(f"ASSUME NOT (t AND u)\n{text}", "conflict")
    assert not found(f"ASSUME c\n{text}", "conflict")


# Measures are exact.


def test_a_number_is_not_below_18_and_at_least_21_at_once():
    text = """
    MEASURE UserAge: number
    CONSTANT LegalAge = 18
    WHEN t AND UserAge < LegalAge THEN o
    WHEN t AND UserAge >= 21 THEN NOT o
    """
    assert not found(text, "conflict")
    (finding,) = found(text.replace(">= 21", ">= 17.5"), "conflict")
    assert 17.5 <= finding.witness.conditions["UserAge"] < 18


def test_numbers_compared_with_one_another():
    text = "WHEN t AND a < b AND b < c THEN o\nWHEN t AND c {} a THEN NOT o"
    assert not found(text.format("<="), "conflict")
    (finding,) = found(text.format(">"), "conflict")
    values = finding.witness.conditions
    assert values["a"] < values["b"] < values["c"]


def test_a_whole_number_has_less_room():
    text = "MEASURE x: {}\nRULE r WHEN t AND x > 3 AND x < 4 THEN o"
    assert not found(text.format("number"), "dead-rule")
    assert found(text.format("integer"), "dead-rule")


def test_scales_are_ordered():
    text = "MEASURE Risk: low < middle < high\nWHEN t AND Risk >= middle THEN o\nWHEN t AND Risk {} THEN NOT o"
    assert not found(text.format("< middle"), "conflict")
    (finding,) = found(text.format("<= middle"), "conflict")
    assert finding.witness.conditions == {"Risk": "middle"}
    (finding,) = found(EIGHT, "dead-hedge")
    assert finding.clauses == (("dressing_stop", 1),)


# Domains.


def test_a_ruleset_is_checked_for_each_domain():
    text = "RULE all WHEN t THEN o\nDOMAIN a\nRULE one WHEN t THEN NOT p\nDOMAIN b\nRULE two WHEN t THEN p AND NOT o"
    (finding,) = found(text, "conflict")
    assert finding.rules == ("all", "two"), "one and two never meet"
    assert finding.domains == ("b",)
    assert {f.rules[0] for f in found(text, "vacuous-conflict")} == {"all", "two"}


def test_a_rule_is_redundant_only_if_it_is_in_every_domain_where_it_counts():
    text = "RULE all WHEN t THEN o\nDOMAIN a\nRULE one WHEN t THEN o\nDOMAIN b\nRULE two WHEN u THEN p"
    assert {f.rules[0] for f in found(text, "redundant-rule")} == {"one"}


def test_the_smallest_situation_names_what_matters():
    text = "RULE x WHEN t THEN o UNLESS a AND b AND c OR d\nRULE y WHEN t AND (e AND f OR g) THEN NOT o"
    (finding,) = found(text, "conflict")
    assert finding.witness.triggers == ("t",)
    assert len(finding.witness.conditions) == 3, "d is false, one of a, b, c is false, and g is true"
    assert finding.witness.conditions["g"] is True


def test_nested_chains_mean_what_the_flat_ones_mean():
    flat = "WHEN t THEN o0 UNLESS c1 IN WHICH CASE o1 UNLESS c2 IN WHICH CASE o2"
    nested = "WHEN t THEN o0 UNLESS c1 IN WHICH CASE (o1 UNLESS c2 IN WHICH CASE (o2))"
    one, other = parse(flat), parse(nested)
    for context in brute.contexts(one):
        assert entail(one, context).obligations == entail(other, context).obligations


def test_an_or_of_conditions_needs_one_of_them():
    formula = parse("WHEN t THEN o UNLESS a OR NOT b").rules[0].hedges[0].condition
    assert isinstance(formula, Or)
    assert isinstance(formula.operands[1], Not)
