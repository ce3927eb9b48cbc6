"""Names of a ruleset, read as words. `frontend/src/words.ts` does the same on the page."""

from __future__ import annotations

from functools import lru_cache
from unicodedata import category


@lru_cache(maxsize=4096)
def spoken(name: str) -> str:
    """A name as words: ``CurtainOpenRequest`` is ``curtain open request``, ``r_moderate`` is ``r moderate``. Acronyms
    keep their capital letters, and a phrase of several words stays as it is."""
    if " " in name or len(name) == 1:
        return name
    words = [""]
    for here, after in zip(name, name[1:] + " "):
        if category(here)[0] == "P" and here not in "'’":
            words.append("")
            continue
        if _begins_word(words[-1], here, after):
            words.append("")
        words[-1] += here
    return " ".join(word if len(word) > 1 and word.isupper() else word.lower() for word in words if word) or name


def _begins_word(word: str, here: str, after: str) -> bool:
    """Whether a new word begins at the character `here`. An acronym is in capital letters, and may have numbers."""
    if here.isupper():
        return not word.isupper() or after.islower()
    if here.isdecimal():
        return not (word.isupper() or word.isdecimal())
    return here.isalpha() and (word.isdecimal() or (len(word) > 1 and word.isupper()))


def is_phrase(name: str) -> bool:
    """Whether a name consists of several words in the text, such as ``the user calls``."""
    return " " in name
