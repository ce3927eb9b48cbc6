"""Where the names and phrases of a text are. A name in one place does not become a form of plain English in another."""

from __future__ import annotations

from typing import NamedTuple

from sleec_runtime.language.common.token_cursor import composed
from sleec_runtime.language.common.tokens import Tokens
from sleec_runtime.language.english.keywords import (
    ALTERNATIVES,
    IN_WHICH_CASE,
    KEYWORDS,
    OCCASION,
    PHRASE,
    RELATION_WORDS,
    TIMES,
)

_CONDITIONS = frozenset(
    {"WHEN", "IF", OCCASION, "UNLESS", "ASSUME", "CONDITION", "TRIGGER", "EVENT", "EXISTS", "UNTIL"}
)
_RESPONSES = frozenset({"THEN", "IN", "WHICH", "CASE", IN_WHICH_CASE, "WHILE", "ALWAYS", *ALTERNATIVES})
_ANYWHERE = frozenset({"AND", "OR", "NOT", *TIMES})


class PhrasePositions(NamedTuple):
    """The names and phrases where a condition or an event is, and all those outside responses."""

    conditions: frozenset[str]
    outside_responses: frozenset[str]


def phrase_positions(tokens: Tokens) -> PhrasePositions:
    """Where the names and phrases of a text are."""
    conditions: set[str] = set()
    outside: set[str] = set()
    before = ""
    at = 0
    while tokens.kinds[at] != "end":
        kind = tokens.kinds[at]
        first = at
        at += 1
        if (kind in KEYWORDS or kind in (OCCASION, IN_WHICH_CASE)) and kind not in _ANYWHERE:
            before = kind
        elif kind == "word":
            separators = RELATION_WORDS if before == "RELATION" else frozenset[str]()
            if tokens.text_of(first) in separators:
                continue
            while tokens.kinds[at] in PHRASE and tokens.text_of(at) not in separators:
                at += 1
            name = composed(" ".join(map(tokens.text_of, range(first, at))))
            if before in _CONDITIONS:
                conditions.add(name)
            if before not in _RESPONSES:
                outside.add(name)
    return PhrasePositions(frozenset(conditions), frozenset(outside))
