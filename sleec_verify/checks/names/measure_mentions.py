"""Phrases about a declared measure that are not comparisons: `age is about 6`, `danger becomes high`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from sleec_runtime.model import Measure, Ruleset
from sleec_runtime.support.word_forms import ARTICLES, singular, words_of_each
from sleec_verify.checks.names.misreading import COMPARISON, Misreading
from sleec_verify.checks.names.word_lists import COMPARATORS, CONTRACTIONS, MODALS, NUMBERS
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import joined, sentence

_AMOUNTS = NUMBERS.keys() - {"one"}
_SAID = """
is are was were be been has have had becomes became gets got stays remains reaches does do did falls drops rises exceeds
equals of about around between not never no
"""
_VERBS = frozenset({*_SAID.split(), *MODALS, *CONTRACTIONS, *(words.split()[0] for words in COMPARATORS)})
"""What follows a measure in a sentence about its value."""


def measure_mentions(ruleset: Ruleset, conditions: Iterable[str], obligations: Iterable[str]) -> Iterator[Misreading]:
    """The conditions that name a measure and a number, one of its values, or a verb; and the obligations that begin
    with a measure and one of these."""
    declared = [measure for measure in ruleset.measures.values() if measure.declared]
    measure_of = dict(zip(map(_singulars, words_of_each(measure.name for measure in declared)), declared))
    for names, is_condition in ((conditions, True), (obligations, False)) if measure_of else ():
        names = list(names)
        for name, all_words in zip(names, words_of_each(names)):
            words = [word for word in all_words if word not in ARTICLES]
            measure = _measure_it_is_about(words, measure_of, anywhere=is_condition)
            if measure is not None:
                yield _misreading(name, measure, is_condition)


def _singulars(words: Iterable[str]) -> tuple[str, ...]:
    return tuple(map(singular, words))


def _measure_it_is_about(
    words: Sequence[str], measure_of: Mapping[tuple[str, ...], Measure], anywhere: bool
) -> Measure | None:
    plain = _singulars(words)
    longest = max(map(len, measure_of))
    for at in range(len(words) if anywhere else 1):
        for end in range(at + 1, min(at + longest, len(words)) + 1):
            measure = measure_of.get(plain[at:end])
            if measure is not None and _says_something(words[:at], words[end:], measure):
                return measure
    return None


def _says_something(before: Sequence[str], after: Sequence[str], measure: Measure) -> bool:
    """Whether the words around a measure are a number, one of its values, or a verb."""
    said = _AMOUNTS | {value.casefold() for value in measure.values}
    return any(word.isdecimal() or word in said for word in (*before, *after)) or (
        not before and bool(after) and after[0] in _VERBS
    )


def _misreading(name: str, measure: Measure, is_condition: bool) -> Misreading:
    message = sentence(
        "{name} names the measure {measure}, but is not a comparison", name=quoted(name), measure=quoted(measure.name)
    )
    if not is_condition:
        advice = sentence(
            "an obligation names what the robot does: write a comparison after AND in the trigger, or after UNLESS"
        )
        return Misreading(COMPARISON, name, message, advice)
    return Misreading(COMPARISON, name, message, comparison_advice(measure))


def comparison_advice(measure: Measure) -> str:
    """How to compare the measure, without a comparison that could say something else than the author means."""
    value = (
        sentence("one of its values ({values})", values=joined(", ", map(quoted, measure.values)))
        if measure.values
        else sentence("a number")
    )
    return sentence(
        "compare {measure} with {value} by an operator: `<`, `<=`, `=`, `!=`, `>=` or `>`; write "
        "NOT, AND or OR around comparisons",
        measure=quoted(measure.name),
        value=value,
    )
