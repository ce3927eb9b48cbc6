"""Comparisons in words: ``is under``, ``is at least``, ``is not``, ``exceeds``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple, Union

from sleec_runtime.model import Operator

Relation = Union[Operator, Literal["between"]]

_LESS = ("less", "lower", "smaller", "fewer")
_MORE = ("more", "greater", "higher", "larger")
_RELATIONS: dict[tuple[str, ...], Relation] = {
    **{(word,): "<" for word in ("under", "below")},
    **{(word,): ">" for word in ("over", "above")},
    **{(word, "than"): "<" for word in _LESS},
    **{(word, "than"): ">" for word in _MORE},
    **{(word, "than", "or", "equal", "to"): "<=" for word in _LESS},
    **{(word, "than", "or", "equal", "to"): ">=" for word in _MORE},
    **{("no", word, "than"): ">=" for word in _LESS},
    **{("no", word, "than"): "<=" for word in _MORE},
    ("at", "least"): ">=",
    ("at", "most"): "<=",
    ("equal", "to"): "=",
    ("exactly",): "=",
    ("between",): "between",
}
_VERBS: dict[str, Relation] = {"exceeds": ">", "equals": "="}
_OPPOSITES: dict[Relation, Operator] = {"<": ">=", "<=": ">", "=": "!=", "!=": "=", ">=": "<", ">": "<="}
_LONGEST = max(map(len, _RELATIONS))


class ComparisonWords(NamedTuple):
    """What so many words after the name of a measure state about it."""

    relation: Relation
    words: int


def comparison_words(words: Sequence[str], lasting: bool) -> ComparisonWords | None:
    """The comparison at the start of these words; None if there is none. If `lasting`, it is about every instant, so
    that ``is never`` negates it."""
    if words[0] in _VERBS:
        return ComparisonWords(_VERBS[words[0]], 1)
    at = 1 if words[0] in ("is", "are") else 0
    has_verb = at > 0
    negations = ("not", "never") if lasting else ("not",)
    is_negated = has_verb and words[at : at + 1] != [] and words[at] in negations
    at += is_negated or (has_verb and lasting and list(words[at : at + 1]) == ["always"])
    for length in range(_LONGEST, 0, -1):
        relation = _RELATIONS.get(tuple(words[at : at + length]))
        if relation is not None and len(words) >= at + length:
            return _negated(relation, at + length) if is_negated else ComparisonWords(relation, at + length)
    if not has_verb:
        return None
    return _negated("=", at) if is_negated else ComparisonWords("=", at)


def _negated(relation: Relation, words: int) -> ComparisonWords | None:
    opposite = _OPPOSITES.get(relation)
    return ComparisonWords(opposite, words) if opposite is not None else None
