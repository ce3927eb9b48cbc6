"""Constructs of the DSL that SLEEC-TK does not have, or reads differently."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from sleec_runtime.model import (
    RELATIONS,
    Claim,
    Clause,
    Obligation,
    Rule,
    Ruleset,
    Span,
    Statement,
    literals,
)
from sleec_verify.encoding.calculations import refuse_unsayable_calculations
from sleec_verify.encoding.trace_scope import responses_of
from sleec_verify.exchange.conversion.refusals import defined_names, refuse


def refuse_unsayable(ruleset: Ruleset, statements: Iterable[Statement]) -> None:
    """Raises `Unsayable` for the first construct that SLEEC-TK does not have."""
    refuse_unsayable_calculations(ruleset, "SLEEC-TK", _HINT)
    for statement in statements:
        if isinstance(statement, (Claim, *RELATIONS)):
            refuse(ruleset, "SLEEC-TK has no concerns, purposes or relations", statement.span, _HINT)
        if isinstance(statement, Rule):
            for clause in statement.clauses():
                for message, span in _unsayable(clause):
                    refuse(ruleset, message, span, _HINT)


def has_untimed(statements: Iterable[Statement]) -> bool:
    """Whether a rule has a response without a window, which SLEEC-TK reads differently."""
    return any(
        literal.timing is None or literal.timing.window is None
        for rule in statements
        if isinstance(rule, Rule)
        for literal in responses_of(rule)
    )


def taken_names(statements: Iterable[Statement]) -> list[str]:
    """The names that SLEEC-TK's editor rejects, because its generated processes use them."""
    names = {name for statement in statements for name in defined_names(statement)}
    return sorted(names & _TAKEN)


_TAKEN = {"STOP", "P", "Q", "c", "d"}
_HINT = "use --to legos"


def _unsayable(clause: Clause) -> Iterator[tuple[str, Span]]:
    for literal in literals(clause):
        said = _of_literal(literal)
        if said is not None:
            yield said, literal.span


def _of_literal(literal: Obligation) -> str | None:
    timing = literal.timing
    window = timing.window if timing is not None else None
    if literal.negated and (window is None or window.end is None):
        return f"SLEEC-TK has no prohibition without a window, such as that of `{literal.name}`"
    if timing is None:
        return None
    if timing.instead is not None:
        return "SLEEC-TK has no else"
    if timing.otherwise is not None and (window is None or literal.negated):
        return "SLEEC-TK has otherwise only after a response with a window"
    if window is not None and window.end is None:
        return "SLEEC-TK has no eventually"
    if window is not None and window.start is not None:
        return "SLEEC-TK has no windows with a start"
    if window is not None and window.end is not None and window.end.measures:
        return "SLEEC-TK has no windows whose length is a measure"
    return None
