"""What the parsers of both syntaxes do with their tokens: say where it is, report, and find their feet again.

One mistake is reported once. After a problem the rest of the clause it stands in is silent (`hurt`), and parsing goes
on at the next token that surely starts something new.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import NoReturn

from sleec_runtime.errors import Problem
from sleec_runtime.language.common.tokens import Tokens
from sleec_runtime.model import NO_COMMENTS, Comments, Source, Span

MAX_DEPTH = 100
"""How deep parentheses and NOTs may be nested: far deeper than people read, far shallower than Python's stack."""

ALTERNATIVE_LEVELS = 3
"""As many levels as what OTHERWISE and ELSE hold counts for: its values are nested so much deeper."""

MAX_NAME = 200
"""The longest name, in characters. A longer one is a text in which keywords are missing."""


class Abandon(Exception):
    """The clause at hand cannot be read further. The problem has been reported; parsing goes on elsewhere."""


class TokenCursor:
    """Where a parser stands in `tokens`, and the problems that it has met so far."""

    def __init__(self, source: Source, tokens: Tokens, problems: list[Problem]) -> None:
        self.source = source
        self.problems = problems
        self.text = source.text
        self.tokens = tokens
        self.kinds = tokens.kinds
        self.starts = tokens.starts
        self.ends = tokens.ends
        self.comments = tokens.comments
        self.at = 0
        self.depth = 0
        self.hurt = False

    # Places ---------------------------------------------------------------------------------------------------

    def span(self, first: int) -> Span:
        """From token `first` to the last one read."""
        return Span(self.starts[first], self.ends[self.at - 1])

    def token_span(self, token: int) -> Span:
        return Span(self.starts[token], self.ends[token])

    def token_text(self, token: int) -> str:
        return self.text[self.starts[token] : self.ends[token]]

    def comments_of(self, token: int) -> Comments:
        return self.comments.get(token, NO_COMMENTS)

    def line_of(self, token: int) -> int:
        return self.source.place(self.token_span(token)).line

    # Problems -------------------------------------------------------------------------------------------------

    def problem(self, message: str, span: Span, hint: str | None = None) -> None:
        """Reports a problem, unless this clause already has one."""
        if not self.hurt:
            self.hurt = True
            self.problems.append(Problem(message, span, hint))

    def fail(self, message: str, span: Span, hint: str | None = None) -> NoReturn:
        """Reports a problem and gives the clause up."""
        self.problem(message, span, hint)
        raise Abandon

    def skip(self, stops: Collection[str]) -> None:
        """On to the next token whose kind is among `stops`, or to the end."""
        kinds, at = self.kinds, self.at
        while kinds[at] not in stops and kinds[at] != "end":
            at += 1
        self.at = at


def composed(name: str) -> str:
    """`name` with its accents as one character each, so that what looks the same is the same."""
    import unicodedata

    return unicodedata.normalize("NFC", name)
