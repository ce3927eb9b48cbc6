"""Phrases about a declared measure that are not comparisons: `age is about 6`, `danger becomes high`."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence

from sleec_runtime.model import Measure, Ruleset
from sleec_verify.checks.names.misreading import COMPARISON, Misreading
from sleec_verify.checks.names.word_forms import ARTICLES, singular, words_of_each
from sleec_verify.checks.names.word_lists import COMPARATORS, CONTRACTIONS, MODALS, NUMBERS
from sleec_verify.results.phrases import quoted

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
    measures = [measure for measure in ruleset.measures.values() if measure.declared]
    said = [[singular(word) for word in words] for words in words_of_each(measure.name for measure in measures)]
    for names, is_condition in ((conditions, True), (obligations, False)) if measures else ():
        names = list(names)
        for name, all_words in zip(names, words_of_each(names)):
            words = [word for word in all_words if word not in ARTICLES]
            for measure, measured in zip(measures, said):
                if _is_about(words, measured, {value.casefold() for value in measure.values}, is_condition):
                    yield _misreading(name, measure, is_condition)
                    break


def _is_about(words: Sequence[str], measured: Sequence[str], values: Collection[str], anywhere: bool) -> bool:
    starts = range(len(words) - len(measured) + 1 if anywhere else 1)
    length = len(measured)
    plain = [singular(word) for word in words]
    at = next((at for at in starts if plain[at : at + length] == measured), None) if measured else None
    if at is None:
        return False
    others = [*words[:at], *words[at + length :]]
    return any(word.isdecimal() or word in _AMOUNTS or word in values for word in others) or (
        at == 0 and bool(others) and others[0] in _VERBS
    )


def _misreading(name: str, measure: Measure, is_condition: bool) -> Misreading:
    message = f"{quoted(name)} names the measure {quoted(measure.name)}, but is not a comparison"
    if not is_condition:
        advice = "an obligation names what the robot does: write a comparison after AND in the trigger, or after UNLESS"
        return Misreading(COMPARISON, name, message, advice)
    return Misreading(COMPARISON, name, message, comparison_advice(measure))


def comparison_advice(measure: Measure) -> str:
    """How to compare the measure, without a comparison that could say something else than the author means."""
    value = f"one of its values ({', '.join(map(quoted, measure.values))})" if measure.values else "a number"
    return (
        f"compare {quoted(measure.name)} with {value} by an operator: `<`, `<=`, `=`, `!=`, `>=` or `>`; "
        "write NOT, AND or OR around comparisons"
    )
