"""What helps where people write what other languages, or plain words, would have there."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from sleec_runtime.language.common.units import UNITS
from sleec_runtime.language.dsl.keywords import KEYWORDS
from sleec_runtime.support.suggestions import nearest

COMPARING = frozenset(
    {
        *("is", "are", "equals", "equal", "greater", "less", "more", "above", "below", "over", "under", "between"),
        *("exceeds", "at", "in", "higher", "lower", "larger", "smaller", "reaches", "has"),
    }
)
"""Words that people write for a comparison."""

_WHEN = frozenset({"when", "if", "whenever", "once", "on"})

_WORDS = ("one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve")
_NUMBERS: Mapping[str, int] = {
    **{word: number for number, word in enumerate(_WORDS, 1)},
    **dict.fromkeys(("a", "an"), 1),
    **dict(zip(("fifteen", "twenty", "thirty", "sixty"), (15, 20, 30, 60))),
}

_COMPARE = "compare with =, <>, <, <=, > or >=, as in: temperature > 30"
_WINDOW = "by when a response is due is said by within, as in: within 5 minutes"
_UNLESS = "an exception begins with unless, as in: unless userAsleep then Wait"
_NO_UNIT = "numbers in conditions have no unit; leave it out"
_AT_ONCE = "without a window, a response is due at once; leave it out"
_BEHIND_RESPONSE: Mapping[str, str] = {
    **dict.fromkeys(("in", "after", "before", "by", "with", "withing", "during"), _WINDOW),
    **dict.fromkeys(("except", "if", "but", "when", "provided", "only"), _UNLESS),
    **dict.fromkeys(("immediately", "now", "at", "directly"), _AT_ONCE),
    "always": "leave it out",
    "other": "did you mean otherwise?",
    **dict.fromkeys(("until", "for"), f"a response happens at one time; {_WINDOW}"),
    **dict.fromkeys(
        ("while", "whilst", "meanwhile"), "what must hold stands behind the trigger: when Event and condition"
    ),
    "as": "whose event it is, its definition says: event Response as system",
    "and": "a response is one event: write a rule for each",
    ",": "leave it out; a response is one event, and a second one needs a rule of its own",
    "then": "a rule has one then, and each unless may have one",
    "(": "only conditions have parentheses; a comment starts with //",
}
_BEFORE_EVENT: Mapping[str, str] = {
    **dict.fromkeys(("never", "no", "don", "dont", "cannot"), "write not before the event: not Response"),
    **dict.fromkeys(("do", "the", "immediately", "always", "to", "please"), "write the name of the event alone"),
}
_AS_TYPE: Mapping[str, str] = {
    **dict.fromkeys(("bool", "truth", "flag", "Bool"), "boolean"),
    **dict.fromkeys(("int", "integer", "number", "real", "float", "natural", "num"), "numeric"),
}


_BEFORE_MEASURE: Mapping[str, str] = {
    **dict.fromkeys(("no", "none", "never"), "write not before the measure"),
    **dict.fromkeys(("either", "both", "the", "any"), "leave it out"),
}
MEANT: Mapping[str, tuple[str, ...]] = {
    "unless or the next rule": ("within", "eventually", "otherwise", "else", "unless"),
    "and, or or then": ("and", "or", "then"),
    "then and a response": ("and", "or", "then"),
}
"""The keywords that a misspelt one may be, where what else comes is expected."""


class Found(NamedTuple):
    """A token that is not what is expected, with the kind of the one before it and the text of the one behind it."""

    begins_line: bool
    before: str
    kind: str
    written: str
    after: str


def help_with(what: str, found: Found) -> str | None:
    """What to do about `found` where `what` is expected, if that can be told."""
    written = found.written
    if written == "-" and found.after == "-":
        return "comments start with //"
    if "definition" in what:
        return _in_definitions(found)
    if found.kind == "{" and what in ("the next concern", "the next purpose"):
        return "a condition stands behind and: c1 exists Event and {condition}"
    if what in ("unless or the next rule", "the next concern", "the next purpose"):
        if found.before == "word" and found.kind in ("number", "digits"):
            return "write one length of time, in the smaller unit, as in: within 90 minutes"
        return _BEHIND_RESPONSE.get(written.lower())
    if what in ("and, or or then", "then and a response"):
        return _behind_condition(what, found)
    if what == "a condition":
        return _instead_of_condition(found)
    if what.startswith("the name of") and found.kind == "(":
        return "write the name without parentheses"
    if what.startswith("a number or a name") and found.kind == "digits":
        return _NO_UNIT
    if what.startswith("a number or a name") and found.kind in ("operator", "strange"):
        return "write the sign without a blank inside, one of =, <>, <, <=, > or >="
    if what.startswith("a length of time") and written[:1].isdigit() and found.kind == "digits":
        return "write a blank between the number and the unit, as in: within 5 minutes"
    return None


def means_when(word: str) -> bool:
    """Whether a word that is no keyword stands for the `when` of a rule."""
    plain = word.lower()
    return plain in _WHEN or (plain not in KEYWORDS and nearest(plain, ("when",)) is not None)


def type_meant(written: str) -> str | None:
    """The type of a measure that is called so elsewhere."""
    return _AS_TYPE.get(written.lower())


def before_event(written: str) -> str | None:
    """What to do about a word that stands before the name of an event, where that is due."""
    return _BEFORE_EVENT.get(written.lower())


def before_measure(written: str) -> str | None:
    """What to do about a word that stands before the name of a measure, where that is due."""
    return _BEFORE_MEASURE.get(written.lower())


def _in_definitions(found: Found) -> str | None:
    written = found.written
    if written == ",":
        return "write a definition for each name"
    if written == ":" and found.before == "word":
        return "an event has no type; what is true or false is a measure, as in: measure userAtHome: boolean"
    if written == "=":
        return "only a constant has a value in the definitions; leave it out"
    if written in ("-", "+", "/", ".") and found.before == "word":
        return "a name has letters, digits and _ only, as in: event SmokeDetected"
    if written == "by":
        return "whose event it is stands behind as: as system, or as environment"
    if found.kind == "word" and found.before == "word" and not found.begins_line:
        return "a name is one word, as in: event SmokeDetected"
    return None


def _behind_condition(what: str, found: Found) -> str | None:
    written = found.written
    if written.lower() in COMPARING:
        return _COMPARE
    if found.before == "number" and (found.kind in ("word", "strange") and written != "then"):
        return _NO_UNIT
    if found.before == "number" and written in (",", ".") and found.after[:1].isdigit():
        return "write the number in digits only, as in: 1000"
    if found.kind in ("number", "digits"):
        return "write the number in digits only, as in: 1000" if found.before == "number" else _COMPARE
    if written in ("->", "=>", ":") or written.lower() in ("do", "must", "should"):
        return "write then before the response"
    if written == ",":
        return "write no comma; before the response stands then"
    if written == "unless":
        return "first comes what is due otherwise: R1 when Event then Response unless condition"
    if written.lower() in ("xor", "nor", "but"):
        return "conditions are joined by and and or, with not before what must not hold"
    if found.kind in ("word", "not", "(", "{") and what == "then and a response":
        return "as in: R1 when Event and condition then Response"
    if found.kind in ("word", "not", "(", "{"):
        return "and or or stands between two conditions, and then before the response"
    return None


def _instead_of_condition(found: Found) -> str | None:
    if found.kind == "operator":
        return "write the name of a measure before it, as in: temperature > 20 and temperature < 30"
    if found.kind == "[":
        return "conditions have parentheses: ( and )"
    if found.written == "then":
        return "say what must hold, as in: unless userAsleep then Wait" if found.before == "unless" else None
    return None


def unit_for(written: str) -> str | None:
    """What to write for a unit that there is none of."""
    word = written.lower()
    if word in ("week", "weeks", "month", "months", "year", "years"):
        return "the longest unit is days: 1 week is 7 days"
    if word in ("to", "and", "or"):
        return "the two ends of a window stand in brackets, as in: within [5, 10] minutes"
    if word in ("milliseconds", "ms", "millisecond", "msec"):
        return "the shortest unit is seconds"
    return None


def number_for(written: str, unit: str) -> str | None:
    """A length of time whose number is written as a word."""
    number = _NUMBERS.get(written.lower())
    return f"write the number in digits: within {number} {unit}" if number is not None and unit in UNITS else None
