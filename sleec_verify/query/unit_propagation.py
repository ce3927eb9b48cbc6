"""Unit propagation over a formula: the literals that every situation must name in which it is true."""

from __future__ import annotations

from typing import NamedTuple

from sleec_runtime.model import And, Atom, Comparison, Formula, Not, Or, Truth
from sleec_verify.encoding.three_valued import value_of
from sleec_verify.query.names import Name, names_in

Literals = dict[Name, bool]
_Part = tuple[Formula, bool]


class Impossible(Exception):
    """No situation makes the formula true."""


class Propagation(NamedTuple):
    """The literals that each situation must name in which a formula is known to be true, and the parts that they
    leave open: disjunctions, and comparisons of measures."""

    literals: Literals
    open_parts: list[Formula]

    def least(self) -> int:
        """A lower bound on the number of names of such a situation: one for each open part that shares none with
        another."""
        seen: set[Name] = set()
        parts = 0
        for part in self.open_parts:
            names = set(names_in(part)) - self.literals.keys()
            parts += seen.isdisjoint(names)
            seen |= names
        return len(self.literals) + parts


def propagate_units(formula: Formula) -> Propagation:
    """The consequences of the formula. Raises `Impossible` if it is never true. O(size of the formula) for each
    round of propagation."""
    known: Literals = {}
    open_: list[_Part] = [(formula, True)]
    waiting: list[_Part] = []
    while open_:
        waiting += _split(open_, known)
        open_ = []
        still: list[_Part] = []
        for part, value in waiting:
            left = [] if isinstance(part, Comparison) else _left(part, value, known)
            if len(left) == 1:
                open_ += ((operand, value) for operand in left)
            elif left or isinstance(part, Comparison):
                still.append((part, value))
        waiting = still
    return Propagation(known, [part for part, _ in waiting])


def _split(open_: list[_Part], known: Literals) -> list[_Part]:
    """Adds the literals of these parts. Returns their disjunctions and comparisons."""
    waiting: list[_Part] = []
    while open_:
        part, value = open_.pop()
        if isinstance(part, Not):
            open_.append((part.operand, not value))
        elif isinstance(part, Atom):
            if known.setdefault((part.kind, part.name), value) != value:
                raise Impossible
        elif isinstance(part, Truth):
            if part.value != value:
                raise Impossible
        elif isinstance(part, (And, Or)) and isinstance(part, And) == value:
            open_ += [(operand, value) for operand in part.operands]
        else:
            waiting.append((part, value))
    return waiting


def _left(part: Formula, value: bool, known: Literals) -> list[Formula]:
    """The operands that decide whether a part has this value; none if it has it."""
    assert isinstance(part, (And, Or))
    left = []
    for operand in part.operands:
        found = value_of(operand, lambda leaf: known.get((leaf.kind, leaf.name)) if isinstance(leaf, Atom) else None)
        if found == value:
            return []
        if found is None:
            left.append(operand)
    if not left:
        raise Impossible
    return left
