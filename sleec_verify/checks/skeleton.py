"""Skeletons of words: equal for words that look alike (Unicode Technical Standard #39)."""

from __future__ import annotations

import re
from collections.abc import Iterable
from unicodedata import decomposition, name, normalize

from sleec_verify.checks.unicode_confusables import LOOKALIKES
from sleec_verify.wording.phrases import first_of

_INVISIBLE = "\u034f\u115f\u1160\u3164\uffa0"
"""The invisible characters that a name may contain."""
_LATIN = {ord(other): plain for plain, others in LOOKALIKES.items() for other in others}
_SHAPES = {
    **_LATIN,
    **dict.fromkeys(map(ord, _INVISIBLE), ""),
    **{
        ord(character): shape for character, shape in (("1", "l"), ("I", "l"), ("0", "O"), ("m", "rn"), ("\u2019", "'"))
    },
}
_TOGETHER = (
    frozenset({"LATIN", "CJK", "HIRAGANA", "KATAKANA"}),
    frozenset({"LATIN", "CJK", "BOPOMOFO"}),
    frozenset({"LATIN", "CJK", "HANGUL"}),
)
"""Scripts that one word may mix: those of Japanese, Chinese and Korean, each with Latin."""


def skeleton(word: str) -> str:
    """A text that is the same for words that look the same."""
    return word.translate(_SHAPES) if word.isascii() else normalize("NFKD", word).translate(_SHAPES)


def odd_characters(word: str) -> list[str]:
    """The invisible characters of a name, and the variants of plain letters: full-width and mathematical ones."""
    return [c for c in word if c in _INVISIBLE or (c.isalpha() and _is_variant(c))]


def _is_variant(letter: str) -> bool:
    if letter.isascii() or normalize("NFKC", letter) == letter:
        return False
    return not decomposition(letter).startswith(("<sub>", "<super>"))


def plain(word: str) -> str:
    """A name without its odd characters."""
    return normalize("NFKC", "".join(c for c in word if c not in _INVISIBLE))


def foreign_letters(word: str) -> list[str]:
    """The letters of another script than the others, if letters of several scripts are adjacent."""
    return [c for part in re.split(r"[\W\d_]+", word) if not part.isascii() for c in _foreign(part)]


def _foreign(part: str) -> list[str]:
    letters = [c for c in part if c.isalpha()]
    scripts = {_script(c) for c in letters}
    if len(scripts) < 2 or any(scripts <= together for together in _TOGETHER):
        return []
    main = "LATIN" if "LATIN" in scripts else _script(letters[0])
    # A Greek letter before a Latin name is a symbol, unless it looks like a Latin letter.
    symbols = scripts == {"LATIN", "GREEK"}
    return [c for c in letters if _script(c) != main and not (symbols and ord(c) not in _LATIN)]


def _script(letter: str) -> str:
    """The script of a letter, with which its name begins."""
    script = name(letter, "").partition(" ")[0]
    return "CJK" if script == "IDEOGRAPHIC" else script


def described(characters: Iterable[str]) -> str:
    """``U+041E CYRILLIC CAPITAL LETTER O``, each once; only the first of many."""
    found = [f"U+{ord(c):04X} {name(c, '')}".rstrip() for c in dict.fromkeys(characters)]
    return first_of(found)
