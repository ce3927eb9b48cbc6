"""Names that differ only by an article, case or number, and names that may be slips."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping
from itertools import combinations, permutations

from sleec_runtime.model import DeclaredKind, Ruleset
from sleec_runtime.support.suggestions import edit_distance
from sleec_runtime.support.word_forms import VERBS_OF_NUMBER, singulars, stem, stems_of_each
from sleec_verify.checks.names.frequent_words import FREQUENT_WORDS
from sleec_verify.checks.names.misreading import KINDS, SIMILAR, SLIP, Misreading
from sleec_verify.checks.names.word_lists import OPPOSITES
from sleec_verify.encoding.name_places import name_places
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence

Used = Mapping[DeclaredKind, Collection[str]]
"""The names of each kind."""

_SHORTEST = 5
"""The fewest letters of the longer of two words that may be one. Many shorter words differ by one letter."""
_SERIES = 8
"""More words than this that differ in one letter are a series, such as `sensora`, `sensorb`, `sensorc`."""


def variants(ruleset: Ruleset, used: Used, declared: Collection[str]) -> list[Misreading]:
    """Each name that is a variant of another one: of a declared one, or of the more frequent one.

    The form of a verb or one letter often makes another word. So such a name counts only if it is used once, and the
    other one more often; and not in the DSL, where both have a definition.
    """
    names = {name for kind in KINDS for name in used[kind]}
    stems, stem_of = stems_of_each(names)
    groups: dict[str, list[str]] = {}
    for stemmed, name in zip(stems, names):
        groups.setdefault(stemmed, []).append(name)
    groups.pop("", None)  # names without letters and digits
    related = [group for group in groups.values() if len(group) > 1]
    slips = ruleset.syntax != "dsl"
    misspelled = [(groups[one], groups[other]) for one, other in _misspelled(groups, stem_of)] if slips else []
    involved = {name for group in (*related, *(group for pair in misspelled for group in pair)) for name in group}
    if not involved:
        return []
    places = name_places(ruleset, involved)
    uses = {name: len(places.get(name, ())) for name in involved}
    rank = {name: (name not in declared, -uses[name], places.get(name), name) for name in involved}
    found = []
    for wrong, right in misspelled:
        if sum(uses[name] for name in wrong) == 1 < sum(uses[name] for name in right):
            found.append((min(right, key=rank.__getitem__), wrong[0], SLIP))
    for group in related:
        first, *others = sorted(group, key=rank.__getitem__)
        kept_of = {tuple(singulars(first)): first}
        for name in others:
            kept = kept_of.setdefault(tuple(singulars(name)), name)
            if kept != name:
                found.append((kept, name, SIMILAR))
            elif slips and uses[name] == 1 < uses[first] and _is_slip(name, first, used):
                found.append((first, name, SLIP))
    return [_misreading(kind, name, kept) for kept, name, kind in sorted(found)]


def _misreading(kind: int, name: str, kept: str) -> Misreading:
    message = sentence("{name} and {kept} are read as two different names", name=quoted(name), kept=quoted(kept))
    return Misreading(
        kind,
        name,
        message,
        sentence("if you mean the same, write {kept} in both places", kept=quoted(kept)),
        kept,
        kept,
    )


def _is_slip(name: str, other: str, used: Used) -> bool:
    """Whether an author may have meant one name: two obligations that begin with forms of one verb, or two names of one
    kind with `is` and `are`. Other forms of verbs say different things: `is closed` and `is closing`."""
    pairs = list(zip(singulars(name), singulars(other)))
    kinds = [kind for kind in KINDS if name in used[kind] and other in used[kind]]
    first = 1 if "obligation" in kinds else 0
    return bool(kinds) and all(one == two or {one, two} <= VERBS_OF_NUMBER for one, two in pairs[first:])


def _misspelled(groups: Collection[str], stem_of: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    """Pairs of groups whose names differ by one letter of one long word that only the first group has.

    Two words with an edit distance of one have a common part that lacks at most one letter of each (Mor and Fraenkel
    1982). So the pairs are found in linear time. The first letter is rarely wrong (Pollock and Zamora 1984), and often
    distinguishes two words, such as `left light` and `left right`. A frequent word is not a misspelling.
    """
    long_words = [word for word in stem_of if len(word) >= _SHORTEST - 1 and word.isalpha() and word not in OPPOSITES]
    near: dict[str, list[str]] = defaultdict(list)
    for word in long_words:
        for at in range(1, len(word) + 1):
            near[word[:at] + word[at + 1 :]].append(word)
    pairs = {
        tuple(sorted((stem_of[one], stem_of[other])))
        for words in near.values()
        if len(words) <= _SERIES
        for one, other in combinations(words, 2)
        if max(len(one), len(other)) >= _SHORTEST
        and stem_of[one] != stem_of[other]
        and edit_distance(one, other, 2) == 1
        and not _look_alike(one, other)
    }
    containing: dict[str, list[list[str]]] = {word: [] for pair in pairs for word in pair}
    for group in groups if pairs else ():
        words = group.split()
        for word in containing.keys() & set(words):
            containing[word].append(words)
    frequent = {stem(word) for word in FREQUENT_WORDS} if pairs else frozenset[str]()
    for wrong, right in (each for pair in pairs for each in permutations(pair)):
        if wrong not in frequent and len(containing[wrong]) == 1:
            (words,) = containing[wrong]
            changed = " ".join(right if word == wrong else word for word in words)
            if changed in groups:
                yield " ".join(words), changed


def _look_alike(one: str, other: str) -> bool:
    """Whether the words look alike, which the check `confusable` reports."""
    if one.isascii() and other.isascii():
        return False
    from sleec_verify.checks.skeleton import skeleton

    return skeleton(one) == skeleton(other)
