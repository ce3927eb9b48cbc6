"""How well the words of a candidate fit the words of a name."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from math import log

from sleec_runtime.support.suggestions import edit_distance
from sleec_verify.audit.suggestion.candidates import Candidate, CandidateForm, stems_of

BELOW = stems_of("low empty near close cold dark weak slow small")
"""Words that mean that a number is below a bound."""
ABOVE = stems_of("high full far hot bright loud strong fast large much many")
"""Words that mean that a number is above a bound."""
_FILLERS = stems_of("is are has have the a an of to in on for by be")
_TYPE = 0.6
"""The weight of a word of the message type, relative to one of the topic or field."""
_ABBREVIATION = 0.8
_SLIP = 0.7


class Similarity:
    """Compares names with candidates. A word that many names have has a low weight (inverse document frequency)."""

    def __init__(self, names: Iterable[str], candidates: Sequence[Candidate]) -> None:
        self._candidates = candidates
        self._frequency = Counter(word for name in set(names) for word in stems_of(name))
        self._places: dict[str, list[int]] = {}
        for number, candidate in enumerate(candidates):
            for word in candidate.words | candidate.type_words:
                self._places.setdefault(word, []).append(number)
        self._alike: dict[str, dict[str, float]] = {}

    def scores(self, name: str, forms: Collection[CandidateForm]) -> Iterator[tuple[float, int]]:
        """The similarity of each candidate of these forms that has a word of the name, from 0 to 1, with its number.

        A weighted mean: 0.85 for the recall (the weighted share of the name's words that the candidate has), and 0.15
        for the precision (the share of the candidate's words that the name has).
        """
        words = stems_of(name) - _FILLERS
        alike = {word: (1 / (1 + log(1 + self._frequency[word])), self._words_like(word)) for word in words}
        numeric = [alike[word] for word in words - BELOW - ABOVE or words]
        places = {place for _, found in alike.values() for other in found for place in self._places[other]}
        for number in sorted(places):
            candidate = self._candidates[number]
            if candidate.form in forms:
                yield self._score(numeric if candidate.form == "number" else alike.values(), candidate), number

    def _score(self, alike: Iterable[tuple[float, Mapping[str, float]]], candidate: Candidate) -> float:
        """The similarity with words of these weights, each with the words like it."""
        total = covered = 0.0
        used = set()
        for weight, found in alike:
            best = 0.0
            for other in candidate.words:
                if other in found:
                    used.add(other)
                    best = max(best, found[other])
            for other in candidate.type_words:
                if other in found:
                    best = max(best, _TYPE * found[other])
            total += weight
            covered += weight * best
        return 0.85 * covered / total + 0.15 * (len(used) / len(candidate.words) if candidate.words else 0.0)

    def _words_like(self, word: str) -> dict[str, float]:
        """The words of candidates that are like `word`, and how much."""
        if word not in self._alike:
            compared = ((other, _match(word, other)) for other in self._places)
            self._alike[word] = {other: match for other, match in compared if match}
        return self._alike[word]


def _match(one: str, other: str) -> float:
    """The similarity of two words: equal, prefix of the other, or at edit distance 1."""
    if one == other:
        return 1.0
    shorter, longer = sorted((one, other), key=len)
    if len(shorter) >= 3 and longer.startswith(shorter):
        return _ABBREVIATION
    if len(shorter) >= 5 and edit_distance(one, other, 2) < 2:
        return _SLIP
    return 0.0
