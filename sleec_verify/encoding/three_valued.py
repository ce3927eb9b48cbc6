"""The value of a formula in Kleene's strong three-valued logic (Kleene 1952)."""

from __future__ import annotations

from collections.abc import Callable

from sleec_runtime.model import And, Atom, Comparison, Formula, Not, Or, Truth


def value_of(formula: Formula, leaf: Callable[[Atom | Comparison], bool | None]) -> bool | None:
    """The value of a formula, where `leaf` gives that of each atom and comparison; None is unknown. O(size)."""
    if isinstance(formula, (Atom, Comparison)):
        return leaf(formula)
    if isinstance(formula, Truth):
        return formula.value
    if isinstance(formula, Not):
        value = value_of(formula.operand, leaf)
        return None if value is None else not value
    assert isinstance(formula, (And, Or))
    absorbing = isinstance(formula, Or)
    values = [value_of(operand, leaf) for operand in formula.operands]
    return absorbing if absorbing in values else None if None in values else not absorbing


def is_true_in_empty_context(formula: Formula) -> bool:
    """Whether a formula is true where no trigger occurs, no condition is true and no measure has a value."""
    return value_of(formula, lambda _: False) is True
