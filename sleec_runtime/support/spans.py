"""Places in a text: spans as offsets, and as lines and columns."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple


class Span(NamedTuple):
    """A part of a text, ``text[start:end]``, as offsets in characters."""

    start: int
    end: int


NOWHERE = Span(0, 0)


class Place(NamedTuple):
    """A span as lines and columns, counted from 1. The end column is one after the last character."""

    line: int
    column: int
    end_line: int
    end_column: int


@dataclass(frozen=True)
class Source:
    """A text and its origin.

    `path` is the path of the file, or a name such as ``<stdin>``. `sha256` is the digest of the bytes of the file, if
    known. `first_line` is the number of its first line in the file, if the text is a part of the file.
    """

    path: str
    text: str
    sha256: str | None = None
    first_line: int = 1

    @cached_property
    def _line_starts(self) -> list[int]:
        starts = [0]
        position = self.text.find("\n")
        while position >= 0:
            starts.append(position + 1)
            position = self.text.find("\n", position + 1)
        return starts

    def place(self, span: Span) -> Place:
        """Lines and columns of `span`. O(log lines) after the first call."""
        starts = self._line_starts
        line = bisect_right(starts, span.start)
        end_line = bisect_right(starts, span.end)
        before = self.first_line - 1
        return Place(
            before + line, span.start - starts[line - 1] + 1, before + end_line, span.end - starts[end_line - 1] + 1
        )

    def in_one_line(self, span: Span) -> str:
        """The text of `span`, with single spaces for line breaks and indentation."""
        return " ".join(self.text[span.start : span.end].split())

    def line(self, number: int) -> str:
        """The text of a line, by its number in the file, without its line break."""
        starts = self._line_starts
        index = number - self.first_line
        start = starts[index]
        end = starts[index + 1] if index + 1 < len(starts) else len(self.text)
        return self.text[start:end].rstrip("\r\n")
