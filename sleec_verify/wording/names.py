"""Names of a ruleset, read as words."""

from __future__ import annotations

import re
from functools import lru_cache

_WORD = re.compile(
    r"[^\W\d_a-z](?:[^\W_a-z])+(?=[A-Z][a-z])"  # an acronym before a word: HTTPServer
    r"|[^\W\d_]?[^\W\dA-Z_]+(?:['’][^\W\d_]+)*"  # a word, with a capital letter or without
    r"|[^\W\d_a-z][^\W_a-z]*"  # an acronym, or a letter with a number
    r"|\d+"
)


@lru_cache(maxsize=4096)
def spoken(name: str) -> str:
    """A name as words: ``CurtainOpenRequest`` is ``curtain open request``, ``r_moderate`` is ``r moderate``. Acronyms
    keep their capital letters, and a phrase of several words stays as it is."""
    if " " in name or len(name) == 1:
        return name
    words = _WORD.findall(name)
    return " ".join(word if len(word) > 1 and word.isupper() else word.lower() for word in words) or name


def is_phrase(name: str) -> bool:
    """Whether a name consists of several words in the text, such as ``the user calls``."""
    return " " in name
