"""A statement with each of its formulas or chains of hedges changed, including those of alternatives and claims."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeVar

from sleec_runtime.model import (
    Assume,
    Claim,
    Clause,
    Effect,
    Formula,
    Lasting,
    MeasureRelation,
    Never,
    Obligation,
    Rule,
    Statement,
)

Hedges = Sequence[Clause]
_Statement = TypeVar("_Statement", bound=Statement)


def with_formulas(statement: _Statement, change: Callable[[Formula], Formula]) -> _Statement:
    """`statement` with `change` of each of its formulas."""

    def of(formula: Formula | None) -> Formula | None:
        return None if formula is None else change(formula)

    def chain(hedges: Hedges) -> Hedges:
        return [replace(hedge, condition=of(hedge.condition)) for hedge in hedges]

    changed: Statement = with_chains(statement, chain)
    if isinstance(changed, Rule):
        changed = replace(changed, guard=of(changed.guard))
    elif isinstance(changed, Claim):
        changed = _claim_with_conditions(changed, of)
    elif isinstance(changed, MeasureRelation):
        changed = replace(changed, left=change(changed.left), right=of(changed.right))
    elif isinstance(changed, Lasting):
        changed = replace(
            changed,
            condition=of(changed.condition),
            formula=change(changed.formula),
            end_condition=of(changed.end_condition),
        )
    elif isinstance(changed, (Effect, Never, Assume)):
        changed = replace(changed, formula=change(changed.formula))
    return changed  # type: ignore[return-value]


def _claim_with_conditions(claim: Claim, of: Callable[[Formula | None], Formula | None]) -> Claim:
    meanwhile = None if claim.meanwhile is None else _claim_with_conditions(claim.meanwhile, of)
    return replace(claim, condition=of(claim.condition), meanwhile=meanwhile)


def with_chains(statement: _Statement, change: Callable[[Hedges], Hedges]) -> _Statement:
    """`statement` with `change` of each of its chains of hedges, the inner ones first."""
    if isinstance(statement, Rule):
        return replace(statement, default=_clause(statement.default, change), hedges=_chain(statement.hedges, change))
    if isinstance(statement, Claim):
        return _claim_with_chains(statement, change)  # type: ignore[return-value]
    return statement


def _claim_with_chains(claim: Claim, change: Callable[[Hedges], Hedges]) -> Claim:
    return replace(
        claim,
        responses=tuple(_clause(clause, change) for clause in claim.responses),
        meanwhile=None if claim.meanwhile is None else _claim_with_chains(claim.meanwhile, change),
    )


def _chain(hedges: Hedges, change: Callable[[Hedges], Hedges]) -> tuple[Clause, ...]:
    return tuple(change([_clause(hedge, change) for hedge in hedges]))


def _clause(clause: Clause, change: Callable[[Hedges], Hedges]) -> Clause:
    return replace(
        clause,
        obligations=tuple(_obligation(obligation, change) for obligation in clause.obligations),
        hedges=_chain(clause.hedges, change),
    )


def _obligation(obligation: Obligation, change: Callable[[Hedges], Hedges]) -> Obligation:
    timing = obligation.timing
    if timing is None:
        return obligation
    otherwise, instead = (
        None if clause is None else _clause(clause, change) for clause in (timing.otherwise, timing.instead)
    )
    return replace(obligation, timing=replace(timing, otherwise=otherwise, instead=instead))
