"""Predicates over sensors: thresholds, scales, and fuzzy membership with a cut.

SLEEC rules are over propositions, "applied to fuzzy contexts by instantiating fuzzy predicates to crisp values at
evaluation time" (paper, Section 2.1). A predicate computes one condition or measure from one sensor. The arithmetic is
exact, so that a value at a bound is always on the same side of it.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Union

from sleec_runtime.errors import SleecError, UnknownCondition, UnknownName, WrongType
from sleec_runtime.model import NUMBER, exact

if TYPE_CHECKING:
    from sleec_runtime.facade.sleec import Sleec
    from sleec_runtime.model import Measure, Rational, Value

Membership = Callable[["Rational"], object]
"""The degree of membership of a value in a fuzzy set, from 0 to 1."""


class UnknownSensor(UnknownName):
    """A sensor without a predicate."""

    kind = "sensor"
    holder = "Sensors(…)"


@dataclass(frozen=True)
class Threshold:
    """`condition` is true if the sensor is at least `at_least` and at most `at_most`. One of the bounds may be
    missing."""

    condition: str
    sensor: str
    at_least: object = None
    at_most: object = None

    def __post_init__(self) -> None:
        if self.at_least is None and self.at_most is None:
            raise SleecError(f"the threshold of `{self.condition}` has no bound", "give at_least, at_most, or both")
        for bound in (self.at_least, self.at_most):
            if bound is not None:
                _number(self.condition, bound, "a bound")
        if self.at_least is not None and self.at_most is not None:
            low, high = (_number(self.condition, bound, "a bound") for bound in (self.at_least, self.at_most))
            if low > high:
                raise SleecError(
                    f"the threshold of `{self.condition}` cannot be reached: at least {low} and at most {high}",
                    "give an at_least that is at most at_most",
                )

    def crisp(self, reading: Rational, measure: Measure | None) -> Value:
        above = self.at_least is None or reading >= _number(self.condition, self.at_least, "a bound")
        return above and (self.at_most is None or reading <= _number(self.condition, self.at_most, "a bound"))

    def check(self, measure: Measure | None) -> None:
        _condition_only(self.condition, measure)


@dataclass(frozen=True)
class Scale:
    """`condition` is a measure on a scale. `cuts` are the sensor values at which its second, third, … value begins."""

    condition: str
    sensor: str
    cuts: Sequence[object]

    def crisp(self, reading: Rational, measure: Measure | None) -> Value:
        assert measure is not None, "checked when it was declared"
        return measure.values[bisect_right([_number(self.condition, cut, "a cut") for cut in self.cuts], reading)]

    def check(self, measure: Measure | None) -> None:
        if measure is None or measure.kind != "scale":
            raise SleecError(f"`{self.condition}` has no scale", f"declare it: MEASURE {self.condition}: low < high")
        if isinstance(self.cuts, str) or not isinstance(self.cuts, Sequence):
            raise WrongType(self.condition, self.cuts, "given cuts, a list of numbers", "give a list: [0.3, 0.7]")
        cuts = [_number(self.condition, cut, "a cut") for cut in self.cuts]
        if len(cuts) != len(measure.values) - 1 or cuts != sorted(set(cuts)):
            raise SleecError(
                f"`{self.condition}` has the values {', '.join(measure.values)}",
                f"give {len(measure.values) - 1} increasing cuts, one between each two values",
            )


@dataclass(frozen=True)
class Fuzzy:
    """`condition` is true if the membership of the sensor value is at least `cut`."""

    condition: str
    sensor: str
    membership: Membership
    cut: object = 0.5

    def crisp(self, reading: Rational, measure: Measure | None) -> Value:
        membership = _number(self.condition, self.membership(reading), "a membership")
        if not 0 <= membership <= 1:
            raise WrongType(self.condition, membership, "given a membership, from 0 to 1", "fix its function")
        return membership >= _number(self.condition, self.cut, "a cut")

    def check(self, measure: Measure | None) -> None:
        _condition_only(self.condition, measure)
        if not callable(self.membership):
            raise WrongType(
                self.condition, self.membership, "given a membership function", "give a trapezoid(…) or a function"
            )
        if not 0 < _number(self.condition, self.cut, "a cut") <= 1:
            raise SleecError(f"the cut of `{self.condition}` is {self.cut}", "give a number above 0 and at most 1")


@dataclass(frozen=True)
class Direct:
    """`condition` is a measure that takes the value of the sensor."""

    condition: str
    sensor: str

    def crisp(self, reading: Rational, measure: Measure | None) -> Value:
        return reading

    def check(self, measure: Measure | None) -> None:
        if measure is None or measure.kind == "scale":
            raise SleecError(f"`{self.condition}` is not a number", "give a Threshold, a Scale or a Fuzzy predicate")


Predicate = Union[Threshold, Scale, Fuzzy, Direct]


def trapezoid(foot: object, top: object, end_of_top: object, end: object) -> Membership:
    """Membership that rises from `foot` to `top`, is 1 up to `end_of_top`, and falls to 0 at `end`.

    Raises SleecError unless these are numbers in increasing order.
    """
    corners = [_number("a trapezoid", corner, "a corner") for corner in (foot, top, end_of_top, end)]
    if corners != sorted(corners):
        raise SleecError(
            f"the corners {', '.join(map(str, corners))} are not in order", "give them in increasing order"
        )
    a, b, c, d = corners

    def membership(value: Rational) -> object:
        from fractions import Fraction

        if b <= value <= c:
            return 1
        if value <= a or value >= d:
            return 0
        return Fraction(value - a) / (b - a) if value < b else Fraction(d - value) / (d - c)

    return membership


def triangle(foot: object, top: object, end: object) -> Membership:
    """Membership that rises from `foot` to `top` and falls until `end`."""
    return trapezoid(foot, top, top, end)


class Sensors:
    """The predicates of an instance. They turn sensor values into a change of context."""

    def __init__(self, sleec: Sleec, *predicates: Predicate) -> None:
        """Raises UnknownCondition, and SleecError for a predicate that does not fit its condition or measure, or for
        two predicates of the same one."""
        vocabulary = sleec.vocabulary
        self._sleec = sleec
        self._by_sensor: dict[str, list[Predicate]] = {}
        decided: set[str] = set()
        for predicate in predicates:
            if not isinstance(predicate, (Threshold, Scale, Fuzzy, Direct)):
                raise WrongType("the argument", predicate, "a predicate", "give a Threshold, Scale, Fuzzy or Direct")
            for role, name in (("condition", predicate.condition), ("sensor", predicate.sensor)):
                if not isinstance(name, str):
                    raise WrongType(f"the {role} of a predicate", name, "a name, a str", "give its name")
            if predicate.condition not in vocabulary:
                raise UnknownCondition(predicate.condition, vocabulary)
            if predicate.condition in decided:
                raise SleecError(f"two predicates set `{predicate.condition}`", "leave one of them out")
            predicate.check(vocabulary[predicate.condition])
            decided.add(predicate.condition)
            self._by_sensor.setdefault(predicate.sensor, []).append(predicate)

    def crisp(self, readings: Mapping[str, object]) -> dict[str, Value | None]:
        """The conditions and measures for these `readings`. A reading of None makes them unknown.

        O(predicates of these sensors). Raises UnknownSensor, WrongType, and UnknownCondition for a condition that the
        rules no longer have.
        """
        if not isinstance(readings, Mapping):
            raise WrongType("the readings", readings, "a mapping of sensors to values", "give a dict")
        vocabulary = self._sleec.vocabulary
        crisp: dict[str, Value | None] = {}
        for sensor, reading in readings.items():
            if sensor not in self._by_sensor:
                raise UnknownSensor(sensor, self._by_sensor)
            number = None if reading is None else _number(sensor, reading, "a sensor value")
            for predicate in self._by_sensor[sensor]:
                if predicate.condition not in vocabulary:
                    raise UnknownCondition(
                        predicate.condition, vocabulary, "the ruleset was replaced by one without it"
                    )
                measure = vocabulary[predicate.condition]
                crisp[predicate.condition] = None if number is None else predicate.crisp(number, measure)
        return crisp

    def update(self, readings: Mapping[str, object]) -> None:
        """Changes the context atomically, by `readings`. Raises as `crisp`."""
        self._sleec.update(self.crisp(readings))


def _number(name: str, value: object, role: str) -> Rational:
    number = exact(value)
    if number is None:
        raise WrongType(name, value, f"given {role}, {NUMBER}")
    return number


def _condition_only(name: str, measure: Measure | None) -> None:
    if measure is not None:
        raise SleecError(f"`{name}` is a measure, not a condition", "give a Scale or a Direct predicate")
