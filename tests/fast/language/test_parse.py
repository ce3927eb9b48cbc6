"""What each construct of the language becomes."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import pytest

from sleec_runtime.language import load, parse, print_formula, print_rule, print_ruleset
from sleec_runtime.model import (
    And,
    Assume,
    Atom,
    Clause,
    Comparison,
    Constant,
    Declaration,
    Exclusive,
    Formula,
    Measure,
    MeasureRef,
    Never,
    Not,
    Number,
    Obligation,
    Or,
    Rule,
    ScaleValue,
    Truth,
    leaves,
)
from tests.support.paths import ROOT

RULESETS = ROOT / "rulesets"


def condition(text: str, before: str = "") -> Formula:
    """The condition of one hedge."""
    formula = parse(f"{before}\nWHEN T THEN O UNLESS {text} IN WHICH CASE P").rules[0].hedges[0].condition
    assert formula is not None
    return formula


def is_true(name: str) -> Atom:
    return Atom("condition", name)


a, b, c = is_true("a"), is_true("b"), is_true("c")


# Rules ----------------------------------------------------------------------------------------------------


def test_the_rule_of_the_paper() -> None:
    (rule,) = parse(
        "RULE dress_assist\nWHEN CurtainOpenRequest THEN OpenCurtains\n"
        "UNLESS UserUndressed IN WHICH CASE (RefuseRequest\nAND ExplainWhy)\n"
        "UNLESS UserDistressed IN WHICH CASE (WarnUser AND\nOpenCurtains)"
    ).rules
    assert rule == Rule(
        "dress_assist",
        "CurtainOpenRequest",
        None,
        Clause(None, (Obligation("OpenCurtains"),)),
        (
            Clause(is_true("UserUndressed"), (Obligation("RefuseRequest"), Obligation("ExplainWhy"))),
            Clause(is_true("UserDistressed"), (Obligation("WarnUser"), Obligation("OpenCurtains"))),
        ),
    )


def test_the_eight_rules_of_the_paper_parse_as_they_stand() -> None:
    text = """
    WHEN AddressUserName THEN UsePreferredName
    UNLESS UserNameUnknown IN WHICH CASE AddressSirOrMadam
    UNLESS UserDirectsOtherwise IN WHICH CASE UseUserChosenName
    WHEN InstructionFail THEN RepeatInstruction
    UNLESS InstructionRepeat >= 3 OR TimeElapsed > 20 IN WHICH CASE CallSupport
    WHEN PreparingExamination THEN EnsurePrivateSpace
    UNLESS UserAge < LegalAge IN WHICH CASE AskLegalPresence
    WHEN CurtainOpenRequest THEN OpenCurtains
    UNLESS UserUndressed IN WHICH CASE (RefuseRequest AND ExplainWhy)
    UNLESS UserDistressed IN WHICH CASE (WarnUser AND OpenCurtains)
    WHEN DressingStarted THEN CloseDoor UNLESS MedicalEmergency OR UserAdvices IN WHICH CASE DoNothing
    WHEN UserSaysStop THEN RobotStop UNLESS RiskLevel < r_low IN WHICH CASE AskToFinishFirst
    WHEN HumanOnFloor THEN CallEmergencyServices
    UNLESS UserResponsive IN WHICH CASE AskForUserStatus
    UNLESS UserWithCompanion IN WHICH CASE AskCompanionToCheck
    WHEN MonitorMealTime THEN InformUser UNLESS UserOccupied IN WHICH CASE RemindLater
    """
    ruleset = parse(text)
    clauses = [clause for rule in ruleset.rules for clause in rule.clauses()]
    assert (len(ruleset.rules), len(clauses) - len(ruleset.rules), len(clauses)) == (8, 11, 19)
    assert [m.name for m in ruleset.inferred] == sorted(
        ["InstructionRepeat", "TimeElapsed", "UserAge", "LegalAge", "RiskLevel", "r_low"]
    )
    assert all(m.kind == "number" and not m.declared for m in ruleset.inferred)


@pytest.mark.parametrize("path", sorted(RULESETS.glob("*.sleec")), ids=lambda path: path.stem)
def test_shipped_rulesets_print_and_parse(path: Path) -> None:
    ruleset = load(path)
    text = print_ruleset(ruleset)
    assert parse(text) == ruleset
    assert print_ruleset(parse(text)) == text
    assert ruleset.source.sha256


def test_labels_and_numbers() -> None:
    ruleset = parse(
        "WHEN A THEN B RULE ward.night-1 WHEN A THEN B IF A THEN B RULE 12 WHEN A THEN B RULE 1.2.x IF A THEN B"
    )
    assert [(rule.label, rule.labelled) for rule in ruleset.rules] == [
        ("rule_1", False),
        ("ward.night-1", True),
        ("rule_3", False),
        ("12", True),
        ("1.2.x", True),
    ]
    assert parse(print_ruleset(ruleset)) == ruleset


def test_a_rule_keeps_the_number_it_was_called_by() -> None:
    rules = parse("DOMAIN x WHEN A THEN B DOMAIN y WHEN C THEN D").in_domain("y")
    assert "RULE rule_2" in print_ruleset(rules)


def test_guards() -> None:
    (rule,) = parse("WHEN T AND a AND b THEN O").rules
    assert rule.guard == And((a, b))
    (rule,) = parse("WHEN T AND a OR b THEN O").rules
    assert rule.guard == Or((a, b))
    assert print_rule(rule) == "WHEN T AND (a OR b) THEN O"


def test_responses() -> None:
    (rule,) = parse("WHEN T THEN (A AND (NOT B AND C)) AND D UNLESS a").rules
    assert rule.default.obligations == (Obligation("A"), Obligation("B", True), Obligation("C"), Obligation("D"))
    assert rule.hedges == (Clause(a, ()),)


def test_nested_chains() -> None:
    (rule,) = parse(
        "WHEN T THEN (A UNLESS a IN WHICH CASE B) UNLESS b IN WHICH CASE (UNLESS c IN WHICH CASE (C AND D)) UNLESS a"
    ).rules
    assert rule.default.hedges == (Clause(a, (Obligation("B"),)),)
    assert rule.hedges[0] == Clause(b, (), (Clause(c, (Obligation("C"), Obligation("D"))),))
    assert len(rule.hedges) == 2
    assert print_rule(rule) == (
        "WHEN T THEN (A\n    UNLESS a IN WHICH CASE B)\n"
        "UNLESS b IN WHICH CASE (\n    UNLESS c IN WHICH CASE (C AND D))\nUNLESS a"
    )


def test_commas_full_stops_and_line_breaks_do_no_harm() -> None:
    plain = parse("WHEN T THEN A UNLESS a IN WHICH CASE B WHEN T THEN B")
    assert parse("WHEN T, THEN A,\nUNLESS a, IN\nWHICH // x\nCASE B.\n\r\nWHEN\tT\u00a0THEN B.") == plain


# Names ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "name",
    [
        "the room is too warm",
        "the   room\nis  warm",
        "salt and pepper",
        "not in bed",
        "room 12 is free",
        "the 2nd floor is at -5 degrees",
        "patients' room",
        "the ICU is full",
        "in the ER",
        "the user directs otherwise",
        "true north is known",
        "O\u2019Brien",
        "名前",
        "e\u0301te\u0301",
        "कमरा गर्म है",
    ],
)
def test_names_and_phrases(name: str) -> None:
    import unicodedata

    assert condition(name) == is_true(unicodedata.normalize("NFC", " ".join(name.split())))


def test_names_that_look_the_same_are_the_same() -> None:
    assert condition("e\u0301t\u00e9") == condition("\u00e9te\u0301")


# Conditions -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a OR b AND c", Or((a, And((b, c))))),
        ("(a OR b) AND c", And((Or((a, b)), c))),
        ("a AND b AND c", And((a, b, c))),
        ("a AND (b AND c)", And((a, And((b, c))))),
        ("NOT a AND b", And((Not(a), b))),
        ("NOT NOT (a OR b)", Not(Not(Or((a, b))))),
        ("((a))", a),
        ("true OR false", Or((Truth(True), Truth(False)))),
        ("NOT x < 1", Not(Comparison(MeasureRef("x"), "<", Number(1)))),
    ],
)
def test_formulas(text: str, expected: Formula) -> None:
    assert condition(text) == expected
    assert condition(print_formula(expected)) == expected


@pytest.mark.parametrize(
    ("written", "operator"),
    [
        ("<", "<"),
        ("<=", "<="),
        ("≤", "<="),
        ("=", "="),
        ("==", "="),
        ("!=", "!="),
        ("<>", "!="),
        ("≠", "!="),
        ("≥", ">="),
    ],
)
def test_operators(written: str, operator: str) -> None:
    formula = condition(f"x{written}1")
    assert isinstance(formula, Comparison)
    assert formula.operator == operator


@pytest.mark.parametrize(
    ("written", "value", "printed"),
    [
        ("36.6", Fraction(183, 5), "36.6"),
        ("-0.05", Fraction(-1, 20), "-0.05"),
        ("2.50", Fraction(5, 2), "2.5"),
        ("3.0", 3, "3"),
        ("-7", -7, "-7"),
        ("007", 7, "7"),
        ("0.1", Fraction(1, 10), "0.1"),
    ],
)
def test_numbers_are_exact(written: str, value: object, printed: str) -> None:
    formula = condition(f"the body temperature > {written}")
    assert isinstance(formula, Comparison)
    assert isinstance(formula.right, Number)
    assert formula.right.value == value
    assert isinstance(formula.right.value, type(value))
    assert print_formula(formula) == f"the body temperature > {printed}"


def test_a_fraction_without_a_decimal_is_printed_as_one() -> None:
    assert print_formula(Comparison(MeasureRef("x"), "<", Number(Fraction(-1, 3)))) == "x < -1/3"


def test_scales_are_told_apart_by_the_measure() -> None:
    declared = "MEASURE Risk: low < high MEASURE Pain: none < low MEASURE Pain2: none < low\n"
    assert condition("Risk > low", declared) == Comparison(MeasureRef("Risk"), ">", ScaleValue("low", 0))
    assert condition("low = Pain", declared) == Comparison(ScaleValue("low", 1), "=", MeasureRef("Pain"))
    assert condition("Pain < Pain2", declared) == Comparison(MeasureRef("Pain"), "<", MeasureRef("Pain2"))


def test_constants_may_stand_anywhere() -> None:
    ruleset = parse("CONSTANT A = B\nWHEN T THEN O UNLESS x < A\nCONSTANT B = C\nCONSTANT C = 1.5")
    assert [s.value for s in ruleset.statements if isinstance(s, Constant)] == [Fraction(3, 2)] * 3
    (leaf,) = leaves(ruleset.rules[0].hedges[0].condition or Truth(True))
    assert leaf == Comparison(MeasureRef("x"), "<", Number(Fraction(3, 2), "A"))


def test_measures() -> None:
    ruleset = parse(
        "MEASURE n: number MEASURE i: integer MEASURE s: very low < low MEASURE q: boolean WHEN T THEN O UNLESS q"
    )
    assert ruleset.statements[:4] == (
        Measure("n", "number"),
        Measure("i", "integer"),
        Measure("s", "scale", ("very low", "low")),
        Declaration("condition", ("q",)),
    )


# Other statements -----------------------------------------------------------------------------------------


def test_domains() -> None:
    ruleset = parse(
        "WHEN A THEN B DOMAIN x WHEN A THEN B NEVER B DOMAIN day ward, x EXCLUSIVE B, C MEASURE m: number "
        "DOMAIN everywhere WHEN A THEN C ASSUME a"
    )
    found = [s.domains for s in ruleset.statements if isinstance(s, (Rule, Exclusive, Never, Assume))]
    assert found == [None, ("x",), ("x",), ("day ward", "x"), None, None]


@pytest.mark.parametrize(
    ("text", "reading", "stated"),
    [("", "cascade", False), ("READING cascade", "cascade", True), ("READING priority", "priority", True)],
)
def test_readings(text: str, reading: str, stated: bool) -> None:
    ruleset = parse(f"WHEN A THEN B {text}")
    assert (ruleset.reading, ruleset.reading_stated) == (reading, stated)
    assert ("READING" in print_ruleset(ruleset)) == stated


def test_names_in_constraints() -> None:
    ruleset = parse(
        "NEVER O AND T AND c AND both AND new AND situation\nASSUME T OR c OR both OR situation\n"
        "WHEN T THEN O UNLESS c IN WHICH CASE both\nWHEN both THEN O"
    )
    never, assume = (
        {leaf.name: leaf.kind for leaf in leaves(s.formula) if isinstance(leaf, Atom)}
        for s in ruleset.statements
        if isinstance(s, (Never, Assume))
    )
    assert never == {
        "O": "obligation",
        "T": "trigger",
        "c": "condition",
        "both": "obligation",
        "new": "obligation",
        "situation": "condition",
    }
    assert assume == {"T": "trigger", "c": "condition", "both": "trigger", "situation": "condition"}
