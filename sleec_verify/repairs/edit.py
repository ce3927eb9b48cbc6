"""Edits of a text: parts that are replaced, and everything else stays as it is."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import NamedTuple

from sleec_runtime.errors import SleecError


class TextEdit(NamedTuple):
    """Replaces ``text[start:end]`` by `text`. An insertion has `start` equal to `end`; a deletion has no `text`."""

    start: int
    end: int
    text: str


class OverlappingEdits(SleecError):
    """Two edits change the same part of a text."""


def edited(text: str, edits: Iterable[TextEdit]) -> str:
    """`text` with these edits, whose offsets are those of `text`.

    Raises:
        OverlappingEdits: two of them touch the same characters, or insert at the same place.
    """
    parts: list[str] = []
    position = 0
    for edit in in_order(edits):
        parts += (text[position : edit.start], edit.text)
        position = edit.end
    parts.append(text[position:])
    return "".join(parts)


def in_order(edits: Iterable[TextEdit]) -> list[TextEdit]:
    """The edits in the order of the text. Raises `OverlappingEdits`."""
    ordered = sorted(edits)
    for one, other in pairwise(ordered):
        if one.end > other.start or one.start == other.start:
            raise OverlappingEdits(
                "two repairs change the same part of the text", "apply one of them, check again, and choose another"
            )
    return ordered


class OffsetMap:
    """Where the unchanged parts of a text are after some edits."""

    def __init__(self, edits: Sequence[TextEdit]) -> None:
        """`edits` are in the order of the text and do not overlap."""
        self._starts = [edit.start for edit in edits]
        self._edits = edits
        shift = 0
        self._shifts = [0]
        for edit in edits:
            shift += len(edit.text) - (edit.end - edit.start)
            self._shifts.append(shift)

    def after(self, offset: int) -> int | None:
        """The offset of a character after the edits; None if they replace it. O(log edits)."""
        before = bisect_right(self._starts, offset)
        if before:
            last = self._edits[before - 1]
            if last.start <= offset < last.end:
                return None
        return offset + self._shifts[before]
