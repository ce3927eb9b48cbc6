"""Cases from TOML: ``household.cases.toml`` beside ``household.sleec``.

    [[case]]
    name = "nobody undressed is exposed"
    when = ["CurtainOpenRequest"]
    given = { UserUndressed = true }
    obligations = ["RefuseRequest", "ExplainWhy"]

`when` and `given` may also be texts as on the command line. Every key is checked, because a misspelt one would make a
test that tests something else.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from decimal import Decimal
from fractions import Fraction
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from sleec_runtime.files import read_file
from sleec_runtime.language import load
from sleec_runtime.language.suggest import nearest
from sleec_runtime.untimed import require_untimed
from sleec_verify.cases.case import Case, CasesError
from sleec_verify.situation import SituationError, parse_situation

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset, Value

SUFFIX = ".cases.toml"
_FILE_KEYS = {"ruleset", "reading", "coverage", "unreachable", "case"}
_CASE_KEYS = {"name", "when", "given", "obligations", "prohibitions", "conflict", "domain", "reaches"}


class CaseFile(NamedTuple):
    """The cases of one file, and the ruleset that they speak of."""

    ruleset: Ruleset
    cases: tuple[Case, ...]


def read_cases(path: Path, ruleset: Ruleset | None = None) -> CaseFile:
    """The cases in the file at `path`. Their ruleset is `ruleset`, else the file that they name, else the one beside
    them with the same name.

    Raises CasesError, and what reading the ruleset raises.
    """
    table = _table(path)
    _known(path, "the file", table, _FILE_KEYS)
    if ruleset is None:
        ruleset = load(path.parent / _text(path, "ruleset", table.get("ruleset", _beside(path))))
    require_untimed(ruleset, "a file of cases")
    reading = table.get("reading")
    if reading is not None:
        if reading not in ("cascade", "priority"):
            raise CasesError(f"{path}: the reading is {reading!r}", "it is cascade or priority")
        ruleset = ruleset.read_as(reading)
    entries = table.get("case", [])
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        raise CasesError(f"{path}: case is no list of tables", "begin each case with [[case]]")
    if not entries:
        raise CasesError(f"{path} has no case", "begin each with [[case]]")
    return CaseFile(ruleset, tuple(_case(path, n, entry, ruleset) for n, entry in enumerate(entries, 1)))


def _table(path: Path) -> dict[str, Any]:
    toml = import_module("tomllib" if sys.version_info >= (3, 11) else "tomli")
    try:
        # Decimals, so that 36.6 is 36.6.
        table: dict[str, Any] = toml.loads(read_file(path).decode("utf-8-sig"), parse_float=Decimal)
    except OSError as error:
        raise CasesError(f"{path} cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise CasesError(f"{path} is not UTF-8", "save it as UTF-8") from None
    except ValueError as error:
        raise CasesError(f"{path} is no TOML: {error}") from None
    return table


def _beside(path: Path) -> str:
    return path.name.removesuffix(SUFFIX) + ".sleec"


def _known(path: Path, where: str, table: Mapping[str, object], keys: set[str]) -> None:
    for key in table:
        if key not in keys:
            near = nearest(key, sorted(keys))
            hint = f"did you mean {near}?" if near else f"there are {', '.join(sorted(keys))}"
            raise CasesError(f"{path}: {where} has an unknown key {key!r}", hint)


def _case(path: Path, number: int, entry: dict[str, Any], ruleset: Ruleset) -> Case:
    name = _text(path, "name", entry.get("name", f"case {number}"))
    where = f"case {number} ({name})"
    _known(path, where, entry, _CASE_KEYS)
    if "obligations" not in entry and not entry.get("conflict"):
        raise CasesError(f"{path}: {where} does not say what is due", "give obligations = [], or conflict = true")
    try:
        triggers, conditions = _situation(entry, ruleset)
        domain = entry.get("domain")
        if domain is not None and domain not in ruleset.domains:
            raise SituationError(
                f"there is no domain {domain}", f"the rules have {', '.join(ruleset.domains) or 'none'}"
            )
        obligations = _obligations(entry.get("obligations", []), ruleset)
        prohibitions = _obligations(entry["prohibitions"], ruleset) if "prohibitions" in entry else None
    except SituationError as error:
        raise CasesError(f"{path}: {where}: {error.message}", error.hint) from None
    conflict = entry.get("conflict", False)
    if not isinstance(conflict, bool) or (conflict and obligations):
        raise CasesError(f"{path}: {where}: conflict is true or false, and nothing is due in one")
    reaches = tuple(map(str, entry.get("reaches", ())))
    return Case(name, triggers, conditions, obligations, prohibitions, conflict, domain, reaches)


def _situation(entry: Mapping[str, Any], ruleset: Ruleset) -> tuple[tuple[str, ...], dict[str, Value]]:
    when, given = entry.get("when", []), entry.get("given", {})
    names = ",".join(when) if isinstance(when, list) and all(isinstance(name, str) for name in when) else when
    if not isinstance(names, str):
        raise SituationError(f"when is {when!r}", 'give triggers: when = ["Fall"]')
    if isinstance(given, dict):
        triggers = parse_situation(ruleset, names, "").triggers
        return tuple(sorted(triggers)), {name: _value(name, value, ruleset) for name, value in given.items()}
    if not isinstance(given, str):
        raise SituationError(f"given is {given!r}", "give a table: given = { UserUndressed = true, UserAge = 15 }")
    context = parse_situation(ruleset, names, given)
    return tuple(sorted(context.triggers)), dict(context.conditions)


def _value(name: str, value: object, ruleset: Ruleset) -> Value:
    if isinstance(value, bool):
        written = "true" if value else "false"
    elif isinstance(value, (int, Decimal)):
        written = f"{value:f}" if isinstance(value, Decimal) else str(value)
    elif isinstance(value, str):
        written = value
        numerator, slash, denominator = value.partition("/")
        measure = ruleset.measures.get(name)
        if slash and measure is not None and measure.kind == "number" and _digits(numerator) and _digits(denominator):
            # What is no finite decimal, such as 1/3.
            return Fraction(int(numerator), int(denominator))
    else:
        raise SituationError(f"{name} is {value!r}", "give true, false, a number, or a value of its scale in quotes")
    ((_, read),) = parse_situation(ruleset, "", f"{name}={written}").conditions.items()
    return read


def _digits(text: str) -> bool:
    return text.removeprefix("-").isdecimal() and int(text) != 0


def _obligations(names: object, ruleset: Ruleset) -> tuple[str, ...]:
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        raise SituationError(f"obligations are {names!r}", 'give a list of names: ["OpenCurtains"]')
    for name in names:
        if name not in ruleset.obligations:
            near = nearest(name, sorted(ruleset.obligations))
            raise SituationError(f"there is no obligation {name}", f"did you mean {near}?" if near else None)
    return tuple(names)


def _text(path: Path, key: str, value: object) -> str:
    if not isinstance(value, str) or not value:
        raise CasesError(f"{path}: {key} is {value!r}, not a text")
    return value
