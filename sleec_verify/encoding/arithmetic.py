"""Integer arithmetic: values for measures whose calculations are compared with numbers, by z3.

z3 is optional. It is imported at the first question that needs it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache
from typing import Any

from sleec_runtime.model import Calculation, Rational
from sleec_verify.encoding.budget import Budget, Undecided, current
from sleec_verify.encoding.calculations import named
from sleec_verify.wording.sentence import sentence

RESOURCES = 1_000_000
"""The resource limit of z3 for one question: about a second, and the same on every machine."""

_PER_RESOURCE, _SETUP = 0.5, 5_000
"""Budget steps for one unit of z3's resources, and for the setup of a question."""

_STOPPED = ("canceled", "timeout", "max. resource limit exceeded")
"""z3's reason for `unknown` if it was stopped by the limit."""

INSTALL = "pip install z3-solver"

Compared = tuple[Calculation, Rational, bool, int]
"""A calculation, a number, and whether the bound is inclusive. The literal says "calculation <= number" (or "<"),
and its negation the opposite."""


class NotCalculated(Undecided):
    """It is unknown which values a calculation can have. `lines` are its places."""

    def __init__(self, message: str, lines: Sequence[int]) -> None:
        super().__init__(message)
        self.lines = tuple(lines)


def unproved(calculations: Iterable[Calculation]) -> NotCalculated:
    """The error for an answer that must be proved and rests on what z3 says about these calculations."""
    calculations = list(calculations)
    return NotCalculated(
        sentence(
            "the answer depends on the result of z3 for {calculations}, which a certificate cannot prove",
            calculations=named(calculations),
        ),
        [one.line for one in calculations],
    )


def values_for(
    integral: Mapping[str, bool],
    cuts: Sequence[tuple[str, Rational, bool, int]],
    orders: Sequence[tuple[str, str, int]],
    compared: Sequence[Compared],
) -> dict[str, Rational] | list[int]:
    """Values for the measures `integral` that make all the literals true, or literals that no values make true
    together. Parameters other than `compared` are those of `sleec_verify.encoding.order.place`.

    Raises `NotCalculated` if z3 does not decide it, or is not installed.
    """
    names = {name: f"m{number}" for number, name in enumerate(integral)}
    formulas = [_limited(names[name], value, inclusive, literal) for name, value, inclusive, literal in cuts]
    formulas += [_signed(f"(<= {names[one]} {names[other]})", literal) for one, other, literal in orders]
    formulas += [_limited(_sum(one, names), value, inclusive, literal) for one, value, inclusive, literal in compared]
    sorts = (f"(declare-const {names[name]} {'Int' if whole else 'Real'})" for name, whole in integral.items())
    assumed = (
        f"(declare-const a{number} Bool)(assert (=> a{number} {formula}))" for number, formula in enumerate(formulas)
    )
    calculations = list(dict.fromkeys(one for one, *_ in compared))
    lines = [one.line for one in calculations]
    try:
        budget = current()
        found = answer("\n".join((*sorts, *assumed)), len(formulas), None if budget is None else budget.whole)
    except ImportError:
        why = sentence(
            "the values of {calculations} need z3, which is not installed ({install})",
            calculations=named(calculations),
            install=INSTALL,
        )
        raise NotCalculated(why, lines) from None
    if found is None:
        raise NotCalculated(
            sentence("z3 could not decide the values of {calculations}", calculations=named(calculations)), lines
        )
    if isinstance(found, dict):
        return {name: found.get(called, 0) for name, called in names.items()}
    literals = [*(cut[3] for cut in cuts), *(order[2] for order in orders), *(one[3] for one in compared)]
    return [literals[number] for number in found]


@lru_cache(maxsize=10_000)
def answer(question: str, assumed: int, asked_for: Budget | None) -> dict[str, Rational] | list[int] | None:
    """Values of ``m0``, ``m1``, … in a model of an SMT-LIB text in which the given number of ``a0``, ``a1``, … are
    true; or the numbers of some of these that contradict each other; None if z3 does not decide it.

    The question is a text, because building formulas through the API takes longer than z3 takes to answer. Answers are
    cached, because checks ask the same question repeatedly, but only for one budget, so that no file profits from
    another one.

    Raises `ImportError` without z3, and `OutOfBudget` if the current budget is spent before `RESOURCES`.
    """
    import z3

    budget = current()
    context = z3.Context()
    solver = z3.Solver(ctx=context)
    allowed = RESOURCES
    if budget is not None:
        budget.spend(_SETUP)
        allowed = int(min(RESOURCES, budget.steps / _PER_RESOURCE))
        if budget.is_timed:
            solver.set("timeout", int(budget.seconds() * 1000) + 1)
    solver.set("rlimit", allowed + 1)  # 0 would be no limit
    solver.from_string(question)
    answer = solver.check([z3.Bool(f"a{number}", context) for number in range(assumed)])
    if budget is not None:
        used = solver.statistics().get_key_value("rlimit count")
        budget.spend(_PER_RESOURCE * min(used, allowed))
        if answer == z3.unknown and used < RESOURCES and solver.reason_unknown() in _STOPPED:
            budget.give_up()
    if answer == z3.unsat:
        return [int(one.decl().name()[1:]) for one in solver.unsat_core()]
    if answer == z3.unknown:
        return None
    model = solver.model()
    return {one.name(): _exact(model[one]) for one in model.decls() if one.name().startswith("m")}


def _limited(side: str, value: Rational, inclusive: bool, literal: int) -> str:
    return _signed(f"({'<=' if inclusive else '<'} {side} {_number(value)})", literal)


def _signed(formula: str, literal: int) -> str:
    return formula if literal > 0 else f"(not {formula})"


def _sum(calculated: Calculation, names: Mapping[str, str]) -> str:
    parts = (
        f"(* {_number(factor)} {' '.join(names[name] for name in multiplied)})"
        for factor, multiplied in calculated.terms
    )
    return f"(+ {' '.join(parts)} 0)"


def _number(value: Rational) -> str:
    if value.denominator != 1:
        return f"(/ {_number(value.numerator)} {value.denominator})"
    return str(value) if value >= 0 else f"(- {-value})"


def _exact(value: Any) -> Rational:
    found = value.as_fraction() if value.is_real() else value.as_long()
    return int(found) if found.denominator == 1 else found
