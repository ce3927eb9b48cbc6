"""What random rulesets are made of: names of every shape that the language has, and formulas over them."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import strategies as st

from sleec_runtime.model import (
    And,
    Atom,
    Comparison,
    Constant,
    Formula,
    Measure,
    MeasureRef,
    Not,
    Number,
    Operator,
    Or,
    ScaleValue,
    Statement,
    Truth,
)

TRIGGERS = ("Call", "Alarm", "the user falls", "Meal", "Knock", "Dusk", "room 12 rings", "Visit")
CONDITIONS = ("Asleep", "Undressed", "the room is too warm", "Alone", "Ill", "Busy", "not well", "Deaf")
OBLIGATIONS = ("Help", "Wait", "open the curtains", "Warn", "Leave", "Log", "tell the nurse", "Close")
BOTH = ("Nurse", "ring the bell")
"""Names that are triggers and obligations: what one rule obliges sets off another."""

EXOTIC = (
    "Größe",
    "x-ray",
    "O'Brien",
    "patients'",
    "_hidden",
    "Ñandú",
    "λ",
    "C3",
    "名前",
    "être au lit",
    "the 2nd floor",
)
"""Names at the edge of what a name may be; used as conditions where `exotic` is set."""

NUMBERS = ("Age", "Temperature", "the noise level")
INTEGERS = ("Attempts", "Visitors")
SCALES = ("Risk", "Pain", "Trust")
SCALE_VALUES = (("low", "middle", "high"), ("never", "sometimes"), ("low", "high", "very high", "worst"))
DOMAINS = ("hospital", "household", "the day ward")
_OPERATORS: tuple[Operator, ...] = ("<", "<=", "=", "!=", ">=", ">")
VALUES: tuple[int | Fraction, ...] = (0, 1, 2, 18, -3, Fraction(73, 2), Fraction(-1, 4), Fraction(1, 1000), 10**20)


class Vocabulary:
    """The names that one ruleset draws from, and what is known of them."""

    def __init__(self, size: int, overlap: bool, exotic: bool) -> None:
        both = BOTH[: (size + 2) // 3] if overlap else ()
        self.triggers = TRIGGERS[:size] + both
        self.obligations = OBLIGATIONS[:size] + both
        self.conditions = CONDITIONS[:size] + (EXOTIC if exotic else ())
        self.measures: dict[str, Measure] = {}
        self.constants: dict[str, Constant] = {}


def formulas(leaf: st.SearchStrategy[Formula], max_depth: int = 2) -> st.SearchStrategy[Formula]:
    """Formulas over `leaf`, up to `max_depth` operators deep."""
    if max_depth == 0:
        return leaf
    smaller = formulas(leaf, max_depth - 1)
    several = st.lists(smaller, min_size=2, max_size=3).map(tuple)
    return st.one_of(leaf, leaf, st.builds(Not, smaller), st.builds(And, several), st.builds(Or, several))


def leaves_over(known: Vocabulary) -> st.SearchStrategy[Formula]:
    atoms = st.builds(Atom, st.just("condition"), st.sampled_from(known.conditions))
    if not known.measures:
        return atoms
    return st.one_of(atoms, atoms, _comparisons(known), st.builds(Truth, st.booleans()))


@st.composite
def _comparisons(draw: st.DrawFn, known: Vocabulary) -> Comparison:
    measure = known.measures[draw(st.sampled_from(sorted(known.measures)))]
    left = MeasureRef(measure.name)
    twins = [other.name for other in known.measures.values() if other.values == measure.values]
    right: MeasureRef | ScaleValue | Number
    if draw(st.integers(0, 4)) == 0:
        right = MeasureRef(draw(st.sampled_from(twins)))
    elif measure.kind == "scale":
        rank = draw(st.integers(0, len(measure.values) - 1))
        right = ScaleValue(measure.values[rank], rank)
    else:
        constants = [Number(constant.value, constant.name) for constant in known.constants.values()]
        right = draw(st.sampled_from([*map(Number, VALUES), *constants, *constants]))
    sides = (right, left) if draw(st.booleans()) else (left, right)
    return Comparison(sides[0], draw(st.sampled_from(_OPERATORS)), sides[1])


@st.composite
def measures_and_constants(draw: st.DrawFn, known: Vocabulary) -> list[Statement]:
    statements: list[Statement] = []
    for name in draw(st.lists(st.sampled_from(NUMBERS + INTEGERS + SCALES), max_size=4, unique=True)):
        if name in SCALES:
            measure = Measure(name, "scale", draw(st.sampled_from(SCALE_VALUES)))
        elif name in INTEGERS:
            measure = Measure(name, "integer")
        else:
            # Only a number may be left undeclared.
            measure = Measure(name, "number", declared=draw(st.booleans()))
        known.measures[name] = measure
        if measure.declared:
            statements.append(measure)
    if draw(st.booleans()):
        adult = Constant("Adult", draw(st.sampled_from(VALUES)))
        legal = Constant("LegalAge", adult.value, alias="Adult")
        for constant in (legal, adult)[draw(st.integers(0, 1)) :]:
            known.constants[constant.name] = constant
            statements.append(constant)
    return statements
