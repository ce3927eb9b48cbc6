"""The DSL of SLEEC-TK and LEGOS-SLEEC: what is read, and that it is printed back."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sleec_runtime.errors import LanguageError
from sleec_runtime.evaluation.formula_truth import Situation, truth
from sleec_runtime.evaluation.hedge_chain import decide
from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import (
    And,
    Atom,
    Calculation,
    Claim,
    Comparison,
    Context,
    Effect,
    EventRelation,
    Lasting,
    Length,
    MeasureRef,
    MeasureRelation,
    Not,
    Number,
    Or,
    Ruleset,
    ScaleValue,
    Truth,
    claims,
    constructs,
)
from tests.support.growth import grows_in_proportion

DEFINITIONS = """def_start
  event A
  event B as system
  event C as environment
  measure m: boolean
  measure n: boolean
  measure x: numeric
  measure risk: scale(low, middle, high)
  constant K = 5
  constant L = K
def_end
"""


def rules(text: str) -> Ruleset:
    return parse(f"{DEFINITIONS}rule_start\n{text}\nrule_end\n")


def timing(text: str):
    (rule,) = rules(f"R1 when A then {text}").rules
    return rule.default.obligations[0].timing


# Conditions -----------------------------------------------------------------------------------------------

M, N = Atom("condition", "m"), Atom("condition", "n")
HIGH = Comparison(MeasureRef("risk"), "=", ScaleValue("high", 2))
MANY = Comparison(MeasureRef("x"), ">", Number(5, "K"))


@pytest.mark.parametrize(
    ("text", "formula"),
    [
        ("m", M),
        ("{m}", M),
        ("not m", Not(M)),
        ("m and n or risk = high", Or((And((M, N)), HIGH))),
        ("m or n and risk = high", And((Or((M, N)), HIGH))),
        ("m or n or m", Or((M, N, M))),
        ("not m and n", And((Not(M), N))),
        ("not risk = high and m", And((Not(HIGH), M))),
        ("({m} and ({n} and {m}))", And((M, N, M))),
        ("(({m} and {n}) and {m})", And((And((M, N)), M))),
        ("({x} > K)", MANY),
        ("({x} > -> K)", MANY),
        ("m = true", M),
        ("m <> true", Not(M)),
        ("high = risk", Comparison(ScaleValue("high", 2), "=", MeasureRef("risk"))),
        ("x >= -3", Comparison(MeasureRef("x"), ">=", Number(-3))),
    ],
)
def test_conditions(text, formula):
    (rule,) = rules(f"R1 when A and {text} then B").rules
    assert rule.guard == formula


def test_dialects_are_told_apart():
    assert rules("R1 when A and m then B").dialect == "sleec-tk"
    assert rules("R1 when A then B within 5 minutes otherwise {C unless m}").dialect == "sleec-tk"
    assert rules("R1 when A and {m} then B").dialect == "legos"
    assert rules("R1 when A then B eventually").dialect == "legos"
    assert rules("R1 when A then B").dialect == "legos"


def test_rules_of_the_dsl_are_read_by_priority():
    ruleset = rules("R1 when A then B unless m then C unless n")
    assert (ruleset.reading, ruleset.syntax) == ("priority", "dsl")
    (rule,) = ruleset.rules
    assert [hedge.obligations != () for hedge in rule.hedges] == [True, False]


# Problems -------------------------------------------------------------------------------------------------

HELD = """when A and {m} then B within {x} minutes otherwise C
else {not B unless {n} then {C unless {m}} unless {n} then C}
unless ({m} and {n}) then {B unless {m} then C within 1 minute otherwise {A unless {n}}} unless {n}"""
PLACES = len(HELD.split())


@pytest.mark.parametrize("place", range(1, PLACES + 1))
def test_a_problem_anywhere_in_a_rule_with_braces_is_one_problem(place):
    assert rules(f"R1 {HELD}").rules
    words = HELD.split()
    broken = " ".join([*words[:place], "?", *words[place:]])
    with pytest.raises(LanguageError) as caught:
        rules(f"R1 {broken}\nR2 {HELD}")
    (problem,) = caught.value.problems
    assert "?" in problem.message


@pytest.mark.parametrize(
    ("clause", "count"),
    [
        ("then B within ({x} + ?) minutes otherwise C else {not B unless {n} then C} unless m", 1),
        ("then not {B unless {n} then C} unless m", 1),
        ("then B within 2 munites unless m then {not B unless n then C} unless ? then A", 2),
        ("and {m then B unless ? then {C unless n} unless ! then A", 3),
        ("then B} unless ?", 2),
        ("then B unless (({m}) then C unless {n} unless {m} then A)", 1),
        ("then B unless (({m}) then C unless ? unless {m} then A unless !", 3),
    ],
)
def test_after_a_problem_the_hedges_of_the_rule_are_read_and_those_in_braces_are_not(clause, count):
    with pytest.raises(LanguageError) as caught:
        rules(f"R1 when A {clause}")
    assert len(caught.value.problems) == count


def problems_of(text: str) -> list[tuple[int, str]]:
    with pytest.raises(LanguageError) as caught:
        parse(text)
    return [(caught.value.source.place(p.span).line, p.message) for p in caught.value.problems]


def test_where_nothing_is_defined_that_is_one_problem():
    text = "rule_start\nR1 when A and {m} and ({x} > K) then B within K minutes unless {r} = low\nR2 when B then A\n"
    nothing = (1, "there is no def_start block, so no name in this text is defined")
    assert problems_of(f"{text}rule_end") == [nothing]
    assert problems_of(f"{text}R3 when A then not\nrule_end") == [
        nothing,
        (4, "expected the name of an event, but found `rule_end`"),
    ]
    assert problems_of(f"event A {text}rule_end") == [
        (1, "expected the start of a block, such as def_start, but found `event`")
    ]
    assert problems_of("rule_start rule_end") == [(1, "there are no rules in this text")]


def test_a_name_without_a_definition_is_reported_where_it_is_used_first():
    text = "R1 when Aa and {mm} then Bb\nR2 when Aa then Bb unless {mm}\nR3 when A and ({y} > k) then B within k days"
    assert problems_of(f"def_start event A event B def_end rule_start\n{text}\nR4 when Bb then A rule_end") == [
        (2, "no event is called `Aa`; it is used in 1 more place"),
        (2, "no boolean measure is called `mm`; it is used in 1 more place"),
        (2, "no event is called `Bb`; it is used in 2 more places"),
        (4, "no constant or numeric measure is called `y`"),
        (4, "no constant or numeric measure is called `k`; it is used in 1 more place"),
    ]


SCALE_OR_NUMBER = "compare `risk` with it, or write a number"


@pytest.mark.parametrize("comparison", ["({level} = low)", "level = low", "low < level"])
def test_a_measure_without_a_definition_that_is_compared_with_a_value_of_a_scale(comparison):
    with pytest.raises(LanguageError) as caught:
        rules(f"R1 when A and {comparison} then B unless ({{level}} > 3)")
    (problem,) = caught.value.problems
    assert problem.message == "no measure is called `level`; it is used in 1 more place"
    assert problem.hint == "define it, between def_start and def_end: measure level: scale(low, ...)"
    with pytest.raises(LanguageError) as caught:
        rules("R1 when A and {m} = low then B unless rism = low unless ({x} = low)")
    assert [(problem.message, problem.hint) for problem in caught.value.problems] == [
        (
            "`m` is a boolean measure (line 5), which cannot be compared with `low`",
            "write m alone, or not m; `risk` can be low < middle < high",
        ),
        ("no measure is called `rism`", "did you mean `risk`?"),
        (
            "`x` is a numeric measure (line 7), and `low` is a value of `risk` (line 8); they cannot be compared",
            SCALE_OR_NUMBER,
        ),
    ]


UNNAMED = [(13, "the rule in line 13 has no name")]


@pytest.mark.parametrize(
    "response",
    [
        "B",
        "not B",
        "B eventually",
        "B within 2 minutes",
        "B within K minutes",
        "B within {x} minutes",
        "B within (K + 2) minutes",
        "B within [1, 5] minutes",
        "B within 2 minutes otherwise C",
        "B else C",
        "B unless m",
        "B unless not {n}",
        "B unless risk = high",
        "B unless x > 5",
        "B unless m then C",
        "B unless m then {C unless n}",
    ],
)
def test_a_rule_without_a_name_is_said_to_be_one(response):
    def found(text: str) -> list[tuple[int, str]]:
        return problems_of(f"{DEFINITIONS}rule_start {text} rule_end")

    one = f"R1 when A then {response}"
    assert found(f"{one}\nwhen C then B") == UNNAMED
    assert found(f"{one}\nwhen C then B\nR3 when A then B") == UNNAMED
    assert found(f"{one}\nwhen C then B\nwhen C then B") == [*UNNAMED, (14, "the rule in line 14 has no name")]
    assert found(f"{one}\nwhen C then not") == [
        *UNNAMED,
        (13, "expected the name of an event, but found `rule_end`"),
    ]
    for label in ("\nR2 ", " R2 ", "\nR2\n", "\nminutes ", "\n R2\t"):
        ruleset = rules(f"{one}{label}when C then B")
        assert [rule.label for rule in ruleset.rules] == ["R1", label.strip()]
        assert parse(print_ruleset(ruleset)) == ruleset


def test_an_unfinished_rule_before_one_with_a_name_is_said_to_be_one():
    for unfinished in ("then", "then B within 2", "then B unless", "and", "then B within 2 minutes otherwise"):
        ((line, message),) = problems_of(f"{DEFINITIONS}rule_start R1 when A {unfinished}\nR2 when A then B rule_end")
        assert line == 12
        assert message.endswith("but the rule `R2` starts here") or message.startswith("a unit is missing")


def test_names_of_rules_and_claims_have_no_colon():
    text = f"{DEFINITIONS}rule_start R1: when A then B\nR2 : when A then B unless ?\nR3: exists A rule_end\n"
    claims = (
        "concern_start c1: exists A while B\nexists B\nwhen B then C concern_end purpose_start exists A purpose_end"
    )
    assert problems_of(text + claims) == [
        (12, "unexpected colon after the name of the rule"),
        (13, "unexpected colon after the name of the rule"),
        (13, "expected a condition, but found `?`"),
        (14, "unexpected colon after the name of the rule"),
        (14, "a rule cannot begin with exists"),
        (15, "unexpected colon after the name of the concern"),
        (16, "the concern in line 16 has no name"),
        (17, "the concern in line 17 has no name"),
        (17, "the purpose in line 17 has no name"),
    ]


# Times ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "seconds"),
    [("5 minutes", 300), ("1 minute", 60), ("2 hours", 7200), ("1 day", 86400), ("K seconds", 5), ("L hours", 18000)],
)
def test_windows_have_exact_seconds_and_keep_what_is_written(text, seconds):
    window = timing(f"B within {text}").window
    assert window.end.seconds == Fraction(seconds)
    assert window.start is None
    assert f"within {text}".rstrip("s") in print_ruleset(rules(f"R1 when A then B within {text}"))


@pytest.mark.parametrize(
    "text", ["[1, 5] minutes", "[1 minutes, 5 minutes]", "[1, 5 minutes]", "[60 seconds, 5 minutes]"]
)
def test_windows_with_two_ends(text):
    window = timing(f"B within {text}").window
    assert (window.start.seconds, window.end.seconds) == (60, 300)


def test_a_measure_may_say_how_long():
    assert timing("B within {x} seconds").window.end == Length(MeasureRef("x"), "seconds")


@pytest.mark.parametrize(
    ("text", "amount", "printed"),
    [
        ("({x} + 2) minutes", ((1, ("x",)), (2, ())), "({x} + 2) minutes"),
        ("(120 - ((22 - {x}) * 15)) seconds", ((15, ("x",)), (-210, ())), "((15 * {x}) - 210) seconds"),
        ("(K - {x}) seconds", ((5, ()), (-1, ("x",))), "(5 - {x}) seconds"),
        ("(2 * {x}) hours", ((2, ("x",)),), "(2 * {x}) hours"),
        ("({x} * {x} - 1) days", ((1, ("x", "x")), (-1, ())), "(({x} * {x}) - 1) days"),
    ],
)
def test_measures_may_say_how_long_by_a_calculation(text, amount, printed):
    found = timing(f"B within {text}").window.end
    assert (found.amount, found.seconds, found.measures) == (Calculation(amount), None, ("x",))
    again = print_ruleset(rules(f"R1 when A then B within {text} unless {{m}}"))
    assert f"within {printed}" in again
    assert str(parse(again).rules[0].default.obligations[0].timing) == f"within {found}"


def test_what_comes_to_a_measure_or_a_number_is_one():
    assert timing("B within ({x} + K - 5) seconds").window.end == Length(MeasureRef("x"), "seconds")
    assert timing("B within ({x} - {x} + K) seconds").window.end == Length(Number(5), "seconds")


def test_otherwise_and_else_belong_to_the_nearest_response():
    found = timing("B within 5 minutes otherwise C else A")
    (otherwise,) = found.otherwise.obligations
    assert found.instead is None
    assert otherwise.timing.instead.obligations[0].name == "A"
    found = timing("B within 5 minutes otherwise {C} else not A eventually")
    assert found.otherwise.obligations[0].timing is None
    assert found.instead.obligations[0].negated
    assert found.instead.obligations[0].timing.window.end is None


def test_an_unless_without_braces_belongs_to_the_rule():
    (rule,) = rules("R1 when A then B within 1 hours otherwise C unless m").rules
    assert len(rule.hedges) == 1
    (rule,) = rules("R1 when A then B within 1 hours otherwise {C unless m}").rules
    assert not rule.hedges
    assert len(timing("B within 1 hours otherwise {C unless m}").otherwise.hedges) == 1
    assert {"A", "B", "C"} == rules("R1 when A then B within 1 hours otherwise {C unless m}").obligations | {"A"}


# What stands beside the rules -----------------------------------------------------------------------------

BESIDE = f"""// about this file

