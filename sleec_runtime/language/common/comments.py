"""Which line of rules each comment belongs to.

The printer writes lines that start with a keyword, so a comment belongs to the token of such a keyword: one on a line
of its own to the next, one behind rules, or in the middle of them, to the one before it. Nothing is lost by printing.

An empty string among the comments above a line stands for an empty line, so that a file's heading stays apart from its
first rule. Below the begin of a block, a line break does: what stands above it is no heading. DOMAIN and READING are no
statements of the model; a comment above them is kept, with a gap, for the statement after them.
"""

from __future__ import annotations

from array import array
from collections.abc import Collection, Sequence
from typing import NamedTuple

from sleec_runtime.model import NO_COMMENTS, Comments

INNER_GAP = "\n"
"""An empty line among comments below the begin of a block."""


class Remark(NamedTuple):
    """A comment with its marker, ``text[start:end]``, or a line of one that has many lines, and the number of the token
    behind it."""

    start: int
    end: int
    token: int


def attach(
    remarks: Sequence[Remark],
    text: str,
    kinds: list[str],
    starts: array[int],
    ends: array[int],
    line_starts: Collection[str],
    settings: Collection[str],
    openings: Collection[str] = (),
) -> tuple[dict[int, Comments], tuple[str, ...]]:
    """The comments of each token that starts a line of rules, and those that come after the last one.

    `line_starts` are the kinds of the tokens that start a line; those of `settings` among them keep no comments. What
    stands right below one of `openings` is not divided by empty lines into a heading and the rest.
    """
    attached: dict[int, Comments] = {}
    pending: list[str] = []
    line = -1  # the token that starts the line of rules before the comment at hand
    seen = 0  # tokens before this one have been looked at
    end_before = 0

    def hand_over(token: int) -> None:
        """The pending comments stand above `token`, which starts a line of rules."""
        if kinds[token] in settings:
            _leave_gap(pending)
        elif is_divided(starts[token]):
            _leave_gap(pending, gap())
        if kinds[token] not in settings:
            before = attached.get(token, NO_COMMENTS)
            attached[token] = Comments(before.above + tuple(pending), before.behind)
            pending.clear()

    def is_divided(start: int) -> bool:
        """Whether an empty line before this place tells comments apart."""
        return text.count("\n", end_before, start) > 1

    def gap() -> str:
        return INNER_GAP if line >= 0 and kinds[line] in openings else ""

    for remark in remarks:
        while seen < remark.token:
            if kinds[seen] in line_starts:
                if pending:
                    hand_over(seen)
                line = seen
            seen += 1
        words = _words(text, remark)
        behind = remark.token > 0 and "\n" not in text[max(ends[remark.token - 1], end_before) : remark.start]
        inside = kinds[remark.token] not in line_starts and kinds[remark.token] != "end"
        owner = line if line >= 0 and kinds[line] not in settings and (behind or inside) else -1
        if owner >= 0:
            before = attached.get(owner, NO_COMMENTS)
            if behind and before.behind is None:
                attached[owner] = Comments(before.above, words)
            else:
                attached[owner] = Comments((*before.above, words), before.behind)
        else:
            if pending and is_divided(remark.start):
                _leave_gap(pending, gap())
            pending.append(words)
            if behind:
                _leave_gap(pending)
        end_before = remark.end
    while pending and kinds[seen] != "end":
        if kinds[seen] in line_starts:
            hand_over(seen)
        seen += 1
    return attached, tuple(pending)


def _words(text: str, remark: Remark) -> str:
    marker = 2 if text.startswith("//", remark.start) else 1 if text[remark.start] == "#" else 0
    return text[remark.start + marker : remark.end].strip()


def _leave_gap(pending: list[str], gap: str = "") -> None:
    if pending[-1].strip():
        pending.append(gap)
