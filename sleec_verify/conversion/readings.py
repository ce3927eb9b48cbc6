"""From one reading of a chain of hedges to the other: each rewriting obliges the same in every situation.

From `priority` to `cascade` a condition Ci becomes Ci ∨ … ∨ Cn, from `cascade` to `priority` C1 ∧ … ∧ Ci.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from sleec_runtime.model import And, Clause, Formula, Or, Reading, Rule, Ruleset


def reread(ruleset: Ruleset, reading: Reading) -> Ruleset:
    """`ruleset` with its hedges rewritten so that it obliges the same, read as `reading`."""
    if reading == ruleset.reading:
        return ruleset
    statements = tuple(
        replace(s, default=_clause(s.default, reading), hedges=_chain(s.hedges, reading)) if isinstance(s, Rule) else s
        for s in ruleset.statements
    )
    return replace(ruleset, statements=statements, reading=reading)


def _clause(clause: Clause, reading: Reading) -> Clause:
    return replace(clause, hedges=_chain(clause.hedges, reading)) if clause.hedges else clause


def _chain(hedges: Sequence[Clause], reading: Reading) -> tuple[Clause, ...]:
    """A chain whose clauses decide in `reading` where they decided in the other one."""
    conditions = [hedge.condition for hedge in hedges if hedge.condition is not None]
    rewritten = []
    for number, hedge in enumerate(hedges):
        parts = conditions[number:] if reading == "cascade" else conditions[: number + 1]
        condition = _joined(Or if reading == "cascade" else And, parts)
        rewritten.append(replace(_clause(hedge, reading), condition=condition))
    return tuple(rewritten)


def _joined(kind: type[And] | type[Or], parts: Sequence[Formula]) -> Formula:
    """The parts as one chain, with those that are chains of the same kind opened up, and none twice."""
    operands: dict[Formula, None] = {}
    for part in parts:
        operands.update(dict.fromkeys(part.operands if isinstance(part, kind) else (part,)))
    return kind(tuple(operands)) if len(operands) > 1 else next(iter(operands))
