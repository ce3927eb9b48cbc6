"""The rules in other languages: formulas for people, clauses for solvers.

Equation 1 (paper, Section 3.2) is about one instant: a response with a window is one atom. Metric temporal logic and
FRETish are about whole traces.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from sleec_runtime.model import Ruleset
from sleec_verify.encoding.calculations import refuse_calculations
from sleec_verify.encoding.trace_scope import Untimed

EQUATION_FORMS = ("sympy", "latex", "cnf", "dimacs", "smtlib", "json")
FORMS = (*EQUATION_FORMS, "mtl", "mtl-latex", "fretish")


def compile_to(ruleset: Ruleset, form: str, domain: str | None = None, untimed: Untimed = "at") -> str:
    """The ruleset (its rules in `domain`, if one is named) in one of `FORMS`, as text.

    `untimed` is the meaning of a response without a window. Raises KeyError for another form. Raises
    UnsupportedCalculations for one of `EQUATION_FORMS` and a condition that calculates with several measures.
    """
    if domain is not None:
        ruleset = ruleset.in_domain(domain)
    if form in EQUATION_FORMS:
        refuse_calculations(ruleset, "Equation 1 as a formula or as clauses")
    return _writers()[form](ruleset, untimed)


def _writers() -> Mapping[str, Callable[[Ruleset, Untimed], str]]:
    from sleec_verify.exchange.compilation import clauses, formulas, fretish, mtl, smtlib

    return {
        "sympy": formulas.as_sympy,
        "latex": formulas.as_latex,
        "cnf": clauses.as_lines,
        "dimacs": clauses.as_dimacs,
        "smtlib": smtlib.as_smtlib,
        "json": clauses.as_json,
        "mtl": mtl.as_mtl,
        "mtl-latex": mtl.as_mtl_latex,
        "fretish": fretish.as_fretish,
    }
