"""Situations on the command line: ``--when Fall,Night --given "UserAsleep, not Undressed, UserAge=15"``."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_runtime.errors import SleecError
from sleec_verify.wording.phrases import quoted, shortened

if TYPE_CHECKING:
    from sleec_runtime.model import Context, Measure, Ruleset, Value

_NUMBER = re.compile(r"[+-]?[0-9]{1,100}(\.[0-9]{1,100})?")
_COMPARES = re.compile(r"[<>\u2264\u2265\u2260]|!=")
_TRUTHS = {"true": True, "false": False}


class SituationError(SleecError):
    """A situation that does not fit the ruleset: an unknown name, a value of the wrong type, or two values for a
    name."""


def parse_situation(ruleset: Ruleset, when: str, given: str) -> Context:
    """The context with the triggers in `when` and the values in `given`.

    `when` is a list of triggers. `given` is a list of ``Name``, ``not Name``, ``Name=true`` and ``Measure=value``. Both
    are separated by commas. Phrases are names. Numbers are exact. A constant of the ruleset can replace its number.

    Raises:
        SituationError: for the first item that does not fit, with a suggestion.
    """
    from sleec_runtime.model import Context

    triggers = frozenset(_trigger(ruleset, name) for name in _items(when))
    values: dict[str, Value] = {}
    for item in _items(given):
        name, value = parse_assignment(ruleset, item)
        if name in values and values[name] != value:
            raise SituationError(f"two values are given for {quoted(name)}", "give one value")
        values[name] = value
    return Context(triggers, values)


def _items(text: str) -> Iterator[str]:
    """The items of a list. Several blanks in an item count as one, as in the rules."""
    return (" ".join(item.split()) for item in text.split(",") if item.strip())


def _triggers(ruleset: Ruleset) -> frozenset[str]:
    """The names that can occur. In rules with time: every event, also those that only relations and claims name."""
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
        raise SituationError(f"{quoted(name)} is not a trigger", "use --given for conditions and measures")
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
                f"the condition {quoted(name)} must be true or false, not {_shown(written)}",
                f"write {quoted(name)} or {quoted(f'not {name}')}",
            )
        return _condition(ruleset, name), _TRUTHS.get(written.lower(), True)
    negation, blank, rest = item.partition(" ")
    if blank and negation.lower() == "not":
        return _condition(ruleset, rest), False
    return _condition(ruleset, item), True


def _check_form(ruleset: Ruleset, item: str, name: str, equals: bool) -> None:
    """Raises SituationError for what is wrong whatever the names are: a missing name, a comparison, a negated value, a
    number alone."""
    shown = quoted(shortened(item))
    if not name:
        raise SituationError(f"a name is missing before the = in {shown}", "write Name=value, for example UserAge=15")
    if not equals and item.lower() == "not" and item not in _conditions(ruleset):
        raise SituationError(f"a name is missing after {shown}", "write not and a name, for example not UserAsleep")
    if _COMPARES.search(item):
        raise SituationError(f"{shown} is a comparison", "give each measure one value, for example UserAge=15")
    if equals and name not in _conditions(ruleset) and name.lower().startswith("not "):
        raise SituationError(f"{shown} has both not and =", "write not Name, or Name=false")
    if not equals and _NUMBER.fullmatch(item):
        raise SituationError(f"{shown} is a number without a name", "write decimals with a point, for example 36.6")


def _condition(ruleset: Ruleset, name: str) -> str:
    if name in _conditions(ruleset):
        return name
    if name in ruleset.measures:
        example = ruleset.measures[name].values[:1] or ("15",)
        raise SituationError(
            f"{quoted(name)} is a measure, not true or false", f"give a value, for example {name}={example[0]}"
        )
    if name in _triggers(ruleset):
        raise SituationError(f"{quoted(name)} is a trigger", "use --when for triggers")
    if name in ruleset.obligations:
        raise SituationError(
            f"{quoted(name)} is an obligation", "a situation consists of triggers, conditions and measures"
        )
    raise _unknown(name, "condition or measure", {*_conditions(ruleset), *ruleset.measures})


def _measured(ruleset: Ruleset, measure: Measure, written: str) -> Value:
    if measure.kind == "scale":
        if written in measure.values:
            return written
        if not written:
            raise SituationError(
                f"a value for {quoted(measure.name)} is missing", f"its scale is {' < '.join(measure.values)}"
            )
        raise SituationError(
            f"{quoted(shortened(written))} is not a value of {quoted(measure.name)}",
            f"its scale is {' < '.join(measure.values)}",
        )
    if written in ruleset.constants:
        return ruleset.constants[written].value
    if not _NUMBER.fullmatch(written):
        raise SituationError(
            f"{quoted(measure.name)} must be a number, not {_shown(written)}",
            f"write it with digits, for example {measure.name}=15 or {measure.name}=36.6",
        )
    from fractions import Fraction

    number = Fraction(written)
    if number.denominator == 1:
        return number.numerator
    if measure.kind == "integer":
        raise SituationError(
            f"{quoted(measure.name)} must be a whole number, not {quoted(shortened(written))}", "round it"
        )
    return number


def _shown(written: str) -> str:
    return quoted(shortened(written)) if written else "empty"


def _unknown(name: str, what: str, known: frozenset[str] | set[str]) -> SituationError:
    from sleec_runtime.support.suggestions import nearest

    near = nearest(name, sorted(known))
    if near is not None:
        hint = f"did you mean {quoted(near)}?"
    elif known:
        shown = sorted(known)
        hint = f"the rules have {', '.join(shown[:10])}{' and more' if len(shown) > 10 else ''}"
    else:
        hint = f"the ruleset has no {what}"
    return SituationError(f"no {what} is called {quoted(shortened(name))}", hint)
