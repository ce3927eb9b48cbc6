"""Situations as people type them: ``--when Fall,Night --given "UserAsleep, not Undressed, UserAge=15"``."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_runtime.errors import SleecError
from sleec_verify.results.phrases import shortened

if TYPE_CHECKING:
    from sleec_runtime.model import Context, Measure, Ruleset, Value

_NUMBER = re.compile(r"[+-]?[0-9]{1,100}(\.[0-9]{1,100})?")
_COMPARES = re.compile(r"[<>\u2264\u2265\u2260]|!=")
_TRUTHS = {"true": True, "false": False}


class SituationError(SleecError):
    """A situation that does not fit the ruleset: an unknown name, a value of another type, a contradiction."""


def parse_situation(ruleset: Ruleset, when: str, given: str) -> Context:
    """The context in which the triggers listed in `when` occur and what `given` lists is the case.

    `when` is a list of triggers, `given` one of ``Name``, ``not Name``, ``Name=true`` and ``Measure=value``, both
    separated by commas. Phrases are names. Numbers are exact; a constant of the ruleset may stand for its number.

    Raises:
        SituationError: the first item that does not fit, with what would.
    """
    from sleec_runtime.model import Context

    triggers = frozenset(_trigger(ruleset, name) for name in _items(when))
    values: dict[str, Value] = {}
    for item in _items(given):
        name, value = parse_assignment(ruleset, item)
        if name in values and values[name] != value:
            raise SituationError(f"two values are given for {name}", "give one")
        values[name] = value
    return Context(triggers, values)


def _items(text: str) -> Iterator[str]:
    """The items of a list. Blanks within an item count as one, as they do in the rules."""
    return (" ".join(item.split()) for item in text.split(",") if item.strip())


def _triggers(ruleset: Ruleset) -> frozenset[str]:
    """What can occur: in rules with time every event, also those that only a relation, a concern or a purpose names."""
    if not ruleset.is_timed:
        return ruleset.triggers
    from sleec_runtime.model import Atom, leaves
    from sleec_verify.encoding.mentioned_names import names_beside_rules

    events, formulas, _ = names_beside_rules(ruleset)
    named = (leaf for formula in formulas for leaf in leaves(formula))
    of_claims = {leaf.name for leaf in named if isinstance(leaf, Atom) and leaf.kind == "trigger"}
    return ruleset.triggers | ruleset.obligations | events | of_claims


def _conditions(ruleset: Ruleset) -> frozenset[str]:
    if not ruleset.is_timed:
        return ruleset.conditions
    from sleec_runtime.model import Atom, leaves
    from sleec_verify.encoding.mentioned_names import names_beside_rules

    named = (leaf for formula in names_beside_rules(ruleset)[1] for leaf in leaves(formula))
    return ruleset.conditions | {leaf.name for leaf in named if isinstance(leaf, Atom) and leaf.kind == "condition"}


def _trigger(ruleset: Ruleset, name: str) -> str:
    if name in _triggers(ruleset):
        return name
    if name in _conditions(ruleset) or name in ruleset.measures:
        raise SituationError(f"{name} is not a trigger", "give conditions and measures with --given")
    raise _unknown(name, "trigger", _triggers(ruleset))


def parse_assignment(ruleset: Ruleset, item: str) -> tuple[str, Value]:
    """The name and the value of one item of `given`. Raises SituationError."""
    if item in _conditions(ruleset):
        return item, True
    name, equals, written = (part.strip() for part in item.partition("="))
    _check_form(ruleset, item, name, bool(equals))
    if equals:
        written = written.removeprefix("=").strip()  # == says = in the rules too
        if name in ruleset.measures:
            return name, _measured(ruleset, ruleset.measures[name], written)
        if written.lower() not in _TRUTHS and name in _conditions(ruleset):
            raise SituationError(
                f"{name} is a condition, true or false, and {shortened(written) or 'nothing'} is neither",
                f"write {name} or not {name}",
            )
        return _condition(ruleset, name), _TRUTHS.get(written.lower(), True)
    negation, blank, rest = item.partition(" ")
    if blank and negation.lower() == "not":
        return _condition(ruleset, rest), False
    return _condition(ruleset, item), True


def _check_form(ruleset: Ruleset, item: str, name: str, equals: bool) -> None:
    """Refuse what no name could make right: no name at all, a comparison, a negation of a value, a number alone."""
    shown = shortened(item)
    if not name:
        raise SituationError(f"there is no name before the = in {shown}", "write Name=value, as in UserAge=15")
    if not equals and item.lower() == "not" and item not in _conditions(ruleset):
        raise SituationError(f"there is no name after {item}", "write not and a name, as in not UserAsleep")
    if _COMPARES.search(item):
        raise SituationError(f"{shown} is a comparison", "a situation gives each measure one value, as in UserAge=15")
    if equals and name not in _conditions(ruleset) and name.lower().startswith("not "):
        raise SituationError(f"{shown} says both not and =", "write not Name, or Name=false")
    if not equals and _NUMBER.fullmatch(item):
        raise SituationError(f"{shown} is a number without a name", "write decimals with a point, as in 36.6")


def _condition(ruleset: Ruleset, name: str) -> str:
    if name in _conditions(ruleset):
        return name
    if name in ruleset.measures:
        example = ruleset.measures[name].values[:1] or ("15",)
        raise SituationError(f"{name} is a measure, neither true nor false", f"give its value: {name}={example[0]}")
    if name in _triggers(ruleset):
        raise SituationError(f"{name} is a trigger", "give what occurs with --when")
    if name in ruleset.obligations:
        raise SituationError(f"{name} is an obligation", "a situation says what is the case, the rules what is due")
    raise _unknown(name, "condition or measure", {*_conditions(ruleset), *ruleset.measures})


def _measured(ruleset: Ruleset, measure: Measure, written: str) -> Value:
    if measure.kind == "scale":
        if written in measure.values:
            return written
        if not written:
            raise SituationError(f"{measure.name} is given no value", f"its scale is {' < '.join(measure.values)}")
        raise SituationError(
            f"{measure.name} is never {shortened(written)}", f"its scale is {' < '.join(measure.values)}"
        )
    if written in ruleset.constants:
        return ruleset.constants[written].value
    if not _NUMBER.fullmatch(written):
        raise SituationError(
            f"{measure.name} is a number, and {shortened(written) or 'nothing'} is not",
            f"write it with digits, as in {measure.name}=15 or {measure.name}=36.6",
        )
    from fractions import Fraction

    number = Fraction(written)
    if number.denominator == 1:
        return number.numerator
    if measure.kind == "integer":
        raise SituationError(f"{measure.name} is a whole number, and {shortened(written)} is not", "round it")
    return number


def _unknown(name: str, what: str, known: frozenset[str] | set[str]) -> SituationError:
    from sleec_runtime.support.suggestions import nearest

    near = nearest(name, sorted(known))
    if near is not None:
        hint = f"did you mean {near}?"
    elif known:
        shown = sorted(known)
        hint = f"the rules know {', '.join(shown[:10])}{' and more' if len(shown) > 10 else ''}"
    else:
        hint = f"the ruleset has no {what}"
    return SituationError(f"there is no {what} {shortened(name)}", hint)
