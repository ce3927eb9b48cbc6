"""Situations, values and lists in plain words."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sleec_runtime.errors import SleecError
    from sleec_runtime.model import Context, Obligation, Value
    from sleec_verify.results.finding import Witness


def listed(names: Iterable[str]) -> str:
    """``a``, ``a and b``, ``a, b and c``."""
    *most, last = names
    return f"{', '.join(most)} and {last}" if most else last


def counted(number: int, noun: str) -> str:
    """``1 rule``, ``2 rules``, ``no rules``."""
    return f"{number or 'no'} {noun}{'' if number == 1 else 's'}"


def in_domains(domains: Sequence[str]) -> str:
    """``; domain home``, ``; domains home and ward``; nothing for rules without domains."""
    return f"; domain{'' if len(domains) == 1 else 's'} {listed(domains)}" if domains else ""


def value_text(value: Value) -> str:
    """A value as the language writes it; a fraction that is no finite decimal as ``1/3``."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, str)):
        return str(value)
    decimal = repr(float(value))
    from fractions import Fraction

    return decimal if "e" not in decimal and Fraction(decimal) == value else str(value)


def quoted(name: str) -> str:
    """A name as it is; a phrase, which would blend with the sentence, in quotes."""
    return f'"{name}"' if " " in name else name


def shortened(text: str) -> str:
    """What someone typed, cut as the messages of the language cut it, so that a message stays one."""
    return f"{text[:37]}..." if len(text) > 40 else text


def in_short(obligation: Obligation) -> str:
    """A literal with when it is due, if that is said: ``NOT Speak within 5 minutes``"""
    return f"{obligation}{'' if obligation.timing is None else f' {obligation.timing}'}"


def error_summary(error: SleecError) -> str:
    """What is wrong with an input; its problems are counted."""
    from sleec_runtime.errors import LanguageError

    if isinstance(error, LanguageError):
        return f"this is not a ruleset: {counted(len(error.problems), 'problem')}"
    return error.message


def witness_text(witness: Witness) -> str:
    """``When A and B occur, D does not occur and Age is 15 (the rest does not matter)``"""
    occurs = f"When {occurring(witness.triggers)}" if witness.triggers else "Whatever occurs"
    facts = [f"{quoted(name)} does not occur" for name in witness.absent]
    return f"{', '.join([occurs, *given(witness.conditions, facts)])} (the rest does not matter)"


def context_text(context: Context) -> str:
    """``When A occurs, C is true (and all else is false)``"""
    occurs = f"When {occurring(sorted(context.triggers)) if context.triggers else 'nothing occurs'}"
    return f"{', '.join([occurs, *given(context.conditions)])} (and all else is false)"


def occurring(triggers: Sequence[str]) -> str:
    """``A occurs``, ``A and B occur``"""
    return f"{listed(map(quoted, triggers))} {'occurs' if len(triggers) == 1 else 'occur'}"


def given(conditions: Mapping[str, Value], facts: Sequence[str] = ()) -> list[str]:
    """The conditions, and other `facts` before them, as one phrase, or none."""
    every = [*facts, *(f"{quoted(name)} is {value_text(value)}" for name, value in conditions.items())]
    return [listed(every)] if every else []
