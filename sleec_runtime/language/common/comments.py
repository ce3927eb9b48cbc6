"""Attaches comments to tokens.

The printer writes lines that start with a keyword, so a comment belongs to the token of such a keyword: a comment on a
line of its own to the next one, any other to the one before it. Printing keeps every comment.

An empty string among the comments above a line is an empty line, which separates a file's heading from its first rule.
Below the start of a block it is a line break, because no heading is there. DOMAIN and READING are not statements of the
model; a comment above them belongs, with a gap, to the statement after them.
"""

from __future__ import annotations

from array import array
from collections.abc import Collection, Sequence
from typing import NamedTuple

from sleec_runtime.model import NO_COMMENTS, Comments

INNER_GAP = "\n"
"""An empty line among comments below the start of a block."""


class RawComment(NamedTuple):
    """A comment with its marker, or one line of a longer comment: ``text[start:end]``, before the token `token`."""

    start: int
    end: int
    token: int


def attach_comments(
    comments: Sequence[RawComment],
    text: str,
    kinds: list[str],
    starts: array[int],
    ends: array[int],
    line_starts: Collection[str],
    settings: Collection[str],
    openings: Collection[str] = (),
) -> tuple[dict[int, Comments], tuple[str, ...]]:
    """The comments of each token that starts a line of rules, and those after the last one.

    `line_starts` are the kinds of token that start a line; those in `settings` have no comments of their own. Empty
    lines below one of `openings` do not separate a heading.
    """
    attached: dict[int, Comments] = {}
    pending: list[str] = []
    line = -1  # the token that starts the line of rules before the current comment
    seen = 0  # tokens before this one are done
    end_before = 0

    def attach_pending(token: int) -> None:
        """Attaches the pending comments to `token`, which starts a line of rules."""
        if kinds[token] in settings:
            _leave_gap(pending)
        elif is_divided(starts[token]):
            _leave_gap(pending, gap())
        if kinds[token] not in settings:
            before = attached.get(token, NO_COMMENTS)
            attached[token] = Comments(before.above + tuple(pending), before.behind)
            pending.clear()

    def is_divided(start: int) -> bool:
        """Whether an empty line ends before `start`."""
        return text.count("\n", end_before, start) > 1

    def gap() -> str:
        return INNER_GAP if line >= 0 and kinds[line] in openings else ""

    for comment in comments:
        while seen < comment.token:
            if kinds[seen] in line_starts:
                if pending:
                    attach_pending(seen)
                line = seen
            seen += 1
        content = _content(text, comment)
        behind = comment.token > 0 and "\n" not in text[max(ends[comment.token - 1], end_before) : comment.start]
        inside = kinds[comment.token] not in line_starts and kinds[comment.token] != "end"
        owner = line if line >= 0 and kinds[line] not in settings and (behind or inside) else -1
        if owner >= 0:
            before = attached.get(owner, NO_COMMENTS)
            if behind and before.behind is None:
                attached[owner] = Comments(before.above, content)
            else:
                attached[owner] = Comments((*before.above, content), before.behind)
        else:
            if pending and is_divided(comment.start):
                _leave_gap(pending, gap())
            pending.append(content)
            if behind:
                _leave_gap(pending)
        end_before = comment.end
    while pending and kinds[seen] != "end":
        if kinds[seen] in line_starts:
            attach_pending(seen)
        seen += 1
    return attached, tuple(pending)


def _content(text: str, comment: RawComment) -> str:
    marker = 2 if text.startswith("//", comment.start) else 1 if text[comment.start] == "#" else 0
    return text[comment.start + marker : comment.end].strip()


def _leave_gap(pending: list[str], gap: str = "") -> None:
    if pending[-1].strip():
        pending.append(gap)
