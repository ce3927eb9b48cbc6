"""Conditions that are always true, or always false, whatever the situation."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from sleec_runtime.model import (
    And,
    Atom,
    Calculated,
    Comparison,
    Formula,
    MeasureRef,
    Not,
    Or,
    Ruleset,
    ScaleValue,
    Truth,
    formulas_of,
    measures_of,
)
from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.checks.names import formulas_beside_rules
from sleec_verify.cone import Cones
from sleec_verify.finding import Finding
from sleec_verify.question import Question


def _constant(cones: Cones) -> Iterator[Finding]:
    """For each part of a condition: unsatisfiable exactly when it is always false, and its negation when it is always
    true. A model is a situation in which it is not."""
    ruleset = cones.ruleset
    changing: set[Formula] = set()
    for rule in ruleset.rules:
        for condition in formulas_of(rule):
            yield from _in_condition(cones, condition, (rule.label,), changing)
    for condition in formulas_beside_rules(ruleset):
        yield from _in_condition(cones, condition, (), changing)


def _in_condition(
    cones: Cones, condition: Formula, labels: tuple[str, ...], changing: set[Formula]
) -> Iterator[Finding]:
    """The smallest parts of a condition that are constant. `changing` are conditions that have none, and grows."""
    if not _may_be_constant(condition) or condition in changing:
        return
    parts = list(_parts(condition))
    always = _always(cones, parts)
    if labels and always[-1] is False:
        # The whole condition of a guard or hedge: that it is dead says so already, and what follows from it.
        return
    constant = {id(part): value for part, value in zip(parts, always) if value is not None}
    for part in parts:
        if id(part) not in constant or any(id(inner) in constant for inner in _operands(part)):
            continue
        if _is_defect(part, cones.ruleset):
            continue
        what = "this condition" if part is condition else "this part of a condition"
        yield CONSTANT_CONDITION.finding(
            f"{what} is always {'true' if constant[id(part)] else 'false'}",
            part.span,
            rules=labels,
            help="mend it, or leave it out",
        )
    if not constant:
        changing.add(condition)


def _parts(formula: Formula) -> Iterator[Formula]:
    """A formula and the formulas in it, the inner ones first."""
    for operand in _operands(formula):
        yield from _parts(operand)
    yield formula


def _operands(formula: Formula) -> tuple[Formula, ...]:
    if isinstance(formula, Not):
        return (formula.operand,)
    return formula.operands if isinstance(formula, (And, Or)) else ()


def _always(cones: Cones, parts: Sequence[Formula]) -> list[bool | None]:
    """What each formula always is, assumptions left aside; None if it may be either."""
    with Question(cones, assuming=False) as question:
        literals = [question.encoder.literal(part) for part in parts]
        can_be = [(question.ask(literal), question.ask(-literal)) for literal in literals]
    return [None if true and false else true for true, false in can_be]


def _may_be_constant(formula: Formula) -> bool:
    """False only if no part of the formula is constant: each of its names stands in it once, and a number
    that is not calculated can lie on either side of any other. Most conditions are so, and need no solver."""
    seen: set[str] = set()
    for part in _parts(formula):
        names: tuple[str, ...] = ()
        if isinstance(part, Atom):
            names = (part.name,)
        elif isinstance(part, Comparison):
            if isinstance(part.left, (Calculated, ScaleValue)) or isinstance(part.right, ScaleValue):
                return True
            names = measures_of(part)
        elif isinstance(part, Truth):
            return True
        for name in names:
            if name in seen:
                return True
            seen.add(name)
    return False


def _is_defect(part: Formula, ruleset: Ruleset) -> bool:
    """Whether it is constant because it compares a scale with what has no place in it, which is reported as such."""
    if not isinstance(part, Comparison):
        return False
    measure, value = (part.left, part.right) if isinstance(part.left, MeasureRef) else (part.right, part.left)
    if not isinstance(measure, MeasureRef) or not isinstance(value, ScaleValue):
        return False
    return not 0 <= value.rank < len(ruleset.measures[measure.name].values)


CONSTANT_CONDITION = Check(
    "constant-condition",
    "Does every part of a condition depend on the situation?",
    (
        FindingKind(
            "SLEEC512",
            "warning",
            "a condition, or a part of one, that never changes",
            "Whatever the situation, this part of a condition is true, or it is false: it decides nothing. Mostly a "
            "bound is off by one, or AND and OR are mixed up. Guards and hedges whose whole condition is never true "
            "are dead rules and dead hedges, and reported as these.",
            "Compare the bounds with what you want to say, and look whether AND should be OR. If all is as it should "
            "be, leave the part out.",
            "MEASURE Heat: number\nWHEN UserCalls THEN Answer\nUNLESS Heat > 30 OR Heat < 40 IN WHICH CASE Cool\n",
            "MEASURE Heat: number\nWHEN UserCalls THEN Answer\nUNLESS Heat > 40 OR Heat < 0 IN WHICH CASE Cool\n",
        ),
    ),
    _constant,
    scope="text",
)
