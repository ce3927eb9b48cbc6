"""Comparisons in words: ``is under``, ``is at least``, ``is not``, ``exceeds``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple, Union

from sleec_runtime.model import NEGATED, Operator

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
_LONGEST_FIRST = sorted(_RELATIONS.items(), key=lambda entry: -len(entry[0]))
_VERBS: dict[str, Relation] = {"exceeds": ">", "equals": "="}


class ComparisonWords(NamedTuple):
    """What so many words after the name of a measure state about it."""

    relation: Relation
    words: int


def comparison_words(words: Sequence[str], lasting: bool) -> ComparisonWords | None:
    """The comparison at the start of these words; None if there is none. If `lasting`, it is about every instant, so
    that ``is never`` negates it."""
    if words[0] in _VERBS:
        return ComparisonWords(_VERBS[words[0]], 1)
    has_verb = words[0] in ("is", "are")
    at = int(has_verb)
    adverb = words[at] if has_verb and at < len(words) else ""
    is_negated = adverb == "not" or (lasting and adverb == "never")
    at += is_negated or (lasting and adverb == "always")
    form, relation = next(
        (entry for entry in _LONGEST_FIRST if tuple(words[at : at + len(entry[0])]) == entry[0]), ((), "=")
    )
    if not (form or has_verb):
        return None
    if not is_negated:
        return ComparisonWords(relation, at + len(form))
    return None if relation == "between" else ComparisonWords(NEGATED[relation], at + len(form))
