"""Lines of a source with marks under the relevant places."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from sleec_verify.report.escape import in_one_column
from sleec_verify.wording.sentence import joined

if TYPE_CHECKING:
    from sleec_runtime.model import Source, Span
    from sleec_verify.report.palette import Palette

_WIDTH = 120
_MOST_LINES = 6


class Mark(NamedTuple):
    """A place to mark: with ``^`` if it is the main place, otherwise with ``-``, in the colour of `role`, and with a
    `word` after it."""

    span: Span
    role: str = "faint"
    word: str = ""
    main: bool = False


class _Stretch(NamedTuple):
    """The part of a mark on one line, as columns from 0."""

    start: int
    end: int
    mark: Mark
    last: bool


def excerpt(source: Source, marks: Sequence[Mark], palette: Palette) -> Iterator[str]:
    """The lines with marks, in the order of the text, numbered, with the marks below them."""
    stretches: dict[int, list[_Stretch]] = {}
    for mark in marks:
        for number, stretch in _lines_of(source, mark):
            stretches.setdefault(number, []).append(stretch)
    if not stretches:
        return
    margin = len(str(max(stretches)))
    blank = f"{palette('faint', ' ' * margin + ' |')}"
    yield blank
    before = min(stretches) - 1
    for number in sorted(stretches):
        if number > before + 1:
            yield palette("faint", "…".rjust(margin))
        before = number
        line = source.line(number)
        here = sorted(stretches[number], key=lambda s: (not s.mark.main, s.start))
        left = _left_edge(line, here)
        yield f"{palette('faint', f'{number:>{margin}} |')} {_shown(line, left)}".rstrip()
        for start, end, mark, last in here:
            pad = " " * _columns(_shown(line[:start], left))
            width = max(1, min(_columns(in_one_column(line[start:end])), _WIDTH - len(pad)))
            line = ("^" if mark.main else "-") * width
            words = joined(" ", [line, mark.word]) if mark.word and last else line
            yield joined("", [f"{blank} {pad}", palette(mark.role, words)])


def _lines_of(source: Source, mark: Mark) -> Iterator[tuple[int, _Stretch]]:
    place = source.place(mark.span)
    numbers = list(range(place.line, place.end_line + 1))
    if len(numbers) > _MOST_LINES:
        numbers = [*numbers[: _MOST_LINES - 1], numbers[-1]]
    spoken = []
    for number in numbers:
        line = source.line(number)
        start = place.column - 1 if number == place.line else len(line) - len(line.lstrip())
        end = place.end_column - 1 if number == place.end_line else len(line.rstrip())
        if end > start or len(numbers) == 1:
            spoken.append((number, start, end))
    for number, start, end in spoken:
        yield number, _Stretch(start, end, mark, last=number == spoken[-1][0])


def _left_edge(line: str, here: Sequence[_Stretch]) -> int:
    """The first column to show of a line: 0, or a little before the first mark if the line is too long."""
    return 0 if len(line) <= _WIDTH else max(0, min(s.start for s in here) - _WIDTH // 3)


def _shown(line: str, left: int) -> str:
    cut = line[left : left + _WIDTH]
    return ("…" if left else "") + in_one_column(cut) + ("…" if left + _WIDTH < len(line) else "")


def _columns(text: str) -> int:
    """The number of terminal columns of `text`."""
    if text.isascii():
        return len(text)
    from unicodedata import combining, east_asian_width

    return sum(0 if combining(c) else 2 if east_asian_width(c) in "WF" else 1 for c in text)
