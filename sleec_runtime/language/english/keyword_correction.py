"""The keyword that a word in capitals is a misspelling of."""

from __future__ import annotations

from sleec_runtime.language.english.keywords import GUESSED, STATEMENTS
from sleec_runtime.support.suggestions import edit_distance

_SYNONYMS = {
    **dict.fromkeys(("THN", "TEN", "HEN"), "THEN"),
    **dict.fromkeys(("WEN", "WHN", "WHENEVER"), "WHEN"),
    **dict.fromkeys(("EXCEPT",), "UNLESS"),
}
"""Words in capitals that people write for a keyword, though the edit distance is too large."""


def _longest_first(keywords: frozenset[str]) -> list[str]:
    return sorted(keywords, key=lambda keyword: (-len(keyword), keyword))


_ANYWHERE = _longest_first(GUESSED)
_AT_LINE_START = _longest_first(GUESSED | STATEMENTS)


def near_keyword(word: str, starts_line: bool = False) -> str | None:
    """The keyword that a word in capitals is near; a keyword that starts a statement only if the word starts a line.

    Short keywords are near only to themselves with two letters swapped or one doubled (`ADN`, `ORR`), because `ER` or
    `ICU` in a phrase is not a misspelling.
    """
    if word in _SYNONYMS:
        return _SYNONYMS[word]
    for keyword in _AT_LINE_START if starts_line else _ANYWHERE:
        if abs(len(keyword) - len(word)) > 2:
            continue
        if len(keyword) <= 4:
            if _swaps_letters(word, keyword) or _doubles_letter(word, keyword):
                return keyword
        elif edit_distance(word, keyword, 3) <= (1 if len(keyword) < 7 else 2):
            return keyword
    return None


def _swaps_letters(word: str, keyword: str) -> bool:
    if len(word) != len(keyword) or word == keyword:
        return False
    at = next(i for i in range(len(word)) if word[i] != keyword[i])
    return word[at : at + 2] == keyword[at : at + 2][::-1] and word[at + 2 :] == keyword[at + 2 :]


def _doubles_letter(word: str, keyword: str) -> bool:
    return len(word) == len(keyword) + 1 and any(keyword[: i + 1] + keyword[i:] == word for i in range(len(keyword)))
