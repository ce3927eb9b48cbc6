"""Renamed rulesets: a deleted ruleset and a new one belong together if they are similar."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence

from sleec_runtime.errors import SleecError
from sleec_verify.changes.revisions.versions import Version, Versions

ALIKE = 0.5
"""The minimal share of equal lines of a renamed file, as in git."""

_MOST = 2_500
"""The maximal number of pairs that are compared line by line. Above it, only equal texts are paired."""


def with_renames(versions: Sequence[Versions]) -> tuple[list[Versions], Mapping[str, str]]:
    """The versions with renamed rulesets paired under their new paths, and the old path of each.

    Equal texts come first, then the most similar. O(texts), and O(pairs of deleted and new texts) up to a limit.
    """
    gone = {one.path: one for one in versions if one.new is None}
    new = {one.path: one for one in versions if one.old is None}
    before: dict[str, str] = {}
    if gone and new:
        for pairs in (_equal, _alike):
            for old, one in pairs(list(gone.values()), list(new.values())):
                if old.path in gone and one.path in new:
                    before[one.path] = old.path
                    del gone[old.path], new[one.path]
    was = {one.path: one.old for one in versions}
    taken = {*before.values()}
    found = [
        Versions(one.path, was[before[one.path]], one.new) if one.path in before else one
        for one in versions
        if one.path not in taken
    ]
    return found, before


_Pairs = Iterator[tuple[Versions, Versions]]


def _equal(gone: Sequence[Versions], new: Sequence[Versions]) -> _Pairs:
    """Pairs of equal texts, each paired once."""
    by_content: dict[str, list[Versions]] = {}
    for old in gone:
        if old.old is not None and old.old.blob is not None:
            by_content.setdefault(old.old.blob, []).append(old)
    digits = len(next(iter(by_content), ""))
    for one in new:
        content = None if one.new is None or not digits else one.new.named(digits)
        if content is not None and by_content.get(content):
            yield by_content[content].pop(0), one


def _alike(gone: Sequence[Versions], new: Sequence[Versions]) -> _Pairs:
    """The most similar first."""
    if len(gone) * len(new) > _MOST:
        return
    lines = {one.path: _lines(one.old or one.new) for one in (*gone, *new)}
    pairs = [(_share(lines[old.path], lines[one.path]), old, one) for old in gone for one in new]
    for share, old, one in sorted(pairs, key=lambda pair: -pair[0]):
        if share >= ALIKE:
            yield old, one


def _lines(place: Version | None) -> Counter[str]:
    """How often each line occurs; nothing if the text cannot be read, which is reported elsewhere."""
    if place is None:
        return Counter()
    try:
        return Counter(line.strip() for line in place.read().text.split("\n") if line.strip())
    except SleecError:
        return Counter()


def _share(one: Counter[str], other: Counter[str]) -> float:
    return (one & other).total() / max(one.total(), other.total(), 1)
