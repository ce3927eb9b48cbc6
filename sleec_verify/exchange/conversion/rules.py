"""Rules of structured English in the form of the DSL, read by priority.

A response with several obligations becomes several rules, or several responses of a claim. A chain in the parentheses
of the default comes before the rule's own chain. A hedge that only contains others gives them its condition. If one of
several is an alternative to another obligation, that one is repeated: A or (B and C) is (A or B) and (A or C).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import islice, product

from sleec_runtime.errors import Unsayable
from sleec_runtime.model import NO_COMMENTS, And, Claim, Clause, Obligation, Rule

MAX_RULES = 1000
"""The maximal number of rules from one rule, because nested choices multiply."""


def split(rule: Rule, labels: set[str]) -> Iterator[Rule]:
    """Rules that together oblige the same as `rule`, each with one event. New labels are added to `labels`.

    Raises:
        Unsayable: there would be too many.
    """
    chain = (*rule.default.hedges, *rule.hedges)
    default = replace(rule.default, hedges=chain, comments=NO_COMMENTS)
    for number, one in enumerate(_narrowed(default, rule.label)):
        label = rule.label if number == 0 else _new(rule.label, number, labels)
        comments = rule.comments if number == 0 else NO_COMMENTS
        yield replace(rule, label=label, default=replace(one, hedges=()), hedges=one.hedges, comments=comments)


def narrow(claim: Claim) -> Claim:
    """`claim` with one event for each response.

    Raises:
        Unsayable: there would be too many responses.
    """
    return replace(
        claim,
        responses=tuple(one for clause in claim.responses for one in _narrowed(clause, claim.label)),
        meanwhile=None if claim.meanwhile is None else narrow(claim.meanwhile),
    )


def _narrowed(clause: Clause, label: str) -> list[Clause]:
    """Clauses that together oblige the same as `clause`, each with one obligation, and hedges with at most one."""
    wide = _wide(replace(clause, hedges=tuple(_flat(clause.hedges))), label)
    return [_one(wide, number) for number in range(_width(wide))]


def _wide(clause: Clause, label: str) -> Clause:
    """The clause with obligations whose alternatives have one obligation each."""
    narrowed = (one for obligation in clause.obligations for one in _alternatives_narrowed(obligation, label))
    obligations = list(islice(narrowed, MAX_RULES + 1))
    if len(obligations) > MAX_RULES:
        raise Unsayable(
            f"rule `{label}` has so many alternatives that the DSL would need more than {MAX_RULES:,} rules",
            "use fewer obligations in each OTHERWISE and ELSE",
        )
    return replace(clause, obligations=tuple(obligations), hedges=tuple(_wide(hedge, label) for hedge in clause.hedges))


def _alternatives_narrowed(obligation: Obligation, label: str) -> Iterator[Obligation]:
    timing = obligation.timing
    if timing is None or (timing.otherwise is None and timing.instead is None):
        yield obligation
        return
    choices = ([None] if clause is None else _narrowed(clause, label) for clause in (timing.otherwise, timing.instead))
    for otherwise, instead in product(*choices):
        yield replace(obligation, timing=replace(timing, otherwise=otherwise, instead=instead))


def _width(clause: Clause) -> int:
    return max([len(clause.obligations), *map(_width, clause.hedges)])


def _flat(hedges: Sequence[Clause]) -> Iterator[Clause]:
    for hedge in hedges:
        inner = tuple(_flat(hedge.hedges))
        if hedge.obligations or not inner:
            yield replace(hedge, hedges=inner)
            continue
        # The last true condition decides, and each of these implies the hedge's own.
        yield replace(hedge, hedges=())
        for clause in inner:
            assert hedge.condition is not None, "a hedge has a condition"
            assert clause.condition is not None, "a hedge has a condition"
            yield replace(clause, condition=And((hedge.condition, clause.condition)))


def _one(clause: Clause, number: int) -> Clause:
    """The clause with only its obligation of this number, or its last one if it has fewer."""
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
