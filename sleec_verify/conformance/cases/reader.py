"""Cases from TOML: ``household.cases.toml`` beside ``household.sleec``.

    [[case]]
    name = "nobody undressed is exposed"
    when = ["CurtainOpenRequest"]
    given = { UserUndressed = true }
    obligations = ["RefuseRequest", "ExplainWhy"]

`when` and `given` may also be texts as on the command line. Every key is checked, because with a misspelled key a test
would test something else.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from sleec_runtime.language import load
from sleec_runtime.model import require_untimed
from sleec_runtime.support.suggestions import nearest
from sleec_verify.conformance.cases.case import Case, CasesError
from sleec_verify.entailment.situation_text import SituationError, parse_assignment, parse_situation
from sleec_verify.files.toml import read_toml
from sleec_verify.results.phrases import quoted, shortened

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset, Value

SUFFIX = ".cases.toml"
_FILE_KEYS = {"ruleset", "reading", "coverage", "unreachable", "case"}
_MAX_DIGITS = 100
"""The maximal number of digits before and after the point, as on the command line."""
_FRACTION = re.compile(r"(-?[0-9]{1,100})/(-?0*[1-9][0-9]{0,99})")
"""A number that is not a finite decimal, such as 1/3."""
_CASE_KEYS = {"name", "when", "given", "obligations", "prohibitions", "conflict", "domain", "reaches"}


class CaseFile(NamedTuple):
    """The cases of one file, and their ruleset."""

    ruleset: Ruleset
    cases: tuple[Case, ...]


def read_cases(path: Path, ruleset: Ruleset | None = None) -> CaseFile:
    """The cases in the file at `path`. Their ruleset is `ruleset`, otherwise the file that they name, otherwise the one
    beside them with the same name.

    Raises `CasesError`, and the errors of reading the ruleset.
    """
    # Decimals, so that 36.6 is 36.6.
    table = read_toml(path, str(path), CasesError, Decimal)
    _known(path, "the file", table, _FILE_KEYS)
    if ruleset is None:
        ruleset = load(path.parent / _text(path, "ruleset", table.get("ruleset", _beside(path))))
    require_untimed(ruleset, "a file of cases")
    reading = table.get("reading")
    if reading is not None:
        if reading not in ("cascade", "priority"):
            raise CasesError(f"{path}: the reading is {shortened(repr(reading))}", "it is cascade or priority")
        ruleset = ruleset.read_as(reading)
    entries = table.get("case", [])
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        raise CasesError(f"{path}: case is not a list of tables", "begin each case with [[case]]")
    if not entries:
        raise CasesError(f"{path} contains no case", "begin each with [[case]]")
    return CaseFile(ruleset, tuple(_case(path, n, entry, ruleset) for n, entry in enumerate(entries, 1)))


def _beside(path: Path) -> str:
    return path.name.removesuffix(SUFFIX) + ".sleec"


def _known(path: Path, where: str, table: Mapping[str, object], keys: set[str]) -> None:
    for key in table:
        if key not in keys:
            near = nearest(key, sorted(keys))
            hint = f"did you mean `{near}`?" if near else f"the keys are {', '.join(sorted(keys))}"
            raise CasesError(f"{path}: {where} has an unknown key {shortened(repr(key))}", hint)


def _case(path: Path, number: int, entry: dict[str, Any], ruleset: Ruleset) -> Case:
    name = _text(path, "name", entry.get("name", f"case {number}"))
    where = f"case {number} ({name})"
    _known(path, where, entry, _CASE_KEYS)
    if "obligations" not in entry and not entry.get("conflict"):
        raise CasesError(f"{path}: {where} does not say what is required", "give obligations = [], or conflict = true")
    try:
        triggers, conditions = _situation(entry, ruleset)
        domain = entry.get("domain")
        if domain is not None and domain not in ruleset.domains:
            raise SituationError(
                f"no domain is called {quoted(shortened(str(domain)))}",
                f"the rules have {', '.join(ruleset.domains) or 'none'}",
            )
        obligations = _obligations(entry.get("obligations", []), ruleset)
        prohibitions = _obligations(entry["prohibitions"], ruleset) if "prohibitions" in entry else None
    except SituationError as error:
        raise CasesError(f"{path}: {where}: {error.message}", error.hint) from None
    conflict = entry.get("conflict", False)
    if not isinstance(conflict, bool) or (conflict and obligations):
        raise CasesError(f"{path}: {where}: conflict must be true or false; a conflict has no obligations")
    reaches = entry.get("reaches", [])
    if not isinstance(reaches, list) or not all(isinstance(goal, str) for goal in reaches):
        raise CasesError(f"{path}: {where}: reaches is {shortened(repr(reaches))}", "give a list of texts")
    return Case(name, triggers, conditions, obligations, prohibitions, conflict, domain, tuple(reaches))


def _situation(entry: Mapping[str, Any], ruleset: Ruleset) -> tuple[tuple[str, ...], dict[str, Value]]:
    when, given = entry.get("when", []), entry.get("given", {})
    names = ",".join(when) if isinstance(when, list) and all(isinstance(name, str) for name in when) else when
    if not isinstance(names, str):
        raise SituationError(f"when is {shortened(repr(when))}", 'give triggers: when = ["Fall"]')
    if isinstance(given, dict):
        triggers = parse_situation(ruleset, names, "").triggers
        return tuple(sorted(triggers)), {name: _value(name, value, ruleset) for name, value in given.items()}
    if not isinstance(given, str):
        raise SituationError(
            f"given is {shortened(repr(given))}", "give a table: given = { UserUndressed = true, UserAge = 15 }"
        )
    context = parse_situation(ruleset, names, given)
    return tuple(sorted(context.triggers)), dict(context.conditions)


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
    _, read = parse_assignment(ruleset, f"{name}={written}")
    return read


def _obligations(names: object, ruleset: Ruleset) -> tuple[str, ...]:
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        raise SituationError(f"obligations are {shortened(repr(names))}", 'give a list of names: ["OpenCurtains"]')
    for name in names:
        if name not in ruleset.obligations:
            near = nearest(name, sorted(ruleset.obligations))
            raise SituationError(
                f"no obligation is called `{shortened(name)}`", f"did you mean `{near}`?" if near else None
            )
    return tuple(names)


def _text(path: Path, key: str, value: object) -> str:
    if not isinstance(value, str) or not value:
        raise CasesError(f"{path}: {key} is {shortened(repr(value))}, not a text")
    return value
