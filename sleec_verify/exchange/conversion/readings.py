"""Conversion between the readings of a chain of hedges, without changing what any situation obliges.

From `priority` to `cascade`, a condition Ci becomes Ci ∨ … ∨ Cn; from `cascade` to `priority`, C1 ∧ … ∧ Ci.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from sleec_runtime.model import And, Clause, Formula, Or, Reading, Ruleset
from sleec_verify.encoding.statement_parts import with_chains


def with_reading(ruleset: Ruleset, reading: Reading) -> Ruleset:
    """`ruleset` with its hedges rewritten so that it obliges the same, read as `reading`."""
    if reading == ruleset.reading:
        return ruleset

    def rewritten(hedges: Sequence[Clause]) -> list[Clause]:
        """A chain whose clauses decide in `reading` where they decided in the other one."""
        conditions = [hedge.condition for hedge in hedges if hedge.condition is not None]
        kind = Or if reading == "cascade" else And
        return [
            replace(hedge, condition=_joined(kind, conditions[n:] if reading == "cascade" else conditions[: n + 1]))
            for n, hedge in enumerate(hedges)
        ]

    statements = tuple(with_chains(statement, rewritten) for statement in ruleset.statements)
    return replace(ruleset, statements=statements, reading=reading)


def _joined(kind: type[And] | type[Or], parts: Sequence[Formula]) -> Formula:
    """The parts as one chain of operands, with nested chains of the same kind flattened, and no repeats."""
    operands: dict[Formula, None] = {}
    for part in parts:
        operands.update(dict.fromkeys(part.operands if isinstance(part, kind) else (part,)))
    return kind(tuple(operands)) if len(operands) > 1 else next(iter(operands))
