"""The fields of a case in a file: their keys, texts, situations and names, each checked."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sleec_runtime.support.suggestions import nearest
from sleec_verify.conformance.cases.case import CasesError
from sleec_verify.entailment.situation_text import SituationError, parse_assignment, parse_situation
from sleec_verify.wording.phrases import quoted, shortened

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset, Value

_MAX_DIGITS = 100
"""The maximal number of digits before and after the point, as on the command line."""
_FRACTION = re.compile(r"(-?[0-9]{1,100})/(-?0*[1-9][0-9]{0,99})")
"""A number that is not a finite decimal, such as 1/3."""


def check_keys(path: Path, where: str, table: Mapping[str, object], keys: Collection[str]) -> None:
    """Raises CasesError for a key that is not one of `keys`."""
    for key in table:
        if key not in keys:
            near = nearest(key, sorted(keys))
            hint = f"did you mean `{near}`?" if near else f"the keys are {', '.join(sorted(keys))}"
            raise CasesError(f"{path}: {where} has an unknown key {shortened(repr(key))}", hint)


def text_of(path: Path, key: str, value: object) -> str:
    """The value of a key, if it is a text. Raises CasesError."""
    if not isinstance(value, str) or not value:
        raise CasesError(f"{path}: {key} is {shortened(repr(value))}, not a text")
    return value


def situation_of(entry: Mapping[str, Any], ruleset: Ruleset) -> tuple[tuple[str, ...], dict[str, Value]]:
    """The triggers in `when`, and the values in `given`. Raises SituationError."""
    when, given = entry.get("when", []), entry.get("given", {})
    names = ",".join(when) if isinstance(when, list) and all(isinstance(name, str) for name in when) else when
    if not isinstance(names, str):
        raise SituationError(f"when is {shortened(repr(when))}", 'give triggers: when = ["Fall"]')
    if isinstance(given, dict):
        triggers = parse_situation(ruleset, names, "").triggers
        return tuple(sorted(triggers)), values_of(given, ruleset)
    if not isinstance(given, str):
        raise SituationError(
            f"given is {shortened(repr(given))}", "give a table: given = { UserUndressed = true, UserAge = 15 }"
        )
    context = parse_situation(ruleset, names, given)
    return tuple(sorted(context.triggers)), dict(context.conditions)


def values_of(given: Mapping[str, object], ruleset: Ruleset) -> dict[str, Value]:
    """The values of conditions and measures. Raises SituationError."""
    return {name: _value(name, value, ruleset) for name, value in given.items()}


def _value(name: str, value: object, ruleset: Ruleset) -> Value:
    if isinstance(value, bool):
        written = "true" if value else "false"
    elif isinstance(value, Decimal) and value.is_finite() and abs(value.adjusted()) < _MAX_DIGITS:
        written = f"{value:f}"
    elif isinstance(value, (int, Decimal)):
        written = str(value)
    elif isinstance(value, str):
        written = value
        fraction = _FRACTION.fullmatch(value)
        measure = ruleset.measures.get(name)
        if fraction is not None and measure is not None and measure.kind == "number":
            return Fraction(int(fraction[1]), int(fraction[2]))
    else:
        raise SituationError(
            f"{name} is {shortened(repr(value))}", "give true, false, a number, or a value of its scale in quotes"
        )
    found, read = parse_assignment(ruleset, f"{name}={written}")
    if found != name:
        raise SituationError(f"{quoted(shortened(name))} is not a name", f"did you mean {quoted(found)}?")
    return read


def domain_of(entry: Mapping[str, Any], ruleset: Ruleset) -> str | None:
    """The domain of a case, if it has one. Raises SituationError."""
    domain = entry.get("domain")
    if domain is None or domain in ruleset.domains:
        return domain
    raise SituationError(
        f"no domain is called {quoted(shortened(str(domain)))}",
        f"the rules have {', '.join(ruleset.domains) or 'none'}",
    )


def goals_of(entry: Mapping[str, Any]) -> tuple[str, ...]:
    """The goals that a case reaches. Raises SituationError."""
    reaches = entry.get("reaches", [])
    if not isinstance(reaches, list) or not all(isinstance(goal, str) for goal in reaches):
        raise SituationError(f"reaches is {shortened(repr(reaches))}", "give a list of texts")
    return tuple(reaches)


def obligations_of(names: object, ruleset: Ruleset) -> tuple[str, ...]:
    """Names of obligations. Raises SituationError."""
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        raise SituationError(f"obligations are {shortened(repr(names))}", 'give a list of names: ["OpenCurtains"]')
    return tuple(obligation_of(name, ruleset) for name in names)


def obligation_of(name: str, ruleset: Ruleset) -> str:
    """The name of an obligation. Raises SituationError."""
    if name in ruleset.obligations:
        return name
    near = nearest(name, sorted(ruleset.obligations))
    raise SituationError(f"no obligation is called `{shortened(name)}`", f"did you mean `{near}`?" if near else None)
