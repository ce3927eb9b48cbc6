"""Blank lines between statements: where an author leaves some, one is kept.

As in comments, it is an empty string: the first of the comments above the statement.
"""

from __future__ import annotations

import re
from array import array
from collections.abc import Collection

from sleec_runtime.model import NO_COMMENTS, Comments

_GAP = re.compile(r"[^\n]*\n[^\S\n]*\n")
"""The rest of a line and an empty line."""


def keep_blank_lines(
    text: str,
    kinds: list[str],
    starts: array[int],
    ends: array[int],
    comments: dict[int, Comments],
    statements: Collection[str],
    blocks: Collection[str],
) -> None:
    """Adds the gap above each token of a kind in `statements` to its comments, except directly below a kind in
    `blocks`."""
    for token, kind in enumerate(kinds):
        if kind in statements and token and kinds[token - 1] not in blocks:
            before, start = ends[token - 1], starts[token]
            if start - before > 1 and _GAP.match(text, before, start):
                own = comments.get(token, NO_COMMENTS)
                comments[token] = Comments(("", *own.above), own.behind)
