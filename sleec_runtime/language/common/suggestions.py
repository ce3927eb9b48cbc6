"""The nearest of some names to one that is not among them: 'did you mean …?'."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from sleec_runtime.language.english.keywords import GUESSED, STATEMENTS

# Comparing every unknown name with every known one is quadratic; past this many comparisons nothing is suggested.
_BUDGET = 50_000


class Suggester:
    """Suggests names, and stops doing so before it becomes slow."""

    def __init__(self) -> None:
        self._left = _BUDGET

    def nearest(self, name: str, known: Collection[str]) -> str | None:
        """The name of `known` that `name` most likely means, if any is near enough."""
        self._left -= len(known)
        return nearest(name, known) if self._left >= 0 else None


def nearest(name: str, known: Iterable[str]) -> str | None:
    """The name of `known` that differs least from `name`, by at most a third of its letters; None if none is near.

    Capitals, underscores and blanks count for little: `user_undressed` is near `UserUndressed`.
    """
    plain = _plain(name)
    best, least = None, min(3, len(plain) // 3) + 1
    for candidate in known:
        other = _plain(candidate)
        if abs(len(other) - len(plain)) < least and candidate != name:
            distance = edits(plain, other, least)
            if distance < least:
                best, least = candidate, distance
    return best


def near_keyword(word: str, starts_line: bool = False) -> str | None:
    """The keyword that a word in capitals is a misspelling of, if it is near one; any statement's, if it starts a line.

    Short keywords are near only to themselves with two letters swapped or one doubled (`ADN`, `ORR`), because `ER` or
    `ICU` in a phrase is no misspelling.
    """
    if word in _SLIPS:
        return _SLIPS[word]
    for keyword in _GUESSED_AT_LINE_START if starts_line else _GUESSED:
        if abs(len(keyword) - len(word)) > 2:
            continue
        if len(keyword) <= 4:
            if _swapped(word, keyword) or _doubled(word, keyword):
                return keyword
        elif edits(word, keyword, 3) <= (1 if len(keyword) < 7 else 2):
            return keyword
    return None


_GUESSED = sorted(GUESSED, key=lambda keyword: (-len(keyword), keyword))
_GUESSED_AT_LINE_START = sorted(GUESSED | STATEMENTS, key=lambda keyword: (-len(keyword), keyword))
_SLIPS = {
    **dict.fromkeys(("THN", "TEN", "HEN"), "THEN"),
    **dict.fromkeys(("WEN", "WHN", "WHENEVER"), "WHEN"),
    **dict.fromkeys(("EXCEPT",), "UNLESS"),
}
"""Words in capitals that people write for a keyword, though their letters are not near it."""


def _swapped(word: str, keyword: str) -> bool:
    if len(word) != len(keyword) or word == keyword:
        return False
    at = next(i for i in range(len(word)) if word[i] != keyword[i])
    return word[at : at + 2] == keyword[at : at + 2][::-1] and word[at + 2 :] == keyword[at + 2 :]


def _doubled(word: str, keyword: str) -> bool:
    return len(word) == len(keyword) + 1 and any(keyword[: i + 1] + keyword[i:] == word for i in range(len(keyword)))


def _plain(name: str) -> str:
    return name.casefold().replace("_", "").replace(" ", "").replace("-", "")


def edits(one: str, other: str, enough: int) -> int:
    """How many letters to insert, delete, replace or swap with their neighbour to turn `one` into `other`; counting
    stops at `enough`."""
    shortest = min(len(one), len(other))
    same = next((i for i in range(shortest) if one[i] != other[i]), shortest)
    one, other = one[same:], other[same:]
    shortest -= same
    same = next((i for i in range(shortest) if one[-1 - i] != other[-1 - i]), shortest)
    one, other = one[: len(one) - same], other[: len(other) - same]
    before: list[int] = []
    row = list(range(len(other) + 1))
    for i, letter in enumerate(one, 1):
        before, above, row = row, before, [i]
        for j, against in enumerate(other, 1):
            cost = min(before[j] + 1, row[j - 1] + 1, before[j - 1] + (letter != against))
            if i > 1 and j > 1 and letter == other[j - 2] and one[i - 2] == against:
                cost = min(cost, above[j - 2] + 1)
            row.append(cost)
        if min(row) >= enough:
            return enough
    return row[-1]