{DEFINITIONS}
rule_start
  // the only rule
  R1 when A then B  // now
     // unless it is known
     unless {{m}} then not C within 2 minutes else B
rule_end
concern_start
  c1 when A and ({{x}} > K) then not B within [1 minutes, 2 minutes] while C
  c2 exists A while B eventually unless {{m}} then C while C meanwhile (when B then A)
concern_end
/* purposes
 * follow
 */
purpose_start
  p1 exists A
  p2 when A and {{m}} meanwhile (exists B and {{n}} meanwhile (exists C))
purpose_end
relation_start
  witness A B
  equal A B
  mutualExclusive A B
  happenBefore A B
  measure imply {{m}} ({{x}} > 3)
  measure iff {{m}} {{n}}
  measure mutualExclusive {{m}} {{n}}
  measure opposite {{m}} {{n}}
  measure invariant (not {{m}})
  causation A {{m}}
  includes A (not {{m}})
  forbid A {{m}}
  when A and {{m}} then {{n}} until B and ({{risk}} > low)
  when A then {{n}} for 5 minutes
relation_end
// the end
"""


def test_concerns_purposes_and_relations():
    ruleset = parse(BESIDE)
    one, two = claims(ruleset, "concern")
    assert (one.form, one.event, len(one.responses)) == ("when", "A", 2)
    assert (two.form, len(two.responses), len(two.responses[0].hedges)) == ("exists", 2, 1)
    assert two.meanwhile is not None
    assert two.meanwhile.form == "when"
    assert [p.label for p in claims(ruleset, "purpose")] == ["p1", "p2"]
    kinds = [type(s) for s in ruleset.statements[10:]]
    assert kinds == [Claim] * 4 + [EventRelation] * 4 + [MeasureRelation] * 5 + [Effect] * 3 + [Lasting] * 2
    assert len(list(constructs(ruleset))) == 2 + 14


def test_what_is_printed_says_the_same_and_keeps_the_comments():
    ruleset = parse(BESIDE)
    text = print_ruleset(ruleset)
    again = parse(text)
    assert again == ruleset
    assert print_ruleset(again) == text
    for comment in ("about this file", "the only rule", "now", "unless it is known", "purposes", "follow", "the end"):
        assert f"// {comment}" in text


def test_every_node_has_its_span():
    ruleset = parse(BESIDE)
    source = ruleset.source.text
    (rule,) = ruleset.rules
    assert source[slice(*rule.span)].startswith("R1 when A")
    assert source[slice(*rule.span)].endswith("else B")
    assert source[slice(*rule.hedges[0].span)].startswith("unless {m}")
    assert source[slice(*rule.hedges[0].obligations[0].span)] == "not C within 2 minutes else B"
    for statement in ruleset.statements:
        assert source[slice(*statement.span)].strip()


def test_labels_and_values_that_others_read_are_defects():
    ruleset = rules("R1 when A and risk = low then B\nR1 when A then C")
    assert [rule.label for rule in ruleset.rules] == ["R1", "R1#2"]
    assert [defect.kind for defect in ruleset.defects] == ["repeated-label"]
    assert parse(print_ruleset(ruleset)) == ruleset
    ruleset = parse(
        "def_start\nevent A\nmeasure one: scale(a, b)\nmeasure two: scale(c, d)\ndef_end\n"
        "rule_start\nR1 when A and ({one} = d) then A\nrule_end\n"
    )
    assert [defect.kind for defect in ruleset.defects] == ["foreign-value"]
    assert ruleset.rules[0].guard == Comparison(MeasureRef("one"), "=", ScaleValue("d", 1))
    assert parse(print_ruleset(ruleset)) == ruleset


@pytest.mark.parametrize(
    ("written", "rank", "said"),
    [
        ("1", 1, "`one` is a scale, but 1 is a number; it is read as `b`, which has place 1, counted from 0"),
        ("K", 20, "`one` is a scale, but `K` (= 20) is a number; every value of `one` is below it, so"),
        ("-1", -1, "`one` is a scale, but -1 is a number; every value of `one` is above it, so"),
        ("e", 2, "`e` is a value of `two`, not of `one`; every value of `one` is below it, so"),
    ],
)
def test_what_is_no_value_of_a_scale_is_read_by_its_place(written, rank, said):
    text = (
        "def_start\nevent A\nmeasure one: scale(a, b)\nmeasure two: scale(c, d, e)\nconstant K = 20\ndef_end\n"
        f"rule_start\nR1 when A and ({{one}} > {written}) then A\n"
        f"R2 when A and ({written} <= {{one}}) then A\nrule_end\n"
    )
    ruleset = parse(text)
    assert ruleset.rules[0].guard == Comparison(MeasureRef("one"), ">", ScaleValue(written, rank))
    assert ruleset.rules[1].guard == Comparison(ScaleValue(written, rank), "<=", MeasureRef("one"))
    assert {defect.kind for defect in ruleset.defects} == {"foreign-value" if written == "e" else "number-as-value"}
    assert [defect.message.startswith(said) for defect in ruleset.defects] == [True, True]
    assert parse(print_ruleset(ruleset)) == ruleset
    for rule in ruleset.rules:
        decided = [
            decide(rule, Context(frozenset({"A"}), {"one": value}), "priority", ruleset.measures) for value in "ab"
        ]
        above = [place > rank if rule.label == "R1" else place >= rank for place in range(2)]
        assert [decision is not None for decision in decided] == above


def test_neither_a_constant_in_braces_nor_a_measure_is_a_place_in_a_scale():
    for written in ("{K}", "{n}", "n"):
        with pytest.raises(LanguageError, match="not a value of `one`"):
            parse(
                "def_start\nevent A\nmeasure one: scale(a, b)\nmeasure n: numeric\nconstant K = 1\ndef_end\n"
                f"rule_start\nR1 when A and ({{one}} > {written}) then A\nrule_end\n"
            )


def test_ten_megabytes_of_rules_are_read_in_time_linear_in_their_size():
    line = "R{} when A and ({{risk}} > low) then B within 5 minutes unless {{m}} then C\n"
    small, large = ("".join(line.format(n) for n in range(size)) for size in (1_000, 10_000))
    assert len(rules(large).rules) == 10_000
    assert grows_in_proportion(lambda: rules(small), lambda: rules(large), 10)


# The case studies -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("depth", [33, 34, 20_000])
def test_alternatives_without_braces_are_not_nested_too_deeply(depth):
    text = f"def_start event A def_end rule_start R1 when A then {'A otherwise ' * depth}A rule_end"
    if depth == 33:
        assert print_ruleset(parse(text)).count("otherwise") == depth
    else:
        with pytest.raises(LanguageError, match="nested too deeply"):
            parse(text)


# Calculations ---------------------------------------------------------------------------------------------

CALCULATING = """def_start
  event A
  event B
  measure x: numeric
  measure y: numeric
  constant K = 3
