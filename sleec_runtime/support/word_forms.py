"""The words of a name, and their stems, so that names that differ only by grammar can be compared."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import lru_cache

ARTICLES = frozenset({"the", "a", "an"})
_IS_OR_ARE = {"are": "is", "were": "was", "has": "have"}
VERBS_OF_NUMBER = frozenset({*_IS_OR_ARE, *_IS_OR_ARE.values()})
"""The verbs that say whether one is meant, or several."""
_IRREGULAR = {
    **_IS_OR_ARE,
    "does": "do",
    "goes": "go",
    "children": "child",
    "people": "person",
    "men": "man",
    "women": "woman",
    "feet": "foot",
    "teeth": "tooth",
}
"""Forms of frequent words that do not follow a rule."""

_WORD = re.compile(r"[A-Z]?[^\W\d_A-Z]+(?:'[^\W\d_]+)*|[A-Z]+(?![^\W\d_A-Z])|[0-9]+|\n")
_CONSONANTS = re.compile("v+c+")


def words_of_each(names: Iterable[str]) -> list[tuple[str, ...]]:
    """The words of each name in small letters: those of a phrase, or the parts of ``CamelCase`` and ``snake_case``."""
    return [tuple(part.split()) for part in " ".join(_words(names)).split("\n")][1:-1]


@lru_cache(maxsize=4096)
def stems(name: str) -> str:
    """What names have in common that differ only by articles, case, number or the form of a verb."""
    return stems_of_each([name])[0][0]


def stems_of_each(names: Iterable[str]) -> tuple[list[str], Mapping[str, str]]:
    """The stems of the words of each name, without articles, as one text for each; and the stem of each word.

    All names are treated at once, so that most of the work is done inside Python's own loops.
    """
    stem_of = _Stems({**dict.fromkeys(ARTICLES, ""), "\n": "\n"})
    found = " ".join(filter(None, map(stem_of.__getitem__, _words(names)))).split("\n")
    return [text.strip() for text in found[1:-1]], stem_of


def singulars(name: str) -> list[str]:
    """What names have in common that differ only by articles, case, or singular and plural. `is` and `are` differ."""
    words = (word for word in words_of_each([name])[0] if word not in ARTICLES)
    return [word if word in VERBS_OF_NUMBER else _without_number(word) for word in words]


def _without_number(word: str) -> str:
    """The same text for `lady` and `ladies`, and for `box` and `boxes`. It need not be a word."""
    word = singular(word)
    if word.endswith("y"):
        return f"{word[:-1]}i"
    return word[:-1] if word.endswith(("xe", "che", "she")) else word


def _words(names: Iterable[str]) -> list[str]:
    """The words of names in small letters, with a line break before and after each name."""
    text = "\n".join(["", *names, ""]).replace("\u2019", "'")
    return " ".join(_WORD.findall(text)).casefold().split(" ")


class _Stems(dict[str, str]):
    """The stem of each word. A stem that is needed is added."""

    def __missing__(self, word: str) -> str:
        self[word] = found = stem(word)
        return found


def singular(word: str) -> str:
    """A word without the ending of the plural or of the third person (Porter 1980, step 1a)."""
    if word in _IRREGULAR:
        return _IRREGULAR[word]
    if len(word) < 3 or word.endswith("ss"):
        return word
    if word.endswith(("sses", "ies")):
        return word[:-2]
    return word.removesuffix("s")


def stem(word: str) -> str:
    """The stem of an English word without inflection (Porter 1980, steps 1 and 5): `take`, `takes` and `taking` have
    the same one. The stem is for comparison only: it need not be a word."""
    if word.isdecimal():
        return word
    word = singular(word)
    if len(word) < 3 or not word.isascii():
        return word
    if word.endswith("eed"):
        word = word[:-1] if _measure(word[:-3]) else word
    else:
        ending = next((e for e in ("ed", "ing") if word.endswith(e)), "")
        rest = word.removesuffix(ending)
        if ending and "v" in _shape(rest):
            word = _completed(rest)
    if word.endswith(("y", "i")) and "v" in _shape(word[:-1]):
        word = f"{word[:-1]}i"
    if word.endswith("e") and (_measure(word[:-1]) > 1 or (_measure(word[:-1]) == 1 and not _is_short(word[:-1]))):
        word = word[:-1]
    return word[:-1] if word.endswith("ll") and _measure(word) > 1 else word


def _completed(rest: str) -> str:
    """The word that has lost `ed` or `ing`: `hop` for `hopp`, `hope` for `hop`."""
    if rest.endswith(("at", "bl", "iz")):
        return f"{rest}e"
    if len(rest) > 1 and rest[-1] == rest[-2] and rest[-1] not in "aeioulsz":
        return rest[:-1]
    return f"{rest}e" if _measure(rest) == 1 and _is_short(rest) else rest


def _shape(word: str) -> str:
    """`c` for each consonant and `v` for each vowel. A `y` after a consonant is a vowel."""
    shape = ""
    for letter in word:
        shape += "v" if letter in "aeiou" or (letter == "y" and shape[-1:] == "c") else "c"
    return shape


def _measure(word: str) -> int:
    """How many groups of vowels a group of consonants follows."""
    return len(_CONSONANTS.findall(_shape(word)))


def _is_short(word: str) -> bool:
    return _shape(word)[-3:] == "cvc" and word[-1] not in "wxy"
