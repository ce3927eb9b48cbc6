"""A ruleset that has moved is the same ruleset: one that is gone and one that is new belong together if alike."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from sleec_runtime.errors import SleecError
from sleec_verify.revisions import Place, Versions

ALIKE = 0.5
"""The share of lines that a file has kept at least, if it has moved; git takes the same."""

_MOST = 2_500
"""Pairs that are looked into. Of more, only those of equal texts are put together."""


def with_renames(versions: Sequence[Versions]) -> tuple[list[Versions], Mapping[str, str]]:
    """The versions with what has moved put together under its new path, and the old path of each that has.

    Equal texts first, then the most alike. O(pairs of a file that is gone and one that is new, and their lines).
    """
    gone = [one for one in versions if one.new is None]
    new = [one for one in versions if one.old is None]
    moved: dict[str, Versions] = {}
    pairs: list[tuple[float, Versions, Versions]] = []
    if gone and new:
        pairs = [(1.0, old, one) for one in new for old in gone if Versions(one.path, old.old, one.new).unchanged]
        if len(gone) * len(new) <= _MOST:
            lines = {one.path: _lines(one.old or one.new) for one in (*gone, *new)}
            alike = ((_alike(lines[old.path], lines[one.path]), old, one) for old in gone for one in new)
            pairs += sorted((pair for pair in alike if pair[0] >= ALIKE), key=lambda pair: -pair[0])
    taken: set[str] = set()
    for _, old, one in pairs:
        if old.path not in taken and one.path not in moved:
            taken.add(old.path)
            moved[one.path] = Versions(one.path, old.old, one.new)
    found = [moved.get(one.path, one) for one in versions if one.path not in taken]
    before = {one.path: old.path for old in gone for one in moved.values() if one.old == old.old}
    return found, before


def _lines(place: Place | None) -> Counter[str]:
    """How often each line stands there; none of what cannot be read, which is told where it is read."""
    if place is None:
        return Counter()
    try:
        return Counter(line.strip() for line in place.read().text.split("\n") if line.strip())
    except SleecError:
        return Counter()


def _alike(one: Counter[str], other: Counter[str]) -> float:
    return (one & other).total() / max(one.total(), other.total(), 1)
