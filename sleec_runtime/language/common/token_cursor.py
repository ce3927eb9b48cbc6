"""A position in a sequence of tokens: spans, error reports and recovery, for the parsers of both languages.

One mistake is reported once: after a problem, nothing more is reported of its clause (`has_failed`). Parsing goes on
at the next token that starts something new.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import NoReturn

from sleec_runtime.errors import Problem
from sleec_runtime.language.common.tokens import Tokens
from sleec_runtime.model import NO_COMMENTS, Comments, Source, Span

MAX_DEPTH = 100
"""The deepest nesting of parentheses and NOTs: far deeper than people read, far shallower than Python's stack."""

ALTERNATIVE_LEVELS = 3
"""The levels of nesting that an OTHERWISE or ELSE counts for: its values are nested so much deeper."""

MAX_NAME = 200
"""The longest name, in characters. A longer one is a sign of missing keywords."""


class ClauseError(Exception):
    """The clause at hand cannot be parsed. Its problem has been reported; parsing goes on elsewhere."""


class TokenCursor:
    """A position in `tokens`, and the problems so far."""

    operators = "NOT"
    """What nests, other than parentheses, for messages."""

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
        self.deepest = 0
        self.has_failed = False

    # Spans ----------------------------------------------------------------------------------------------------

    def span(self, first: int) -> Span:
        """From token `first` to the last one read."""
        return Span(self.starts[first], self.ends[self.at - 1])

    def token_span(self, token: int) -> Span:
        return Span(self.starts[token], self.ends[token])

    def token_text(self, token: int) -> str:
        return self.text[self.starts[token] : self.ends[token]]

    def starts_line(self, token: int) -> bool:
        return self.tokens.starts_line(token)

    def comments_of(self, token: int) -> Comments:
        return self.comments.get(token, NO_COMMENTS)

    def line_of(self, token: int) -> int:
        return self.source.place(self.token_span(token)).line

    # Problems -------------------------------------------------------------------------------------------------

    def begin_clause(self) -> None:
        """From here on a problem is a new one."""
        self.has_failed = False
        self.depth = 0
        self.deepest = 0

    def problem(self, message: str, span: Span, hint: str | None = None) -> None:
        """Reports a problem, unless this clause already has one."""
        if not self.has_failed:
            self.has_failed = True
            self.problems.append(Problem(message, span, hint))

    def fail(self, message: str, span: Span, hint: str | None = None) -> NoReturn:
        """Reports a problem and gives up the clause."""
        self.problem(message, span, hint)
        raise ClauseError

    def expected(self, what: str, hint: str | None = None) -> NoReturn:
        """Gives up because the token at hand is not `what`."""
        raise NotImplementedError

    def skip(self, stops: Collection[str]) -> None:
        """On to the next token whose kind is among `stops`, or to the end."""
        kinds, at = self.kinds, self.at
        while kinds[at] not in stops and kinds[at] != "end":
            at += 1
        self.at = at

    # Nesting --------------------------------------------------------------------------------------------------

    def descend(self, levels: int = 1) -> None:
        """One bracket or negation further in, or `levels` of them."""
        self.depth += levels
        if self.depth > self.deepest:
            self.deepest = self.depth
            if self.depth > MAX_DEPTH:
                self.too_deep()

    def too_deep(self) -> NoReturn:
        self.fail(
            f"nested too deeply: more than {MAX_DEPTH} levels of parentheses or {self.operators}",
            self.token_span(self.at),
            "simplify the condition, or split the rule in two",
        )

    def close(self, mark: str, opened: int) -> None:
        """Reads the `mark` that closes what token `opened` opened."""
        if self.kinds[self.at] != mark and self.token_text(self.at) != mark:
            place = self.source.place(self.token_span(opened))
            bracket = {"}": "brace", "]": "bracket"}.get(mark, "parenthesis")
            self.expected(
                f"a closing {bracket} for the one opened in line {place.line}, column {place.column}",
                f"add the closing {bracket}, or delete the opening one",
            )
        self.at += 1

    # Names ----------------------------------------------------------------------------------------------------

    def checked_name(self, token: int) -> str:
        """The name that is one token, in its composed form (NFC). Gives up if it is too long."""
        start, end = self.starts[token], self.ends[token]
        if end - start > MAX_NAME:
            self.fail(
                f"this name has {end - start:,} characters, more than {MAX_NAME}",
                Span(start, start + MAX_NAME),
                "is a space missing?",
            )
        return composed(self.text[start:end])

    def joined_name(self, first: int, end: int) -> str:
        """The tokens from `first` to before `end` as one name, in its composed form."""
        return composed(" ".join(map(self.token_text, range(first, end))))


def composed(name: str) -> str:
    """`name` in Unicode's composed form (NFC), so that names that look the same are the same."""
    if name.isascii():
        return name
    import unicodedata

    return unicodedata.normalize("NFC", name)
