"""Comments in a text of rules, which an edit must not take for rules, or remove."""

from __future__ import annotations

import re
from collections import Counter
from functools import lru_cache

from sleec_runtime.model import Syntax

_COMMENT = {
    "english": re.compile(r"(?://|#)[^\n]*"),
    "dsl": re.compile(r"//[^\n]*|/\*(?s:.*?)\*/"),
}


@lru_cache(maxsize=4)
def blanked(text: str, syntax: Syntax) -> str:
    """The text with spaces in place of its comments, so that all offsets stay."""
    return _COMMENT[syntax].sub(lambda comment: re.sub(r"\S", " ", comment[0]), text)


def comment_around(text: str, offset: int, syntax: Syntax) -> int | None:
    """Where the comment begins that has text before and after an offset; None if there is no such comment."""
    found = (comment for comment in _COMMENT[syntax].finditer(text) if comment.start() < offset < comment.end())
    return next((comment.start() for comment in found), None)


def loses_comment(old: str, new: str, syntax: Syntax) -> bool:
    """Whether a text has a comment that the edited text does not have, wherever it is."""
    return bool(Counter(_COMMENT[syntax].findall(old)) - Counter(_COMMENT[syntax].findall(new)))
