"""Situations, values and lists in plain words."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sleec_runtime.model import Value
    from sleec_verify.finding import Witness


def listed(names: Iterable[str]) -> str:
    """``a``, ``a and b``, ``a, b and c``."""
    *most, last = names
    return f"{', '.join(most)} and {last}" if most else last


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


def situation(triggers: Sequence[str], conditions: Mapping[str, Value]) -> str:
    """``When A and B occur, C is true and Age is 15``, without a full stop."""
    if not triggers:
        occurs = "Whatever occurs"
    else:
        occurs = f"When {listed(map(quoted, triggers))} {'occurs' if len(triggers) == 1 else 'occur'}"
    given = [f"{quoted(name)} is {value_text(value)}" for name, value in conditions.items()]
    if not given:
        return occurs
    return f"{occurs}{',' if triggers else ' and'} {listed(given)}"


def witness_text(witness: Witness) -> str:
    """The situation of a witness as one sentence."""
    return f"{situation(witness.triggers, witness.conditions)} (the rest does not matter)"
