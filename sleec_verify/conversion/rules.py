"""Rules of structured English in the shape that the DSL has words for, read by priority.

A response of several obligations becomes several rules; a chain in the parentheses of the default goes before the
rule's own; a hedge that only holds others gives them its condition.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from sleec_runtime.model import NO_COMMENTS, And, Clause, Rule


def split(rule: Rule, labels: set[str]) -> Iterator[Rule]:
    """Rules that oblige together what `rule` does, each one event at a time. New labels go into `labels`."""
    chain = (*_flat(rule.default.hedges), *_flat(rule.hedges))
    default = replace(rule.default, hedges=(), comments=NO_COMMENTS)
    rule = replace(rule, default=default, hedges=chain)
    width = max(len(clause.obligations) for clause in rule.clauses())
    for number in range(width):
        one = replace(
            rule, default=_one(rule.default, number), hedges=tuple(_one(hedge, number) for hedge in rule.hedges)
        )
        yield one if number == 0 else replace(one, label=_new(rule.label, number, labels), comments=NO_COMMENTS)


def _flat(hedges: Sequence[Clause]) -> Iterator[Clause]:
    for hedge in hedges:
        inner = tuple(_flat(hedge.hedges))
        if hedge.obligations or not inner:
            yield replace(hedge, hedges=inner)
            continue
        # The last true condition wins, and each of these is true only where the hedge's own is.
        yield replace(hedge, hedges=())
        for clause in inner:
            assert hedge.condition is not None, "a hedge has a condition"
            assert clause.condition is not None, "a hedge has a condition"
            yield replace(clause, condition=And((hedge.condition, clause.condition)))


def _one(clause: Clause, number: int) -> Clause:
    """The clause with its obligation of this number, or its last one where it has fewer."""
    return replace(
        clause,
        obligations=clause.obligations[number : number + 1] or clause.obligations[-1:],
        hedges=tuple(_one(hedge, number) for hedge in clause.hedges),
        comments=clause.comments if number == 0 else NO_COMMENTS,
    )


def _new(label: str, number: int, labels: set[str]) -> str:
    new = f"{label}_{number + 1}"
    while new in labels:
        new += "_"
    labels.add(new)
    return new
