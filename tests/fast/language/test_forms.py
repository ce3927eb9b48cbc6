"""Forms of plain English: the table of the docs, what stays a name, and random texts with their canonical form."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse, print_ruleset
from sleec_runtime.model import And
from tests.support.negated_conditions import CERTAIN, UNCERTAIN
from tests.support.paths import ROOT

DECLARATIONS = "MEASURE age: number\nMEASURE danger: low < high\nMEASURE body weight: integer\nCONSTANT LegalAge = 18\n"
PAGE = (ROOT / "docs" / "language.md").read_text(encoding="utf-8")
TABLE = re.findall(r"^\| `((?:THEN|UNLESS|ASSUME) [^`]+)` \| `([^`]+)` \|$", PAGE, re.MULTILINE)


def whole(part: str) -> str:
    """A text with one part of a rule, or a statement, and the condition `it is night`."""
    rest = "\nWHEN b THEN y\nUNLESS it is night\n"
    if part.startswith("THEN"):
        return f"{DECLARATIONS}WHEN a {part}{rest}"
    return f"{DECLARATIONS}WHEN a THEN x\n{part}{rest}"


def test_the_docs_have_the_forms() -> None:
    assert len(TABLE) >= 19


@pytest.mark.parametrize(("written", "canonical"), TABLE)
def test_the_form_means_its_canonical_form(written: str, canonical: str) -> None:
    ruleset = parse(whole(written))
    assert ruleset == parse(whole(canonical))
    printed = print_ruleset(ruleset)
    assert canonical in printed
    assert parse(printed) == ruleset
    assert print_ruleset(parse(printed)) == printed


@pytest.mark.parametrize(
    "part",
    [
        "THEN may leave",
        "THEN must not only leave",
        "THEN the robot leaves",
        "THEN must never not leave",
        "THEN NOT must not leave",
        "THEN should not have to leave",
        "THEN do not need to leave",
        "THEN do not forget the keys",
        "THEN must not refuse to leave",
        "THEN do not hesitate to leave",
        "THEN must not avoid leaving",
        "THEN must not fail",
        "THEN must not fail to not leave",
        "THEN never fail to forget to leave",
        "THEN must not fail to never leave",
        "ASSUME NOT age is never below 3",
        "ASSUME c OR age is never below 3",
        "ASSUME age is never below 3 AND c",
        "ASSUME NOT age is always below 3",
        "ASSUME c OR NOT the age is never below 3",
        "UNLESS the child is under 6",
        "UNLESS age is under 6 years",
        "UNLESS age is high",
        "UNLESS danger is unknown",
        "UNLESS age is never below 3",
        "UNLESS age is not between 3 and 5",
        "UNLESS Age is under 6",
        "UNLESS it is not day",
        "UNLESS it is not only night",
    ],
)
def test_what_is_not_certain_stays_a_name(part: str) -> None:
    printed = print_ruleset(parse(whole(part)))
    assert part in printed


@pytest.mark.parametrize(
    "text",
    [
        "CONDITION it is night, it is not night\n\nWHEN a THEN x\nUNLESS it is not night\n",
        "OBLIGATION never mind\n\nWHEN a THEN never mind\n",
        "EVENT a, do not disturb\n\nWHEN a THEN do not disturb\n",
        "MEASURE age: number\n\nCONDITION age is under 6\n\nWHEN a THEN x\nUNLESS age is under 6\n",
        "MEASURE age: number\n\nWHEN age is under 6 THEN x\n\nWHEN b THEN y\nUNLESS age is under 6\n",
        "WHEN it is not night THEN it is night\n",
        "EXCLUSIVE must leave, stay\n\nWHEN a THEN must leave AND stay\n",
        "NEVER must leave AND stay\n\nWHEN a THEN must leave AND stay\n",
        "WHEN a THEN must leave\n\nWHEN must leave THEN close the door\n",
        "RELATION must leave EXCLUDES stay\n\nWHEN a THEN must leave\n",
        "RELATION stay EXCLUDES never mind\n\nWHEN a THEN never mind WITHIN 5 minutes AND stay\n",
        "CONCERN c EXISTS never mind\n\nWHEN a THEN never mind WITHIN 5 minutes\n",
    ],
)
def test_what_is_a_name_outside_responses_stays_a_name(text: str) -> None:
    assert print_ruleset(parse(text)) == text


@pytest.mark.parametrize(
    ("part", "message"),
    [
        ("THEN must", "no obligation follows `must`"),
        ("THEN must NEVER leave", "no obligation follows `must`"),
        ("THEN do not", "no obligation follows `do not`"),
        ("THEN must not fail to", "no obligation follows `must not fail to`"),
        ("UNLESS danger is hihg", "`hihg` is not a value of `danger`"),
        ("UNLESS danger is above 3", "`danger` is a scale and `3` is a number"),
        ("UNLESS age is under 1,5", "unexpected comma in the number `1,5`"),
    ],
)
def test_half_a_form_is_an_error(part: str, message: str) -> None:
    with pytest.raises(LanguageError) as raised:
        parse(whole(part))
    (problem,) = raised.value.problems
    assert problem.message.startswith(message)


@pytest.mark.parametrize("prohibition", [row[0] for row in TABLE if row[1] == "THEN NOT leave"])
@pytest.mark.parametrize("second", ["run", "run WITHIN 5 minutes", "(run AND wave)", "may run", "not run"])
def test_one_modal_verb_for_two_obligations_is_an_error(prohibition: str, second: str) -> None:
    with pytest.raises(LanguageError, match=r"it is unclear whether `.*run` is forbidden, too"):
        parse(whole(f"{prohibition} AND {second}"))


@pytest.mark.parametrize(
    ("part", "canonical"),
    [
        ("THEN must not leave AND NOT run", "THEN NOT leave AND NOT run"),
        ("THEN must not leave AND do not run", "THEN NOT leave AND NOT run"),
        ("THEN must not leave AND (must run AND wave)", "THEN NOT leave AND run AND wave"),
        ("THEN (must not leave) AND run", "THEN NOT leave AND run"),
        ("THEN NOT leave AND run", "THEN NOT leave AND run"),
        ("THEN must leave AND run", "THEN leave AND run"),
    ],
)
def test_each_obligation_has_its_own_form(part: str, canonical: str) -> None:
    assert parse(whole(part)) == parse(whole(canonical))


FORBIDDING = ["must not", "the robot must not", "do not", "don't", "never", "must never", "cannot", "may not"]


@pytest.mark.parametrize("form", FORBIDDING)
@pytest.mark.parametrize("omission", ["fail", "forget", "neglect", "omit"])
def test_what_must_not_be_omitted_is_due(form: str, omission: str) -> None:
    assert parse(whole(f"THEN {form} {omission} to leave")) == parse(whole("THEN leave"))


def test_parentheses_around_an_assumption_change_nothing() -> None:
    for written in ("(age is never below 3)", "((the age is never below 3))"):
        assert parse(whole(f"ASSUME {written}")) == parse(whole("ASSUME age >= 3"))
    for unclear in ("NOT (age is never below 3)", "(age is never below 3) AND c"):
        ruleset = parse(whole(f"ASSUME {unclear}"))
        assert parse(print_ruleset(ruleset)) == ruleset
        assert "age is never below 3" in print_ruleset(ruleset)


def test_the_spans_are_those_of_the_words() -> None:
    text = whole(
        "UNLESS b AND the age is between 3 and 5 AND it isn\u2019t night IN WHICH CASE the robot must not leave"
    )
    (hedge,) = parse(text).rules[0].hedges
    assert isinstance(hedge.condition, And)
    assert [str(text[part.span.start : part.span.end]) for part in hedge.condition.operands] == [
        "b",
        "age is between 3 and 5",
        "it isn\u2019t night",
    ]
    (obligation,) = hedge.obligations
    assert text[obligation.span.start : obligation.span.end] == "the robot must not leave"


# Negations ----------------------------------------------------------------------------------------------------


def with_conditions(positive: str, other: str) -> str:
    return f"WHEN a THEN x\nUNLESS {positive}\n\nWHEN b THEN y\nUNLESS {other}\n"


@pytest.mark.parametrize(("positive", "negative"), CERTAIN)
def test_a_negated_main_verb_denies_the_condition(positive: str, negative: str) -> None:
    text = with_conditions(positive, negative)
    assert print_ruleset(parse(text)) == with_conditions(positive, f"NOT {positive}")


@pytest.mark.parametrize(("positive", "negative"), UNCERTAIN)
def test_another_negation_stays_a_name(positive: str, negative: str) -> None:
    text = with_conditions(positive, negative)
    assert print_ruleset(parse(text)) == text


# Random texts -------------------------------------------------------------------------------------------------

WORDED = st.sampled_from([row for row in TABLE if row[0].startswith("UNLESS")]).map(
    lambda row: (row[0].removeprefix("UNLESS "), f"({row[1].removeprefix('UNLESS ')})")
)
NEGATED = st.sampled_from(CERTAIN).map(lambda pair: (pair[1], f"(NOT {pair[0]})"))
DECLARED = ", ".join(dict.fromkeys(["c", "the user is asleep", *(positive for positive, _ in CERTAIN)]))
CONDITIONS = st.recursive(
    st.one_of(WORDED, NEGATED, st.sampled_from(["c", "the user is asleep"]).map(lambda name: (name, name))),
    lambda inner: st.one_of(
        inner.map(lambda pair: (f"NOT ({pair[0]})", f"NOT ({pair[1]})")),
        st.tuples(inner, st.sampled_from(["AND", "OR"]), inner).map(
            lambda three: tuple(f"({left}) {three[1]} ({right})" for left, right in zip(three[0], three[2]))
        ),
    ),
    max_leaves=4,
)
RESPONSES = st.lists(
    st.sampled_from([row for row in TABLE if row[0].startswith("THEN")]).map(
        lambda row: tuple(part.removeprefix("THEN ") for part in row)
    ),
    min_size=1,
    max_size=3,
).map(lambda pairs: tuple(" AND ".join(parts) for parts in zip(*pairs)))


@given(responses=st.tuples(RESPONSES, RESPONSES), conditions=st.tuples(CONDITIONS, CONDITIONS))
def test_random_texts_with_forms_mean_their_canonical_text(responses, conditions) -> None:
    texts = []
    for side in (0, 1):
        (default, response), (guard, condition) = ([pair[side] for pair in part] for part in (responses, conditions))
        rule = f"WHEN a AND ({guard}) THEN {default}\nUNLESS {condition} IN WHICH CASE ({response})\n"
        texts.append(f"{DECLARATIONS}CONDITION {DECLARED}\n{rule}")
    written, canonical = map(parse, texts)
    assert written == canonical
    printed = print_ruleset(written)
    assert parse(printed) == written
    assert print_ruleset(parse(printed)) == printed
