"""Words that say more to people than to the rules."""

from __future__ import annotations

from collections.abc import Mapping

from sleec_runtime.model import Operator
from sleec_verify.wording.sentence import sentence

_NEGATED_VERBS = """
do does did is are was were has have must should could would might may need
"""
_SPELLED_OUT = {f"{verb}n't": verb for verb in _NEGATED_VERBS.split()} | {
    "can't": "can",
    "won't": "will",
    "shan't": "shall",
    "shalln't": "shall",
}
CONTRACTIONS = {"cannot": "can", **_SPELLED_OUT, **{word.replace("'", ""): _SPELLED_OUT[word] for word in _SPELLED_OUT}}
"""Verbs that contain a negation, with and without an apostrophe, and the verb without it."""

NEGATIONS = frozenset({"not", "never", "no", *CONTRACTIONS})
MODALS = frozenset({"must", "shall", "should", "may", "might", "can", "could", "will", "would", "ought"})
PERMISSIONS = frozenset({"may", "might", "can", "could", "allowed", "permitted", "able", "free"})
"""Words that say what the robot need not do."""
NOT_DUTIES = frozenset(
    {"could", "would", "might", "need", "needs", "has", "have", "required", "obliged", "able", "free"}
)
"""With a negation, these need not say that something is forbidden: `the robot need not leave`."""
AUXILIARIES = frozenset({"do", "does", "did"})
ROBOTS = ("robot", "system", "agent", "machine", "it", "he", "she", "they", "you", "we")
"""The subjects of a sentence about what the robot does."""

_COMPLEMENTS = """
open closed, on off, awake asleep, present absent, inside outside, indoors outdoors, alive dead, true false,
allowed forbidden, enabled disabled, alone accompanied, valid invalid, visible invisible, active inactive,
complete incomplete, correct incorrect, possible impossible, legal illegal, somebody nobody, something nothing
"""
_CONTRARIES = """
full empty, day night, light dark, healthy ill, near far, wet dry, left right, begins ends, starts stops,
standing sitting, everybody nobody, everything nothing
"""


def _pairs(text: str) -> dict[str, str]:
    return {one: other for pair in text.split(",") for one, other in (pair.split(), reversed(pair.split()))}


COMPLEMENTS = {**_pairs(_COMPLEMENTS), "someone": "nobody"}
"""Words that exclude each other, where one of the two is always true."""
OPPOSITES = {**_pairs(_CONTRARIES), **COMPLEMENTS}
"""Words that exclude each other."""
NEGATING_PREFIXES = ("un", "dis", "non")
"""A word with one of these before it is the opposite of that word."""

COMPARATORS: Mapping[str, Operator] = {
    **dict.fromkeys(("under", "below", "less than", "fewer than", "younger than", "lower than", "smaller than"), "<"),
    **dict.fromkeys(("colder than", "shorter than", "beneath"), "<"),
    **dict.fromkeys(("at most", "no more than", "up to", "no greater than", "no higher than", "no older than"), "<="),
    **dict.fromkeys(("over", "above", "more than", "greater than", "older than", "higher than", "larger than"), ">"),
    **dict.fromkeys(("warmer than", "hotter than", "longer than", "exceeds", "exceeding"), ">"),
    **dict.fromkeys(("at least", "no less than", "no fewer than", "no lower than", "no younger than"), ">="),
    **dict.fromkeys(("exactly", "equal to", "equals"), "="),
}
"""Words that compare, and their operators."""

_UP_TO_TWENTY = """
zero one two three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen sixteen seventeen
eighteen nineteen twenty
"""
_TENS = "thirty forty fifty sixty seventy eighty ninety hundred"
NUMBERS = {
    **{word: number for number, word in enumerate(_UP_TO_TWENTY.split())},
    **{word: number for number, word in zip(range(30, 110, 10), _TENS.split())},
}
"""Numbers in words."""

_PEOPLE = """
child children user patient person resident guest man woman boy girl pupil student visitor customer baby he she client
driver passenger
"""
PEOPLE = frozenset(_PEOPLE.split())
"""Whom a bound on a number most likely says the age of."""

_UNITS = """
year years old month months week weeks day days hour hours minute minutes second seconds o'clock degrees degree percent
metres meters metre meter centimetres cm m km kg kilograms grams g litres liters
"""
UNITS = frozenset(_UNITS.split())
"""What follows a number and is not counted."""

FOREIGN = {
    **dict.fromkeys(("BUT", "ALTHOUGH"), sentence("leave it out, write AND, or write UNLESS before an exception")),
    **dict.fromkeys(
        ("IMMEDIATELY", "NOW", "ASAP", "INSTANTLY"),
        sentence("leave it out: without WITHIN, the obligation is due at once"),
    ),
    **dict.fromkeys(("DO", "PLEASE", "ALSO"), sentence("leave it out")),
    **dict.fromkeys(
        ("MUST", "SHALL", "SHOULD", "WILL"),
        sentence("leave it out: the robot must do what follows THEN or IN WHICH CASE"),
    ),
    **dict.fromkeys(
        ("MAY", "CAN", "OPTIONALLY"),
        sentence("leave it out, and say with UNLESS when the robot need not do it: a rule cannot permit an action"),
    ),
    "FOR": sentence("write NOT and WITHIN for a prohibition that lasts, for example: NOT play music WITHIN 5 minutes"),
    "AFTER": sentence("write WITHIN and two times for an earliest time, for example: WITHIN 5 TO 10 minutes"),
    "BEFORE": sentence("write WITHIN for a deadline, for example: WITHIN 5 minutes"),
    "BY": sentence("write WITHIN for a deadline, for example: WITHIN 5 minutes"),
    "IMPLIES": sentence("write NOT and OR: `NOT a OR b` says that a implies b"),
    "XOR": sentence("write both cases: `(a AND NOT b) OR (NOT a AND b)`"),
    "NOR": sentence("write AND NOT"),
    **dict.fromkeys(("ELSEIF", "ELIF", "ELSIF", "ENDIF", "END"), sentence("write one UNLESS for each exception")),
    **dict.fromkeys(("ONCE", "UPON", "GIVEN"), sentence("write WHEN before the trigger, and AND before a condition")),
    **dict.fromkeys(
        ("PROVIDED", "ASSUMING"), sentence("write AND and the condition before THEN, or UNLESS NOT after it")
    ),
    "EQUALS": sentence("write = to compare a measure"),
    **dict.fromkeys(
        ("WITNESSES", "EXCLUDES", "PRECEDES", "CAUSES", "INCLUDES", "FORBIDS", "OPPOSES"),
        sentence("it is a keyword only in a RELATION"),
    ),
}
"""Words in capitals that look like keywords and are none in a rule, and what to write instead."""

OUTSIDE_OBLIGATIONS = {
    **dict.fromkeys(
        ("FOR", "AFTER", "BEFORE", "BY"),
        sentence("leave the time out, or declare a measure for it and compare it, for example: minutes_asleep > 5"),
    ),
    **dict.fromkeys(("MUST", "SHALL", "SHOULD", "WILL", "MAY", "NOW", "IMMEDIATELY", "ASAP"), sentence("leave it out")),
}
"""What to write instead in a trigger or condition, where it is something else."""

SUPERFLUOUS = frozenset(
    {
        "BUT",
        "ALTHOUGH",
        "IMMEDIATELY",
        "NOW",
        "ASAP",
        "INSTANTLY",
        "DO",
        "PLEASE",
        "ALSO",
        "MUST",
        "SHALL",
        "SHOULD",
        "WILL",
    }
)
"""Those without which an obligation says the same."""
