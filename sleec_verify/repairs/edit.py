"""Edits of a text: parts that are replaced, and everything else stays as it is."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Sequence
from difflib import SequenceMatcher
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


def inverse(text: str, edits: Sequence[TextEdit]) -> list[TextEdit]:
    """The edits that change the edited text back to `text`. `edits` are in the order of the text."""
    back = []
    shift = 0
    for start, end, new in edits:
        back.append(TextEdit(start + shift, start + shift + len(new), text[start:end]))
        shift += len(new) - (end - start)
    return back


def edits_between(old: str, new: str) -> tuple[TextEdit, ...]:
    """Edits of whole lines that change `old` to `new`, each without the characters that its ends share."""
    before, after = old.splitlines(keepends=True), new.splitlines(keepends=True)
    starts = [0]
    for line in before:
        starts.append(starts[-1] + len(line))
    edits = []
    for tag, i, j, k, m in SequenceMatcher(None, before, after, autojunk=False).get_opcodes():
        if tag != "equal":
            edits.append(_trimmed(old, starts[i], starts[j], "".join(after[k:m])))
    return tuple(edits)


def _trimmed(old: str, start: int, end: int, text: str) -> TextEdit:
    same = _shared(old[start:end], text)
    start, text = start + same, text[same:]
    same = _shared(old[start:end][::-1], text[::-1])
    end, text = end - same, text[: len(text) - same]
    if start == end:
        # Insert before the line break rather than after it, where the next statement begins.
        for line_break in ("\r\n", "\n"):
            if text.endswith(line_break) and old.endswith(line_break, 0, start):
                size = len(line_break)
                return TextEdit(start - size, start - size, line_break + text[:-size])
    return TextEdit(start, end, text)


def _shared(one: str, other: str) -> int:
    """The length of the common beginning of two texts."""
    return next((n for n, (a, b) in enumerate(zip(one, other)) if a != b), min(len(one), len(other)))


def joined(edits: Iterable[TextEdit]) -> tuple[TextEdit, ...]:
    """The edits, with all insertions at one place as a single one, in the order given."""
    found: dict[tuple[int, int], TextEdit] = {}
    for number, edit in enumerate(edits):
        key = (edit.start, -1 if edit.start == edit.end else number)
        before = found.get(key)
        found[key] = edit if before is None else edit._replace(text=before.text + edit.text)
    return tuple(found.values())


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
