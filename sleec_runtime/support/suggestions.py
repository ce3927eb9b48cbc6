"""The nearest of some names to one that is not among them: 'did you mean …?'."""

from __future__ import annotations

from collections.abc import Collection, Iterable

# Comparing every unknown name with every known one is quadratic; past this many comparisons nothing is suggested.
_BUDGET = 50_000


class Suggester:
    """Suggests names, up to a fixed number of comparisons."""

    def __init__(self) -> None:
        self._left = _BUDGET

    def nearest(self, name: str, known: Collection[str]) -> str | None:
        """As the function `nearest`; None once the comparisons are used up."""
        self._left -= len(known)
        return nearest(name, known) if self._left >= 0 else None


def nearest(name: str, known: Iterable[str]) -> str | None:
    """The name of `known` with the least edit distance to `name`, at most a third of its letters; None if none is near.

    Case, underscores and spaces do not count: `user_undressed` is near `UserUndressed`.
    """
    plain = _plain(name)
    best, least = None, min(3, len(plain) // 3) + 1
    for candidate in known:
        other = _plain(candidate)
        if abs(len(other) - len(plain)) < least and candidate != name:
            distance = edit_distance(plain, other, least)
            if distance < least:
                best, least = candidate, distance
    return best


def did_you_mean(name: str | None) -> str:
    """The hint that suggests `name`, or an empty string."""
    return f"did you mean `{name}`?" if name else ""


def edit_distance(one: str, other: str, limit: int) -> int:
    """The Damerau-Levenshtein distance (insertions, deletions, replacements, swaps of neighbours), or `limit` if it is
    at least that."""
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
        if min(row) >= limit:
            return limit
    return row[-1]


def _plain(name: str) -> str:
    return name.casefold().replace("_", "").replace(" ", "").replace("-", "")
