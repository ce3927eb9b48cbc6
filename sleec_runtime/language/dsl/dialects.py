"""The dialect of a text."""

from __future__ import annotations

from sleec_runtime.language.common.tokens import Tokens
from sleec_runtime.language.dsl.keywords import DEFINITIONS, LEGOS_KEYWORDS, UNNAMED
from sleec_runtime.model import Dialect

_LEGOS_ONLY = frozenset({"concern_start", "purpose_start", "relation_start", "eventually", "else", "->", "["})


def dialect_of(tokens: Tokens) -> Dialect:
    """The dialect of a text: LEGOS has measures in braces and constructs of its own, SLEEC-TK has conditions without
    braces. A text with neither is LEGOS.

    A text without LEGOS constructs may define a keyword of LEGOS as a name. It is then SLEEC-TK, and that keyword
    becomes a name in all of `tokens`.
    """
    kinds = tokens.kinds
    if not _LEGOS_ONLY.isdisjoint(kinds) or _has_measures_in_braces(kinds):
        return "legos"
    names = set() if LEGOS_KEYWORDS.isdisjoint(kinds) else _defined(tokens)
    if names:
        for token, kind in enumerate(kinds):
            if (kind in LEGOS_KEYWORDS or kind == UNNAMED) and tokens.text_of(token) in names:
                kinds[token] = "word"
        return "sleec-tk"
    # A claim outside its block is a mistake in the LEGOS dialect.
    claims = any(kind in ("exists", "while", "meanwhile") for kind in kinds)
    return "sleec-tk" if not claims and _has_bare_measures(kinds) else "legos"


def _defined(tokens: Tokens) -> set[str]:
    """The keywords of LEGOS in the position of a defined name, or of a value of a scale."""
    kinds = tokens.kinds
    return {
        kind
        for token, kind in enumerate(kinds)
        if kind in LEGOS_KEYWORDS
        and token
        and (
            kinds[token - 1] in DEFINITIONS
            or kinds[token - 1] == ","
            or (kinds[token - 1] == "(" and tokens.text_of(token - 2) == "scale")
        )
    }


def _has_measures_in_braces(kinds: list[str]) -> bool:
    return any(
        kind == "{"
        and kinds[token + 1] == "word"
        and kinds[token + 2] == "}"
        and kinds[token - 1] not in ("then", "otherwise")
        for token, kind in enumerate(kinds)
    )


def _has_bare_measures(kinds: list[str]) -> bool:
    return any(
        kind == "word" and (kinds[token - 2] if kinds[token - 1] == "not" else kinds[token - 1]) in _JOINING
        for token, kind in enumerate(kinds)
    )


_JOINING = ("and", "or", "unless")
