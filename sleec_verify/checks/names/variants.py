"""Names that differ only by an article, case, number, the form of a verb, or one letter."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping
from itertools import combinations

from sleec_runtime.model import Ruleset
from sleec_runtime.support.suggestions import edit_distance
from sleec_verify.checks.names.misreading import SIMILAR, Misreading
from sleec_verify.checks.names.word_forms import singulars, stem, stems, words_of
from sleec_verify.checks.names.word_lists import OPPOSITES
from sleec_verify.encoding.name_places import name_places
from sleec_verify.results.phrases import quoted

Kinds = Mapping[str, frozenset[str]]
"""The kinds of each name: trigger, condition, obligation."""

_SHORTEST = 5
"""The fewest letters of the longer of two words that may be one. Many shorter words differ by one letter."""


def variants(ruleset: Ruleset, kinds: Kinds, declared: Collection[str]) -> Iterator[Misreading]:
    """Each name that is a variant of another one: of a declared one, or of the more frequent one."""
    groups: dict[tuple[str, ...], list[str]] = defaultdict(list)
    for name in kinds:
        groups[stems(name)].append(name)
    related = [group for group in groups.values() if len(group) > 1]
    misspelled = [(groups[one], groups[other]) for one, other in _misspelled(groups)]
    involved = {name for group in (*related, *(group for pair in misspelled for group in pair)) for name in group}
    if not involved:
        return
    places = name_places(ruleset, involved)
    rank = {name: (name not in declared, -len(places[name]), places[name]) for name in places}
    for group in related:
        group.sort(key=rank.__getitem__)
        for at, name in enumerate(group):
            kept = next((other for other in group[:at] if _is_variant(name, other, kinds)), None)
            if kept is not None:
                yield _misreading(name, kept)
    for pair in misspelled:
        kept, name = sorted((group[0] for group in pair), key=rank.__getitem__)
        yield _misreading(name, kept)


def _misreading(name: str, kept: str) -> Misreading:
    message = f"{quoted(name)} and {quoted(kept)} are two different names"
    return Misreading(SIMILAR, name, message, f"if you mean the same, write {quoted(kept)} in both places", kept, kept)


def _is_variant(name: str, other: str, kinds: Kinds) -> bool:
    """Names of different kinds, such as the event `the door opens` and the condition `the door opened`, may differ by
    the form of the verb."""
    return not kinds[name].isdisjoint(kinds[other]) or singulars(name) == singulars(other)


def _misspelled(groups: Mapping[tuple[str, ...], list[str]]) -> Iterator[tuple[tuple[str, ...], tuple[str, ...]]]:
    """Pairs of groups whose names differ by one letter of one long word.

    Two words with an edit distance of one have a common part that lacks at most one letter of each (Mor and Fraenkel
    1982). So the pairs are found in linear time. The first letter is rarely wrong (Pollock and Zamora 1984), and often
    distinguishes two words, such as `left light` and `left right`.
    """
    containing: dict[str, list[tuple[str, ...]]] = defaultdict(list)
    stem_of: dict[str, str] = {}
    for group, names in groups.items():
        for word in words_of(names[0]):
            if len(word) >= _SHORTEST - 1 and word.isalpha() and word not in OPPOSITES:
                stem_of.setdefault(word, stem(word))
                containing[stem(word)].append(group)
    near: dict[str, list[str]] = defaultdict(list)
    for word in stem_of:
        for at in range(1, len(word) + 1):
            near[word[:at] + word[at + 1 :]].append(word)
    pairs = {
        tuple(sorted((stem_of[one], stem_of[other])))
        for words in near.values()
        for one, other in combinations(words, 2)
        if max(len(one), len(other)) >= _SHORTEST
        and stem_of[one] != stem_of[other]
        and edit_distance(one, other, 2) == 1
        and not _look_alike(one, other)
    }
    for one, other in sorted(pairs):
        for group in dict.fromkeys(containing[one]):
            changed = tuple(other if word == one else word for word in group)
            if changed in groups:
                yield group, changed


def _look_alike(one: str, other: str) -> bool:
    """Whether the words look alike, which the check `confusable` reports."""
    if one.isascii() and other.isascii():
        return False
    from sleec_verify.checks.skeleton import skeleton

    return skeleton(one) == skeleton(other)
