"""Removes the hedges in the alternatives of responses: one plain response for each group of situations."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import product

from sleec_runtime.model import Clause, Formula, Obligation, Reading, Truth
from sleec_verify.changes.compare.timing_order import is_trivial
from sleec_verify.encoding.equation import chain, conjunction
from sleec_verify.encoding.trace_scope import Untimed


def plain_responses(obligation: Obligation, reading: Reading, untimed: Untimed) -> Iterator[tuple[Formula, Obligation]]:
    """The plain responses of an obligation, each with the formula for its situations.

    The alternatives of a plain response have no hedges. Trivial responses are omitted. The number of responses is the
    product of the numbers of clauses in the alternatives.
    """
    for where, plain in _ways(obligation, reading):
        if plain is not None and not is_trivial(plain, untimed):
            yield where, plain


def responses_in_situation(
    obligations: tuple[Obligation, ...], reading: Reading, untimed: Untimed, holds: Callable[[Formula], bool]
) -> tuple[Obligation, ...]:
    """The plain responses in one situation. `holds` evaluates formulas in it."""
    return tuple(o for one in obligations for where, o in plain_responses(one, reading, untimed) if holds(where))


def _ways(obligation: Obligation, reading: Reading) -> Iterator[tuple[Formula, Obligation | None]]:
    timing = obligation.timing
    if timing is None or not any(timing.alternatives()):
        yield Truth(True), obligation
        return
    for (where, otherwise), (there, instead) in product(
        list(_members(timing.otherwise, reading)), list(_members(timing.instead, reading))
    ):
        # If the alternative is empty, the response is optional.
        left = any(one is not None and not one.obligations for one in (otherwise, instead))
        plain = replace(obligation, timing=replace(timing, otherwise=otherwise, instead=instead))
        yield conjunction([where, there]), None if left else plain


def _members(clause: Clause | None, reading: Reading) -> Iterator[tuple[Formula, Clause | None]]:
    """The clauses of the chain of an alternative, without hedges, each with the formula for its situations."""
    if clause is None:
        yield Truth(True), None
        return
    for where, member in chain(clause, reading):
        for ways in product(*(list(_ways(obligation, reading)) for obligation in member.obligations)):
            due = tuple(plain for _, plain in ways if plain is not None)
            yield conjunction([where, *(there for there, _ in ways)]), Clause(None, due)
