"""The conditions and measures of one instant as variables of a circuit."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from fractions import Fraction
from itertools import pairwise
from math import ceil, floor

from sleec_runtime.model import (
    And,
    Atom,
    Calculation,
    Clause,
    Comparison,
    Formula,
    Measure,
    MeasureRef,
    Not,
    Number,
    Or,
    Rational,
    Reading,
    Rule,
    ScaleValue,
    Truth,
    Value,
    leaves,
)
from sleec_verify.encoding.calculations import named
from sleec_verify.encoding.solver import Undecided
from sleec_verify.games.circuit import FALSE, TRUE, Circuit
from sleec_verify.wording.sentence import sentence

_FLIPPED = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "=": "=", "!=": "!="}


class Scales:
    """Representative values, in order, for each measure: one for each region that some formulas distinguish."""

    def __init__(self, measures: Mapping[str, Measure], formulas: Iterable[Formula]) -> None:
        """Raises `Undecided` if two measures are compared, or used in one calculation."""
        self.conditions: set[str] = set()
        cuts: dict[str, set[Rational]] = {}
        for formula in formulas:
            for leaf in leaves(formula):
                if isinstance(leaf, Comparison):
                    measure, _, other = sides(leaf)
                    cuts.setdefault(measure, set()).add(other)
                elif leaf.kind == "condition":
                    self.conditions.add(leaf.name)
        self.standing = {name: _standing(measures[name], sorted(found)) for name, found in sorted(cuts.items())}
        self._measures = measures

    def value(self, measure: str, place: int) -> Value:
        """The value at a position, as the text writes it."""
        standing = self.standing[measure][place]
        if self._measures[measure].kind == "scale":
            assert isinstance(standing, int), "the values of a scale are numbered"
            return self._measures[measure].values[standing]
        return standing


def _standing(measure: Measure, cuts: Sequence[Rational]) -> list[Rational]:
    """Values of a measure, one in every region between the bounds."""
    if measure.kind == "scale":
        return list(range(len(measure.values)))
    if measure.kind == "integer":
        found = {ceil(cuts[0]) - 1, *(floor(cut) + 1 for cut in cuts), *(c for c in cuts if c == floor(c))}
        return sorted(found)
    between = [_whole(Fraction(a + b) / 2) for a, b in pairwise(cuts)]
    return sorted({cuts[0] - 1, *cuts, *between, cuts[-1] + 1})


def _whole(value: Fraction) -> Rational:
    return int(value) if value.denominator == 1 else value


def sides(comparison: Comparison) -> tuple[str, str, Rational]:
    """A comparison as measure, operator and number. A value of a scale is represented by its rank.

    Raises `Undecided` if two measures are compared, or used in one calculation.
    """
    left, operator, right = comparison.left, str(comparison.operator), comparison.right
    if isinstance(left, Calculation):
        raise Undecided(sentence("games with calculations are not supported: {calculation}", calculation=named([left])))
    if not isinstance(left, MeasureRef):
        left, right, operator = right, left, _FLIPPED[operator]
    if isinstance(right, MeasureRef):
        raise Undecided(sentence("games with comparisons of two measures are not supported"))
    assert isinstance(left, MeasureRef), "one side of a comparison is a measure"
    assert isinstance(right, (Number, ScaleValue)), "a calculation stands on the left"
    return left.name, operator, right.value if isinstance(right, Number) else right.rank


class Values:
    """The values at one instant, determined by `variables`."""

    def __init__(self, circuit: Circuit, scales: Scales, event: Callable[[str], int]) -> None:
        """`event` returns the literal of an event at this instant, for formulas that name events."""
        self._circuit = circuit
        self._scales = scales
        self._event = event
        self.conditions = {name: circuit.variable() for name in sorted(scales.conditions)}
        self._raw = {name: circuit.variables(len(places) - 1) for name, places in scales.standing.items()}
        self._at_most: dict[str, list[int]] = {}
        for name, raw in self._raw.items():
            # The first true variable is the place; none of them, the last place. So every assignment is a value.
            so_far, found = FALSE, []
            for variable in raw:
                so_far = circuit.either(so_far, variable)
                found.append(so_far)
            self._at_most[name] = [*found, TRUE]

    @property
    def variables(self) -> list[int]:
        return [*self.conditions.values(), *(variable for raw in self._raw.values() for variable in raw)]

    def decoded(self, move: Mapping[int, int]) -> dict[str, Value]:
        """The values in a move."""
        found: dict[str, Value] = {name: move[variable] > 0 for name, variable in self.conditions.items()}
        for name, raw in self._raw.items():
            place = next((i for i, variable in enumerate(raw) if move[variable] > 0), len(raw))
            found[name] = self._scales.value(name, place)
        return found

    def literal(self, formula: Formula | None) -> int:
        """A literal that is equivalent to a formula at this instant; true for None."""
        if formula is None:
            return TRUE
        if isinstance(formula, Truth):
            return TRUE if formula.value else FALSE
        if isinstance(formula, Not):
            return -self.literal(formula.operand)
        if isinstance(formula, And):
            return self._circuit.every(map(self.literal, formula.operands))
        if isinstance(formula, Or):
            return self._circuit.some(map(self.literal, formula.operands))
        if isinstance(formula, Atom):
            return self.conditions[formula.name] if formula.kind == "condition" else self._event(formula.name)
        return self._comparison(*sides(formula))

    def _comparison(self, measure: str, operator: str, number: Rational) -> int:
        standing, at_most = self._scales.standing[measure], self._at_most[measure]

        def up_to(count: int) -> int:
            return at_most[count - 1] if count else FALSE

        less = up_to(sum(value < number for value in standing))
        not_more = up_to(sum(value <= number for value in standing))
        return {
            "<": less,
            "<=": not_more,
            ">": -not_more,
            ">=": -less,
            "=": self._circuit.both(not_more, -less),
            "!=": -self._circuit.both(not_more, -less),
        }[operator]

    # Which clause decides -------------------------------------------------------------------------------------

    def guards(self, rule: Rule, triggered: int, reading: Reading) -> list[int]:
        """For each clause of a rule, in the order of the text, a literal that is equivalent to "it decides"."""
        active = self._circuit.both(triggered, self.literal(rule.guard))
        return self._members(active, rule.default, rule.hedges, reading)

    def chain(self, clause: Clause, reading: Reading) -> list[int]:
        """The same for a separate chain."""
        return self._inside(TRUE, clause, reading)

    def _inside(self, active: int, clause: Clause, reading: Reading) -> list[int]:
        first, *nested = self._split(active, clause.hedges, reading)
        found = [first]
        for hedge, decides in zip(clause.hedges, nested):
            found += self._inside(decides, hedge, reading)
        return found

    def _members(self, active: int, default: Clause, hedges: Sequence[Clause], reading: Reading) -> list[int]:
        found: list[int] = []
        for member, decides in zip((default, *hedges), self._split(active, hedges, reading)):
            found += self._inside(decides, member, reading)
        return found

    def _split(self, active: int, hedges: Sequence[Clause], reading: Reading) -> list[int]:
        """Which clause of a chain decides, the default first."""
        both = self._circuit.both
        conditions = [self.literal(hedge.condition) for hedge in hedges]
        decides = [active]
        if reading == "priority":
            for condition in conditions:
                decides = [both(literal, -condition) for literal in decides]
                decides.append(both(active, condition))
            return decides
        for condition in conditions:
            prefix = decides[-1]
            decides[-1] = both(prefix, -condition)
            decides.append(both(prefix, condition))
        return decides
