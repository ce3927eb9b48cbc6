"""The rules in other languages: formulas for people, clauses for solvers.

Without time, they state Equation 1 (paper, Section 3.2), the constraints and the assumptions. With time, they state the
rules and relations in metric temporal logic.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from sleec_runtime.model import Ruleset
from sleec_verify.encoding.calculations import refuse_calculations
from sleec_verify.encoding.trace_scope import Untimed

FORMS = ("sympy", "latex", "cnf", "dimacs", "smtlib", "json")
TEMPORAL_FORMS = ("mtl", "mtl-latex")


def compile_to(ruleset: Ruleset, form: str, domain: str | None = None) -> str:
    """The ruleset (its rules in `domain`, if one is named) in one of `FORMS`, as text.

    sympy and latex are Equation 1 written out; cnf, dimacs and json are clauses, linear in the size of the rules;
    smtlib keeps the measures as numbers. Raises KeyError for another form,
    UnsupportedCalculations for rules that calculate with several measures.
    """
    if domain is not None:
        ruleset = ruleset.in_domain(domain)
    refuse_calculations(ruleset, "Equation 1 as a formula or as clauses")
    return _writers()[form](ruleset)


def compile_with_time(ruleset: Ruleset, form: str, domain: str | None = None, untimed: Untimed = "at") -> str:
    """The ruleset (its rules in `domain`, if one is named) in one of `TEMPORAL_FORMS`, as text.

    `untimed` is the meaning of a response without a window. Raises KeyError for another form.
    """
    from sleec_verify.exchange.compilation.mtl import as_mtl, as_mtl_latex

    if domain is not None:
        ruleset = ruleset.in_domain(domain)
    return {"mtl": as_mtl, "mtl-latex": as_mtl_latex}[form](ruleset, untimed)


def _writers() -> Mapping[str, Callable[[Ruleset], str]]:
    from sleec_verify.exchange.compilation import clauses, formulas, smtlib

    return {
        "sympy": formulas.as_sympy,
        "latex": formulas.as_latex,
        "cnf": clauses.as_lines,
        "dimacs": clauses.as_dimacs,
        "json": clauses.as_json,
        "smtlib": smtlib.as_smtlib,
    }
