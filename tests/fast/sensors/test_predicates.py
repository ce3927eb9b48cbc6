"""Sensor values made crisp, exactly at the borders."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import pytest

from sleec_runtime import Sensors, Sleec
from sleec_runtime.errors import SleecError, UnknownCondition, WrongType
from sleec_runtime.language import parse
from sleec_runtime.predicates import Direct, Fuzzy, Predicate, Scale, Threshold, UnknownSensor, trapezoid, triangle
from tests.support.robots import running

RULES = """
MEASURE Risk: low < moderate < severe
MEASURE Temperature: number
RULE r WHEN a THEN o UNLESS Fever IN WHICH CASE p UNLESS Warm AND Risk > low AND Temperature > 1 IN WHICH CASE q
"""


@pytest.fixture
def sleec() -> Sleec:
    return running(RULES)


@pytest.mark.parametrize(
    ("predicate", "readings"),
    [
        (Threshold("Fever", "s", at_least=38), {37.9: False, 37.999999999: False, 38: True, 38.5: True, 40: True}),
        (Threshold("Fever", "s", at_most=35.5), {35.5: True, 35.500001: False, -3: True}),
        (Threshold("Fever", "s", at_least=0.1, at_most=0.3), {0.1: True, 0.3: True, 0.1 + 0.2: False, 0: False}),
        (Scale("Risk", "s", [0.3, 0.7]), {0: "low", 0.29: "low", 0.3: "moderate", 0.7: "severe", 5: "severe"}),
        (Fuzzy("Warm", "s", triangle(18, 22, 26)), {18: False, 19.9: False, 20: True, 22: True, 24: True, 24.1: False}),
        (
            Fuzzy("Warm", "s", trapezoid(18, 22, 24, 34), cut=0.9),
            {21.5: False, 21.6: True, 25: True, 25.1: False, 40: False},
        ),
        (Fuzzy("Warm", "s", trapezoid(18, 18, 24, 24), cut=1), {17.9: False, 18: True, 24: True, 24.1: False}),
        (Fuzzy("Warm", "s", lambda value: float(value) / 10), {4.9: False, 5: True}),
        (Direct("Temperature", "s"), {36.6: Fraction(183, 5), 3: 3}),
    ],
)
def test_a_predicate_on_both_sides_of_its_borders(sleec: Sleec, predicate: Predicate, readings: dict[Any, Any]) -> None:
    sensors = Sensors(sleec, predicate)
    for reading, expected in readings.items():
        assert sensors.crisp({"s": reading}) == {predicate.condition: expected}


def test_one_reading_is_one_change_of_all_that_follows_from_it(sleec: Sleec) -> None:
    sensors = Sensors(
        sleec,
        Threshold("Fever", "thermometer", at_least=38),
        Direct("Temperature", "thermometer"),
        Scale("Risk", "radar", [1, 2]),
    )
    told: list[int] = []
    sleec.listen(lambda before, after, rules: told.append(after.number))
    sensors.update({"thermometer": 38.5, "radar": 1.5})
    assert dict(sleec.conditions) == {"Fever": True, "Temperature": Fraction(77, 2), "Risk": "moderate"}
    sensors.update({"thermometer": None})
    assert dict(sleec.conditions) == {"Risk": "moderate"}
    assert told == [1, 2]
    with pytest.raises(UnknownSensor, match="did you mean `thermometer`"):
        sensors.update({"radar": 5, "termometer": 3})
    with pytest.raises(WrongType, match="a sensor value"):
        sensors.update({"radar": "far"})
    assert dict(sleec.conditions) == {"Risk": "moderate"}


@pytest.mark.parametrize(
    ("predicates", "words"),
    [
        ([Threshold("Risk", "s", at_least=1)], "is a measure"),
        ([Fuzzy("Risk", "s", triangle(1, 2, 3))], "is a measure"),
        ([Fuzzy("Warm", "s", triangle(1, 2, 3), cut=0)], "give a number above 0"),
        ([Fuzzy("Warm", "s", triangle(1, 2, 3), cut=1.5)], "at most 1"),
        ([Scale("Fever", "s", [1, 2])], "has no scale"),
        ([Scale("Risk", "s", [1])], "give 2 increasing cuts"),
        ([Scale("Risk", "s", [2, 1])], "give 2 increasing cuts"),
        ([Scale("Risk", "s", [1, 1])], "give 2 increasing cuts"),
        ([Direct("Fever", "s")], "is not a number"),
        ([Direct("Risk", "s")], "is not a number"),
        ([Direct("Temperature", "s"), Direct("Temperature", "t")], "two predicates set"),
    ],
)
def test_a_predicate_must_fit_what_it_decides(sleec: Sleec, predicates: list[Predicate], words: str) -> None:
    with pytest.raises(SleecError) as refusal:
        Sensors(sleec, *predicates)
    assert words in str(refusal.value)


def test_a_predicate_of_a_condition_that_is_gone_is_refused(sleec: Sleec) -> None:
    sensors = Sensors(sleec, Scale("Risk", "radar", [1, 2]))
    sleec.replace(parse("RULE r WHEN a THEN o"))
    with pytest.raises(UnknownCondition, match="replaced"):
        sensors.update({"radar": 1})


def test_what_predicates_are_made_of_is_checked(sleec: Sleec) -> None:
    with pytest.raises(UnknownCondition, match="did you mean `Fever`"):
        Sensors(sleec, Threshold("Fevr", "s", at_least=1))
    with pytest.raises(SleecError, match="no bound"):
        Threshold("Fever", "s")
    with pytest.raises(WrongType):
        Threshold("Fever", "s", at_least="38")
    with pytest.raises(SleecError, match="increasing order"):
        trapezoid(1, 3, 2, 4)
    with pytest.raises(WrongType):
        triangle(1, None, 3)
