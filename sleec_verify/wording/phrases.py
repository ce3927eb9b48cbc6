"""Situations, values and lists in plain words."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Protocol

from sleec_runtime.language.common.formula_printer import print_number
from sleec_verify.wording.sentence import Sentence, joined, plural, sentence

if TYPE_CHECKING:
    from sleec_runtime.errors import SleecError
    from sleec_runtime.model import Clause, Context, Obligation, Rule, Value

_MOST_NAMES = 5
"""The most names in a list that is cut."""
_LONGEST_CONDITION = 80
"""The most characters of a condition in the name of an exception."""


class Situation(Protocol):
    """A witness: the triggers that occur, the relevant conditions, and the triggers that must be absent."""

    @property
    def triggers(self) -> Sequence[str]: ...

    @property
    def conditions(self) -> Mapping[str, Value]: ...

    @property
    def absent(self) -> Sequence[str]: ...


def listed(names: Iterable[str]) -> str:
    """``a``, ``a and b``, ``a, b and c``."""
    *most, last = names
    return sentence("{names} and {last}", names=joined(", ", most), last=last) if most else last


def first_of(names: Sequence[str]) -> str:
    """``a, b``; of more than five names, the first five: ``a, b, c, d, e and 2 more``"""
    first = joined(", ", names[:_MOST_NAMES])
    if len(names) <= _MOST_NAMES:
        return first
    return sentence("{names} and {number} more", names=first, number=len(names) - _MOST_NAMES)


def counted(number: int, noun: str) -> str:
    """``1 rule``, ``2 rules``, ``no rules``. `noun` must be a literal, because a test compares the templates that are
    made of it with the catalogues."""
    if number == 0:
        return Sentence(f"no {noun}s", {})
    return Sentence(f"{{number}} {noun}", {"number": number}, f"{{number}} {noun}s", number)


def grouped(number: int) -> str:
    """A number of situations with separators: ``1,234,567``."""
    first, *groups = f"{number:,}".split(",")
    for group in groups:
        first = sentence("{thousands},{rest}", thousands=first, rest=group)
    return first


def in_domains(domains: Sequence[str]) -> str:
    """``; domain home``, ``; domains home and ward``; nothing for rules without domains."""
    if not domains:
        return ""
    return plural(len(domains), "; domain {domains}", "; domains {domains}", domains=listed(domains))


def value_text(value: Value) -> str:
    """A value as the language writes it. A number without a finite decimal is written as ``1/3``."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return value if isinstance(value, str) else print_number(value)


def quoted(name: str) -> str:
    """A name in a message: in backticks."""
    return f"`{name}`"


def kind_words(kind: str) -> str:
    """The kind of a name in a sentence."""
    words = {
        "event": sentence("event"),
        "trigger": sentence("trigger"),
        "condition": sentence("condition"),
        "obligation": sentence("obligation"),
        "measure": sentence("measure"),
        "constant": sentence("constant"),
        "domain": sentence("domain"),
    }
    return words[kind]


def clause_name(rule: Rule, number: int) -> str:
    """A clause in a message: ``rule `a` `` for the default, ``the exception `UNLESS c` of rule `a` `` for a hedge."""
    if number == 0:
        return sentence("rule {rule}", rule=quoted(rule.label))
    return sentence(
        "{exception} of rule {rule}", exception=exception(list(rule.clauses())[number]), rule=quoted(rule.label)
    )


def exception(hedge: Clause) -> str:
    """A hedge in a message: ``the exception `UNLESS c` ``. A long condition is cut."""
    from sleec_runtime.language import print_formula

    assert hedge.condition is not None, "every hedge has a condition"
    condition = print_formula(hedge.condition)
    if len(condition) > _LONGEST_CONDITION:
        condition = f"{condition[: _LONGEST_CONDITION - 3]}..."
    return sentence("the exception {text}", text=quoted(f"UNLESS {condition}"))


def shortened(text: str) -> str:
    """Text that a user typed, cut to 40 characters."""
    return f"{text[:37]}..." if len(text) > 40 else text


def in_short(obligation: Obligation) -> str:
    """A literal with its window, if it has one: ``NOT Speak within 5 minutes``."""
    return f"{obligation}{'' if obligation.timing is None else f' {obligation.timing}'}"


def error_summary(error: SleecError) -> str:
    """An error in one line. For problems in a text, their number."""
    from sleec_runtime.errors import LanguageError

    if isinstance(error, LanguageError):
        return plural(len(error.problems), "the text has {number} problem", "the text has {number} problems")
    return error.message


def witness_text(witness: Situation) -> str:
    """``When `A` and `B` occur, `D` does not occur and `Age` is 15 (whatever else holds)``"""
    occurs = [occurring(witness.triggers)] if witness.triggers else []
    facts = [sentence("{name} does not occur", name=quoted(name)) for name in witness.absent]
    said = [*occurs, *given(witness.conditions, facts)]
    if not said:
        return sentence("In every situation")
    return sentence("When {facts} (whatever else holds)", facts=joined(", ", said))


def context_text(context: Context) -> str:
    """``When `A` occurs, `C` is true (if nothing else holds)``"""
    occurs = occurring(sorted(context.triggers)) if context.triggers else sentence("nothing occurs")
    return sentence("When {facts} (if nothing else holds)", facts=joined(", ", [occurs, *given(context.conditions)]))


def occurring(triggers: Sequence[str]) -> str:
    """```A` occurs``, ```A` and `B` occur``"""
    return plural(len(triggers), "{names} occurs", "{names} occur", names=listed(map(quoted, triggers)))


def given(conditions: Mapping[str, Value], facts: Sequence[str] = ()) -> list[str]:
    """`facts` and the values of `conditions` as one phrase, in a list of one item; an empty list if there are none."""
    every = [*facts, *map(has_value, conditions, conditions.values())]
    return [listed(every)] if every else []


def has_value(name: str, value: Value) -> str:
    """```Age` is 15``, ```Asleep` is true``"""
    return sentence("{name} is {value}", name=quoted(name), value=value_words(value))


def value_words(value: Value) -> str:
    """A value in a sentence: like `value_text`, with truth values as words that are translated."""
    if isinstance(value, bool):
        return sentence("true") if value else sentence("false")
    return value_text(value)


def happening(events: Sequence[str], conditions: Mapping[str, Value]) -> str:
    """What happens at an instant: ```A` and `B` occur while `C` is true``."""
    occurs = occurring(events) if events else sentence("nothing occurs")
    facts = given(conditions)
    return sentence("{events} while {facts}", events=occurs, facts=facts[0]) if facts else occurs
