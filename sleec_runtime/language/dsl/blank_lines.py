"""Empty lines between definitions, rules, claims and relations: where an author leaves some, one is kept.

As among comments, an empty string stands for it: the first of what is above the statement.
"""

from __future__ import annotations

import re
from array import array
from collections.abc import Collection

from sleec_runtime.model import NO_COMMENTS, Comments

_GAP = re.compile(r"[^\n]*\n[^\S\n]*\n")
"""The rest of a line and an empty one."""


def keep_gaps(
    text: str,
    kinds: list[str],
    starts: array[int],
    ends: array[int],
    comments: dict[int, Comments],
    statements: Collection[str],
    blocks: Collection[str],
) -> None:
    """Adds the gap above each token of a kind among `statements` to its comments; there is none below what opens a
    block, a kind among `blocks`."""
    for token, kind in enumerate(kinds):
        if kind in statements and token and kinds[token - 1] not in blocks:
            before, start = ends[token - 1], starts[token]
            if start - before > 1 and _GAP.match(text, before, start):
                own = comments.get(token, NO_COMMENTS)
                comments[token] = Comments(("", *own.above), own.behind)
