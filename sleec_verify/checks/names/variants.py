"""Names that differ only by an article, case, number, the form of a verb, or one letter."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping
from itertools import combinations

from sleec_runtime.model import DeclaredKind, Ruleset
from sleec_runtime.support.suggestions import edit_distance
from sleec_verify.checks.names.frequent_words import FREQUENT_WORDS
from sleec_verify.checks.names.misreading import KINDS, SIMILAR, Misreading
from sleec_verify.checks.names.word_forms import singulars, stem, stems_of_each
from sleec_verify.checks.names.word_lists import OPPOSITES
from sleec_verify.encoding.name_places import name_places
from sleec_verify.results.phrases import quoted

Used = Mapping[DeclaredKind, Collection[str]]
"""The names of each kind."""

_SHORTEST = 5
"""The fewest letters of the longer of two words that may be one. Many shorter words differ by one letter."""


def variants(ruleset: Ruleset, used: Used, declared: Collection[str]) -> list[Misreading]:
    """Each name that is a variant of another one: of a declared one, or of the more frequent one."""
    names = {name for kind in KINDS for name in used[kind]}
    stems, stem_of = stems_of_each(names)
    groups: dict[str, list[str]] = {}
    for stemmed, name in zip(stems, names):
        groups.setdefault(stemmed, []).append(name)
    groups.pop("", None)  # names without letters and digits
    related = [group for group in groups.values() if len(group) > 1]
    misspelled = [(groups[one], groups[other]) for one, other in _misspelled(groups, stem_of)]
    involved = {name for group in (*related, *(group for pair in misspelled for group in pair)) for name in group}
    if not involved:
        return []
    places = name_places(ruleset, involved)
    rank = {name: (name not in declared, -len(places.get(name, ())), places.get(name), name) for name in involved}
    pairs = [sorted((min(group, key=rank.__getitem__) for group in pair), key=rank.__getitem__) for pair in misspelled]
    for group in related:
        group.sort(key=rank.__getitem__)
        for at, name in enumerate(group):
            pairs += [[kept, name] for kept in group[:at] if _is_variant(name, kept, used)][:1]
    return [_misreading(name, kept) for kept, name in sorted(pairs)]


def _misreading(name: str, kept: str) -> Misreading:
    message = f"{quoted(name)} and {quoted(kept)} are read as two different names"
    return Misreading(SIMILAR, name, message, f"if you mean the same, write {quoted(kept)} in both places", kept, kept)


def _is_variant(name: str, other: str, used: Used) -> bool:
    """Names of different kinds, such as the event `the door opens` and the condition `the door opened`, may differ by
    the form of the verb."""
    return any(name in used[kind] and other in used[kind] for kind in KINDS) or singulars(name) == singulars(other)


def _misspelled(groups: Collection[str], stem_of: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    """Pairs of groups whose names differ by one letter of one long word.

    Two words with an edit distance of one have a common part that lacks at most one letter of each (Mor and Fraenkel
    1982). So the pairs are found in linear time. The first letter is rarely wrong (Pollock and Zamora 1984), and often
    distinguishes two words, such as `left light` and `left right`. Neither of two frequent words is a misspelling.
    """
    long_words = [word for word in stem_of if len(word) >= _SHORTEST - 1 and word.isalpha() and word not in OPPOSITES]
    near: dict[str, list[str]] = defaultdict(list)
    for word in long_words:
        for at in range(1, len(word) + 1):
            near[word[:at] + word[at + 1 :]].append(word)
    frequent = (
        {stem(word) for word in FREQUENT_WORDS} if any(len(words) > 1 for words in near.values()) else frozenset[str]()
    )
    pairs = {
        tuple(sorted((stem_of[one], stem_of[other])))
        for words in near.values()
        for one, other in combinations(words, 2)
        if max(len(one), len(other)) >= _SHORTEST
        and stem_of[one] != stem_of[other]
        and not {stem_of[one], stem_of[other]} <= frequent
        and edit_distance(one, other, 2) == 1
        and not _look_alike(one, other)
    }
    containing: dict[str, list[list[str]]] = {one: [] for one, _ in pairs}
    for group in groups if pairs else ():
        words = group.split()
        for word in containing.keys() & set(words):
            containing[word].append(words)
    for one, other in pairs:
        for words in containing[one]:
            changed = " ".join(other if word == one else word for word in words)
            if changed in groups:
                yield " ".join(words), changed


def _look_alike(one: str, other: str) -> bool:
    """Whether the words look alike, which the check `confusable` reports."""
    if one.isascii() and other.isascii():
        return False
    from sleec_verify.checks.skeleton import skeleton

    return skeleton(one) == skeleton(other)
