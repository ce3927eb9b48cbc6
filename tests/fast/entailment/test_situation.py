"""Situations as people type them. What does not fit is in documents/bad/situation.txt."""

from __future__ import annotations

from fractions import Fraction

import pytest

from sleec_runtime.language import parse
from sleec_runtime.model import Measure, Value
from sleec_verify.entailment.situation_text import SituationError, parse_situation

RULES = parse("""\
MEASURE Risk: low < high
MEASURE Age: number
CONSTANT LegalAge = 18
WHEN Rung THEN Open
UNLESS Night OR the room is too warm IN WHICH CASE Ask
UNLESS (Night OR the room is too warm) AND Risk > low AND Age < LegalAge IN WHICH CASE Wake
WHEN the dog barks THEN Ask
""")


@pytest.mark.parametrize(
    ("given", "values"),
    [
        ("", {}),
        (" , ", {}),
        ("Night", {"Night": True}),
        ("not Night", {"Night": False}),
        ("NOT  Night", {"Night": False}),
        ("Night=false", {"Night": False}),
        ("Night = TRUE", {"Night": True}),
        ("the room is too warm", {"the room is too warm": True}),
        ("not the  room is too warm", {"the room is too warm": False}),
        ("Age=15", {"Age": 15}),
        ("Age = 36.6", {"Age": Fraction(366, 10)}),
        ("Age=-0.10", {"Age": Fraction(-1, 10)}),
        ("Age=15.0", {"Age": 15}),
        ("Age=LegalAge", {"Age": 18}),
        ("Age==15, Risk == high, Night==false", {"Age": 15, "Risk": "high", "Night": False}),
        ("Risk=high,Night , Age=1", {"Risk": "high", "Night": True, "Age": 1}),
        ("Night, Night", {"Night": True}),
    ],
)
def test_facts(given: str, values: dict[str, Value]) -> None:
    context = parse_situation(RULES, "Rung", given)
    assert dict(context.conditions) == values
    assert all(type(context.conditions[name]) is type(value) for name, value in values.items())


@pytest.mark.parametrize(
    ("when", "triggers"),
    [("", set()), ("Rung", {"Rung"}), ("the  dog barks, Rung,", {"Rung", "the dog barks"})],
)
def test_triggers(when: str, triggers: set[str]) -> None:
    assert parse_situation(RULES, when, "").triggers == triggers


def test_whole_numbers() -> None:
    whole = parse("MEASURE Age: number\nWHEN a AND Age > 1 THEN b")
    (measure, *rest) = whole.statements
    assert isinstance(measure, Measure)
    from dataclasses import replace

    whole = replace(whole, statements=(replace(measure, kind="integer"), *rest))
    assert parse_situation(whole, "a", "Age=2.0").conditions == {"Age": 2}
    with pytest.raises(SituationError, match="whole number"):
        parse_situation(whole, "a", "Age=2.5")


def test_ruleset_without_conditions() -> None:
    with pytest.raises(SituationError) as raised:
        parse_situation(parse("WHEN a THEN b"), "a", "c")
    assert raised.value.hint == "the ruleset has no condition or measure"


def test_digits_without_end_are_refused() -> None:
    with pytest.raises(SituationError):
        parse_situation(RULES, "Rung", "Age=" + "9" * 10_000)


@pytest.mark.parametrize(
    ("when", "given"),
    [
        ("{}", ""),
        ("Rung", "{}"),
        ("Rung", "not {}"),
        ("Rung", "{}=5"),
        ("Rung", "Night={}"),
        ("Rung", "Risk={}"),
        ("Rung", "Age={}"),
        ("Rung", "={}"),
        ("Rung", "Age<{}"),
        ("Rung", "not Night={}"),
    ],
)
def test_what_was_typed_is_cut_in_messages(when: str, given: str) -> None:
    with pytest.raises(SituationError) as raised:
        parse_situation(RULES, when.format("x" * 20_000), given.format("x" * 20_000))
    assert "..." in str(raised.value)
    assert len(str(raised.value)) < 200
