"""Comparisons inside a phrase: `the child is under 6`, or a measure and its value."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator
from functools import cache
from typing import NamedTuple

from sleec_runtime.language.english.negations import is_clear
from sleec_runtime.model import NEGATED, Measure, Operator, Ruleset
from sleec_runtime.support.word_forms import ARTICLES, stems
from sleec_verify.checks.names.measure_mentions import comparison_advice
from sleec_verify.checks.names.misreading import COMPARISON, Misreading
from sleec_verify.checks.names.word_lists import (
    COMPARATORS,
    CONTRACTIONS,
    NUMBERS,
    PEOPLE,
    ROBOTS,
    UNITS,
)
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence

_DIGIT = re.compile("[0-9]")
_NUMBER = re.compile(r"-?[0-9]+(?:\.[0-9]+)?")
_IS = frozenset({"is", "are", "was", "were"})
_VERBS = _IS | {"be", "been", "there", "has", "have", "had", "falls", "drops", "rises", "goes", "gets", "for"}
_PRONOUNS = frozenset({"it", "this", "that"})
_NOT = frozenset({"not", "never"})
_DENYING = frozenset({"not", "hardly", "barely", "scarcely", "almost", "nearly", "without"})
_PAST = frozenset({"was", "were", "been", "had"})
_OF_AGES = frozenset({"year", "years", "old"})
_BESIDE = frozenset({"old", "of", "age", "here", "there", "away", "present", "left", "now", "current", "currently"})
"""Words beside a comparison that change nothing about it."""


class _Bound(NamedTuple):
    """`subject operator value`. `rest` are the words after it, `has_is` says that `is` is after the subject, and
    `negations` are the words `not` and `never` that the operator includes."""

    subject: list[str]
    operator: Operator
    value: str
    rest: list[str]
    has_is: bool
    negations: tuple[str, ...]


def comparisons(ruleset: Ruleset, names: Iterable[str], with_is: bool = True) -> Iterator[Misreading]:
    """The comparisons that phrases contain: with a number, a constant, or a value of the scale of a measure. `with_is`
    also finds `is` and a number, without a word that compares.

    A comparison has a text to write if it says all that the words of the phrase say.
    """
    values = {value for measure in ruleset.measures.values() for value in measure.values} | ruleset.constants.keys()
    for name in names:
        words = _without_contractions(name)
        has_value = not (NUMBERS.keys().isdisjoint(map(str.casefold, words)) and values.isdisjoint(words))
        if (has_value or _DIGIT.search(name)) and (
            found := _comparison(ruleset, values, name, words, with_is)
        ) is not None:
            yield found


def _without_contractions(name: str) -> list[str]:
    """The words of a phrase, with `is not` for `isn't`."""
    return [
        part
        for word in name.replace("\u2019", "'").split()
        for part in ((CONTRACTIONS[word.casefold()], "not") if word.casefold() in CONTRACTIONS else (word,))
    ]


def _comparison(
    ruleset: Ruleset, values: Collection[str], name: str, words: list[str], with_is: bool
) -> Misreading | None:
    for at in range(len(words)):
        bound = _bound(values, words, at, with_is)
        if bound is None:
            continue
        measure = _measure(ruleset, bound)
        if measure is not None:
            is_whole = _says_all(bound, words, stems(measure).split())
            return _with_measure(ruleset, name, measure, f"{measure} {bound.operator} {bound.value}", is_whole)
        if _NUMBER.fullmatch(bound.value):
            subject = _subject(bound) if _is_clear(bound) else ""
            written = f"{subject or 'amount'} {bound.operator} {bound.value}"
            declaration = f"MEASURE {subject or 'amount'}: number"
            is_whole = _says_all(bound, words, stems(subject).split())
            text = quoted(written) if is_whole or not subject else sentence("comparisons of it")
            advice = sentence(
                "compare a measure: declare, for example, {declaration}, and write {text}",
                declaration=quoted(declaration),
                text=text,
            )
            message = sentence("{name} is read as one name, not as a comparison", name=quoted(name))
            return Misreading(COMPARISON, name, message, advice, written if subject and is_whole else None)
    return _value_before_measure(ruleset, name)


def _says_all(bound: _Bound, all_words: list[str], measure: list[str]) -> bool:
    """Whether a comparison says all that the words around it say, beside whose measure it is. `never` and `was` say
    something about other instants, too. An age is in years."""
    around = [*bound.subject, *bound.rest]
    words = stems(" ".join(word.removesuffix("'s") for word in around)).split()
    said = {*_stems_beside_a_comparison(), *measure}
    if not _PAST.isdisjoint(map(str.casefold, all_words)) or (measure == stems("age").split() and _other_units(bound)):
        return False
    return bound.negations in ((), ("not",)) and all(word in said for word in words)


def _is_clear(bound: _Bound) -> bool:
    """Whether no word around a comparison denies or counts: `not`, `all`, `or`."""
    around = [word.casefold() for word in (*bound.subject, *bound.rest) if word.casefold() not in UNITS]
    return is_clear(around) and _DENYING.isdisjoint(around)


def _other_units(bound: _Bound) -> bool:
    """Whether the value has a unit that is not the one of ages."""
    return any(word.casefold() in UNITS - _OF_AGES for word in bound.rest)


@cache
def _stems_beside_a_comparison() -> frozenset[str]:
    return frozenset(stems(" ".join([*PEOPLE, *ROBOTS, *UNITS, *_VERBS, *_PRONOUNS, *_BESIDE])).split())


def _with_measure(ruleset: Ruleset, name: str, measure: str, written: str, is_whole: bool) -> Misreading:
    message = sentence(
        "{name} is read as one name, not as a comparison of the measure {measure}",
        name=quoted(name),
        measure=quoted(measure),
    )
    if is_whole:
        return Misreading(COMPARISON, name, message, sentence("write {written}", written=quoted(written)), written)
    return Misreading(COMPARISON, name, message, comparison_advice(ruleset.measures[measure]))


def _bound(values: Collection[str], words: list[str], at: int, with_is: bool) -> _Bound | None:
    """The comparison whose value is the word at this place."""
    word = words[at]
    value = word if _NUMBER.fullmatch(word) else str(NUMBERS.get(word.casefold(), ""))
    if not value:
        if word not in values:
            return None
        value = word
    before = [part.casefold() for part in words[:at]]
    while before and before[-1] in ARTICLES:
        before.pop()
    length = next((n for n in (3, 2, 1) if " ".join(before[-n:]) in COMPARATORS and n <= len(before)), 0)
    if length:
        operator = COMPARATORS[" ".join(before[-length:])]
    elif with_is and word.casefold() not in NUMBERS and before and before[-1] in _IS | _NOT:
        operator = "="
    else:
        return None
    before = before[: len(before) - length]
    has_is = not _IS.isdisjoint(before[-2:])
    removed: list[str] = []
    while before and before[-1] in _VERBS | _NOT:
        removed.append(before.pop())
    negations = tuple(word for word in removed if word in _NOT)
    if len(negations) % 2:
        operator = NEGATED[operator]
    return _Bound(words[: len(before)], operator, value, words[at + 1 :], has_is, negations)


def _measure(ruleset: Ruleset, bound: _Bound) -> str | None:
    """The measure that a bound is about: its name begins or ends the subject, or is the rest."""
    subject, rest = stems(" ".join(bound.subject)), stems(" ".join(bound.rest))
    for name, measure in ruleset.measures.items():
        if not _fits(ruleset, measure, bound.value):
            continue
        said = stems(name)
        if f"{subject} ".startswith(f"{said} ") or f" {subject}".endswith(f" {said}") or rest == said:
            return name
    if _subject(bound) != "age":
        return None
    return next((name for name, m in ruleset.measures.items() if m.kind != "scale" and name.casefold() == "age"), None)


def _fits(ruleset: Ruleset, measure: Measure, value: str) -> bool:
    return value in measure.values if measure.kind == "scale" else value in ruleset.constants or value[-1].isdecimal()


def _subject(bound: _Bound) -> str:
    """A name for a measure that is not declared, or an empty text: `age` of people, what is counted, or the subject."""
    words, rest = (
        [word.removesuffix("'s") for word in map(str.casefold, part) if word not in ARTICLES | _VERBS | _PRONOUNS]
        for part in (bound.subject, bound.rest)
    )
    counted = next((word for word in rest[:1] if word not in UNITS), None)
    if counted is None and words and words[-1] in PEOPLE | {"age"}:
        return "" if _other_units(bound) and words[-1] != "age" else "age"
    if counted is not None and (not words or words[-1] in PEOPLE or not bound.has_is):
        return counted
    return "_".join(words) or {"year": "age", "years": "age", "o'clock": "hour"}.get("".join(rest[:1]), "")


def _value_before_measure(ruleset: Ruleset, name: str) -> Misreading | None:
    """`high danger`, if `danger` is a measure and `high` one of its values."""
    words = [word for word in name.split() if word.casefold() not in ARTICLES | _VERBS]
    for measure in ruleset.measures.values():
        if words and words[0] in measure.values and stems(" ".join(words[1:])) == stems(measure.name):
            return _with_measure(ruleset, name, measure.name, f"{measure.name} = {words[0]}", True)
    return None
