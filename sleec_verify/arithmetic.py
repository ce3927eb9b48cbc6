"""Values for measures of which calculations are compared with numbers: integer arithmetic, which z3 is asked about.

z3 is an extra. It is loaded when values are first needed that are not found without it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from sleec_runtime.model import Calculated, Rational
from sleec_verify.calculations import named
from sleec_verify.solver import Undecided

RESOURCES = 1_000_000
"""What z3 may spend on one question, in its own measure: about a second, and the same on every machine."""

Compared = tuple[Calculated, Rational, bool, int]
"""A calculation that is at most a number, or below it if not inclusive, and the literal that says so; or, if that is
negative, is not."""


class NotCalculated(Undecided):
    """What a calculation can be is not known. `lines` are where it stands."""

    def __init__(self, message: str, lines: Sequence[int]) -> None:
        super().__init__(message)
        self.lines = tuple(lines)


def unproved(calculations: Iterable[Calculated]) -> NotCalculated:
    """What to raise where an answer is to be proved, and rests on what z3 says of these calculations."""
    calculations = list(calculations)
    return NotCalculated(
        f"the answer rests on what z3 says of {named(calculations)}, which a certificate does not prove",
        [one.line for one in calculations],
    )


def values_for(
    integral: Mapping[str, bool],
    cuts: Sequence[tuple[str, Rational, bool, int]],
    orders: Sequence[tuple[str, str, int]],
    compared: Sequence[Compared],
) -> dict[str, Rational] | list[int]:
    """Values for the measures `integral` that make all the literals true, or some of the literals that no values make
    true together. All but `compared` is as `sleec_verify.order.place` has it.

    Raises NotCalculated where z3 does not decide it, or is not there.
    """
    try:
        import z3
    except ImportError:
        calculations = [one for one, *_ in compared]
        raise NotCalculated(
            f"what {named(calculations)} can be is for z3, which is not installed (pip install 'sleec-verify[z3]')",
            [one.line for one in calculations],
        ) from None
    context = z3.Context()
    solver = z3.Solver(ctx=context)
    solver.set("rlimit", RESOURCES)
    variables = {name: (z3.Int if whole else z3.Real)(name, context) for name, whole in integral.items()}

    def number(value: Rational) -> Any:
        return z3.RealVal(str(value), context) if value.denominator != 1 else z3.IntVal(int(value), context)

    def result(calculated: Calculated) -> Any:
        found = z3.IntVal(0, context)
        for factor, names in calculated.terms:
            product = z3.IntVal(factor, context)
            for name in names:
                product *= variables[name]
            found += product
        return found

    literals: dict[str, int] = {}

    def require(formula: Any, literal: int) -> None:
        tracked = z3.Bool(f"literal {literal}", context)
        literals[str(tracked)] = literal
        solver.add(z3.Implies(tracked, formula if literal > 0 else z3.Not(formula)))

    sides = [(variables[name], value, inclusive, literal) for name, value, inclusive, literal in cuts]
    sides += [(result(one), value, inclusive, literal) for one, value, inclusive, literal in compared]
    for side, value, inclusive, literal in sides:
        require(side <= number(value) if inclusive else side < number(value), literal)
    for one, other, literal in orders:
        require(variables[one] <= variables[other], literal)
    answer = solver.check(*(z3.Bool(name, context) for name in literals))
    if answer == z3.unsat:
        return [literals[str(one)] for one in solver.unsat_core()]
    if answer == z3.unknown:
        calculations = [one for one, *_ in compared]
        lines = [one.line for one in calculations]
        raise NotCalculated(f"z3 does not decide what {named(calculations)} can be", lines)
    model = solver.model()
    return {name: _exact(model.eval(variable, model_completion=True)) for name, variable in variables.items()}


def _exact(value: Any) -> Rational:
    found = value.as_fraction() if value.is_real() else value.as_long()
    return int(found) if found.denominator == 1 else found