def_end
rule_start
  R1 when A and %s then B
rule_end
"""


def guard_of(condition: str):
    (rule,) = parse(CALCULATING % condition).rules
    return rule.guard


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("(({x} + 1) > 5)", "({x} > 4)"),
        ("((5 - {x}) > 2)", "({x} < 3)"),
        ("((2 * {x}) <= 5)", "({x} <= 2)"),
        ("((2 * {x}) < 5)", "({x} < 3)"),
        ("((2 * {x}) > 5)", "({x} > 2)"),
        ("((2 * {x}) >= 5)", "({x} >= 3)"),
        ("((2 * {x}) = 6)", "({x} = 3)"),
        ("({x} >= (2 * (K + 1)))", "({x} >= 8)"),
        ("(({x} - {y}) < 0)", "({x} < {y})"),
        ("(({x} + K) <= ({y} + 3))", "({x} <= {y})"),
        ("({x} > ({x} - ({x} - 4)))", "({x} > 4)"),
    ],
)
def test_a_calculation_is_read_as_a_comparison(written: str, meant: str) -> None:
    assert guard_of(written) == guard_of(meant)


@pytest.mark.parametrize(
    ("written", "value"),
    [("0 < 1", True), ("50 <> 34", True), ("(K < 3)", False), ("3 >= K", True), ("K = -> K", True), ("-1 > 0", False)],
)
def test_a_comparison_of_fixed_numbers_is_true_or_false(written: str, value: bool) -> None:
    text = CALCULATING % written
    ruleset = parse(text)
    (rule,) = ruleset.rules
    assert rule.guard == Truth(value)
    assert text[slice(*rule.guard.span)] in written
    assert ruleset.calculated_with == ({"K"} if "K" in written else set())
    printed = print_ruleset(ruleset)
    assert f"and {str(value).lower()} then" in printed
    assert parse(printed) == ruleset


@pytest.mark.parametrize(
    ("written", "value"),
    [("((2 * {x}) = 5)", False), ("((2 * {x}) <> 5)", True), ("((1 + 1) < K)", True), ("(({x} - {x}) > K)", False)],
)
def test_a_calculation_may_come_to_what_never_changes(written: str, value: bool) -> None:
    assert guard_of(written) == Truth(value)


@given(st.data())
def test_calculations_mean_what_arithmetic_says(data: st.DataObject) -> None:
    def side(depth: int) -> str:
        kind = data.draw(st.integers(0, 3 if depth else 1))
        if kind == 0:
            return "{x}"
        if kind == 1:
            return str(data.draw(st.integers(0, 9)))
        operator = "*" if kind == 3 else data.draw(st.sampled_from("+-"))
        left = str(data.draw(st.integers(0, 4))) if operator == "*" else side(depth - 1)
        return f"({left} {operator} {side(depth - 1)})"

    left, right = side(3), f"({side(2)} + 0)"
    operator = data.draw(st.sampled_from(["<", "<=", "=", "<>", ">", ">="]))
    x = data.draw(st.integers(-20, 20))
    guard = guard_of(f"({left} {operator} {right})")
    python = f"({left}) {({'=': '==', '<>': '!='}).get(operator, operator)} ({right})".replace("{x}", f"({x})")
    ruleset = parse(CALCULATING % "({x} > 0)")
    situation = Situation(Context(frozenset({"A"}), {"x": x}), ruleset.measures)
    assert truth(guard, situation) == eval(python)


def test_a_window_may_be_calculated() -> None:
    (rule,) = parse((CALCULATING % "({x} > 1)").replace("then B", "then B within (2 * K) minutes")).rules
    (obligation,) = rule.default.obligations
    assert str(obligation.timing) == "within 6 minutes"


@pytest.mark.parametrize("gap", ["\n", "\n\n"])
def test_comments_inside_a_block_stay_inside(gap):
    text = (
        "// head\n\n// of the names\ndef_start\n    event A\n    event B\ndef_end\n\n// of the rules\nrule_start\n"
        f"    // all of them{gap}    // the first{gap}    R1 when A then B\nrule_end\n"
    )
    written = print_ruleset(parse(text))
    assert written == text
    assert print_ruleset(parse(written)) == written
