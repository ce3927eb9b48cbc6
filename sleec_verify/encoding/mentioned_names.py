"""The names outside conditions and responses: in windows, concerns, purposes and relations."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import (
    RELATIONS,
    Claim,
    Clause,
    Formula,
    Lasting,
    Length,
    Rule,
    Ruleset,
    conditions_in,
    in_text_order,
    literals,
)
from sleec_verify.encoding.relations import events_of, formulas_of_relation


def names_beside_rules(ruleset: Ruleset) -> tuple[set[str], list[Formula], list[Length]]:
    """The events and formulas of concerns, purposes and relations, and all lengths of windows."""
    events: set[str] = set()
    formulas: list[Formula] = []
    lengths: list[Length] = []
    for statement in ruleset.statements:
        if isinstance(statement, Rule):
            for clause in statement.clauses():
                lengths += _lengths(clause)
        elif isinstance(statement, Claim):
            add_claim(statement, events, formulas, lengths)
        elif isinstance(statement, RELATIONS):
            events.update(events_of(statement))
            formulas += formulas_of_relation(statement)
            if isinstance(statement, Lasting) and statement.duration is not None:
                lengths.append(statement.duration)
    return events, formulas, lengths


def add_claim(claim: Claim, events: set[str], formulas: list[Formula], lengths: list[Length]) -> None:
    """Add the events, formulas and lengths of windows of a concern or purpose."""
    events.add(claim.event)
    if claim.condition is not None:
        formulas.append(claim.condition)
    for response in claim.responses:
        for clause in in_text_order(response):
            events |= {literal.name for literal in literals(clause)}
            formulas += conditions_in(clause)
            lengths += _lengths(clause)
    if claim.meanwhile is not None:
        add_claim(claim.meanwhile, events, formulas, lengths)


def _lengths(clause: Clause) -> Iterator[Length]:
    for literal in literals(clause):
        window = literal.timing.window if literal.timing is not None else None
        if window is not None:
            yield from (length for length in (window.start, window.end) if length is not None)
