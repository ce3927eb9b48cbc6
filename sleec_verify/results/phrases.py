"""Situations, values and lists in plain words."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sleec_runtime.errors import SleecError
    from sleec_runtime.model import Clause, Context, Obligation, Rule, Value
    from sleec_verify.results.finding import Witness

_LONGEST_CONDITION = 80
"""The most characters of a condition in the name of an exception."""


def listed(names: Iterable[str], word: str = "and") -> str:
    """``a``, ``a and b``, ``a, b and c``, or with another `word`."""
    *most, last = names
    return f"{', '.join(most)} {word} {last}" if most else last


def counted(number: int, noun: str) -> str:
    """``1 rule``, ``2 rules``, ``no rules``."""
    return f"{number or 'no'} {noun}{'' if number == 1 else 's'}"


def in_domains(domains: Sequence[str]) -> str:
    """``; domain home``, ``; domains home and ward``; nothing for rules without domains."""
    return f"; domain{'' if len(domains) == 1 else 's'} {listed(domains)}" if domains else ""


def value_text(value: Value) -> str:
    """A value as the language writes it. A fraction without a finite decimal is written as ``1/3``."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, str)):
        return str(value)
    decimal = repr(float(value))
    from fractions import Fraction

    return decimal if "e" not in decimal and Fraction(decimal) == value else str(value)


def quoted(name: str) -> str:
    """A name in a message: in backticks."""
    return f"`{name}`"


def clause_name(rule: Rule, number: int) -> str:
    """A clause in a message: ``rule `a` `` for the default, ``the exception `UNLESS c` of rule `a` `` for a hedge."""
    if number == 0:
        return f"rule {quoted(rule.label)}"
    return f"{exception(list(rule.clauses())[number])} of rule {quoted(rule.label)}"


def exception(hedge: Clause) -> str:
    """A hedge in a message: ``the exception `UNLESS c` ``. A long condition is cut."""
    from sleec_runtime.language import print_formula

    assert hedge.condition is not None, "every hedge has a condition"
    condition = print_formula(hedge.condition)
    if len(condition) > _LONGEST_CONDITION:
        condition = f"{condition[: _LONGEST_CONDITION - 3]}..."
    return f"the exception {quoted(f'UNLESS {condition}')}"


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
        return f"the text has {counted(len(error.problems), 'problem')}"
    return error.message


def witness_text(witness: Witness) -> str:
    """``When `A` and `B` occur, `D` does not occur and `Age` is 15 (whatever else holds)``"""
    occurs = [occurring(witness.triggers)] if witness.triggers else []
    facts = [f"{quoted(name)} does not occur" for name in witness.absent]
    said = ", ".join([*occurs, *given(witness.conditions, facts)])
    return f"When {said} (whatever else holds)" if said else "In every situation"


def context_text(context: Context) -> str:
    """``When `A` occurs, `C` is true (if nothing else holds)``"""
    occurs = f"When {occurring(sorted(context.triggers)) if context.triggers else 'nothing occurs'}"
    return f"{', '.join([occurs, *given(context.conditions)])} (if nothing else holds)"


def occurring(triggers: Sequence[str]) -> str:
    """```A` occurs``, ```A` and `B` occur``"""
    return f"{listed(map(quoted, triggers))} {'occurs' if len(triggers) == 1 else 'occur'}"


def given(conditions: Mapping[str, Value], facts: Sequence[str] = ()) -> list[str]:
    """`facts` and the values of `conditions` as one phrase, in a list of one item; an empty list if there are none."""
    every = [*facts, *(f"{quoted(name)} is {value_text(value)}" for name, value in conditions.items())]
    return [listed(every)] if every else []
