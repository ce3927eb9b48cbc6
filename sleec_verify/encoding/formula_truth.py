"""The truth of formulas in one context, computed by the solver."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from sleec_runtime.model import Context, Formula, Measure
from sleec_verify.encoding.cnf import Encoder
from sleec_verify.encoding.solver import MiniSat


def truth_in(context: Context, formulas: Sequence[Formula], measures: Mapping[str, Measure]) -> list[bool]:
    """The truth of formulas in one context. Conditions without a value are false, and so are comparisons of
    measures without a value."""
    encoder = Encoder(measures, frozenset(measures) - set(context.conditions))
    literals = [encoder.literal(formula) for formula in formulas]
    encoder.close()
    with MiniSat(encoder.clauses) as solver:
        found = solver.solve(encoder.assumptions(context))
        assert found, "every context is a model"
        return [solver.holds(literal) for literal in literals]
