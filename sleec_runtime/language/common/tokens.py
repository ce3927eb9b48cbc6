"""The tokens of a text, in parallel sequences."""

from __future__ import annotations

from array import array
from typing import NamedTuple

from sleec_runtime.model import Comments


class Tokens(NamedTuple):
    """The tokens of a text: ``text[starts[i]:ends[i]]`` has the kind ``kinds[i]``. Three tokens of kind ``end`` close
    the sequence, so that a parser may look ahead.

    `comments` holds the comments of the tokens that start a line of rules; `closing` those after all of them.
    """

    text: str
    kinds: list[str]
    starts: array[int]
    ends: array[int]
    comments: dict[int, Comments]
    closing: tuple[str, ...]

    def text_of(self, token: int) -> str:
        """The text of one token."""
        return self.text[self.starts[token] : self.ends[token]]

    def starts_line(self, token: int) -> bool:
        """Whether a line break is between the token and the one before it."""
        return token == 0 or "\n" in self.text[self.ends[token - 1] : self.starts[token]]
