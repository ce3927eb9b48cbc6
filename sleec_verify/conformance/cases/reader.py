"""Cases from TOML: ``household.cases.toml`` beside ``household.sleec``.

    [[case]]
    name = "nobody undressed is exposed"
    when = ["CurtainOpenRequest"]
    given = { UserUndressed = true }
    obligations = ["RefuseRequest", "ExplainWhy"]

`when` and `given` may also be texts as on the command line. Every key is checked, because with a misspelled key a test
would test something else. A case with `steps` is a scenario (`sleec_verify.conformance.scenarios.reader`).
"""

from __future__ import annotations

from decimal import Decimal
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from sleec_runtime.language import load
from sleec_runtime.model import constructs
from sleec_verify.conformance.cases.case import Case, CasesError
from sleec_verify.conformance.cases.fields import (
    check_keys,
    domain_of,
    goals_of,
    obligations_of,
    situation_of,
    text_of,
)
from sleec_verify.conformance.scenarios.reader import check_overlap, scenario_of_table
from sleec_verify.conformance.scenarios.scenario import Scenario
from sleec_verify.entailment.situation_text import SituationError
from sleec_verify.files.toml import read_toml
from sleec_verify.wording.phrases import shortened

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset

SUFFIX = ".cases.toml"
_FILE_KEYS = {"ruleset", "sha256", "reading", "coverage", "unreachable", "case"}
_CASE_KEYS = {"name", "when", "given", "obligations", "prohibitions", "conflict", "domain", "reaches", "steps"}


class CaseFile(NamedTuple):
    """The cases of one file, in order, and their ruleset. Cases with steps are scenarios."""

    ruleset: Ruleset
    cases: tuple[Case | Scenario, ...]

    @property
    def situations(self) -> tuple[Case, ...]:
        return tuple(one for one in self.cases if isinstance(one, Case))

    @property
    def scenarios(self) -> tuple[Scenario, ...]:
        return tuple(one for one in self.cases if isinstance(one, Scenario))


def read_cases(path: Path, ruleset: Ruleset | None = None) -> CaseFile:
    """The cases in the file at `path`. Their ruleset is `ruleset`, otherwise the file that they name, otherwise the one
    beside them with the same name.

    Raises `CasesError`, and the errors of reading the ruleset.
    """
    table = _table(path)
    if ruleset is None:
        ruleset = load(path.parent / text_of(path, "ruleset", table.get("ruleset", _beside(path))))
    _check_sum(path, table, ruleset)
    ruleset = _read_as(path, table, ruleset)
    found = [_case(path, n, entry, ruleset) for n, entry in enumerate(_entries(path, table), 1)]
    if any(constructs(ruleset)):
        check_overlap(path, found)
    return CaseFile(ruleset, tuple(found))


class UnfitCase(NamedTuple):
    """A case that does not fit the rules, and why: they may have no such name."""

    name: str
    why: str


def read_each(path: Path, ruleset: Ruleset) -> tuple[Ruleset, list[Case | Scenario | UnfitCase]]:
    """The cases in the file at `path`, each on its own, and the rules in the reading of the file. The rules may be
    another version than the one for which the cases were written.

    Raises `CasesError` if the file is not one of cases.
    """
    table = _table(path)
    ruleset = _read_as(path, table, ruleset)
    return ruleset, [_each(path, n, entry, ruleset) for n, entry in enumerate(_entries(path, table), 1)]


def as_in_cases(path: Path, ruleset: Ruleset) -> Ruleset:
    """The rules in the reading that the file of cases at `path` states, if it states one. Raises `CasesError`."""
    return _read_as(path, _table(path), ruleset)


def _each(path: Path, number: int, entry: dict[str, Any], ruleset: Ruleset) -> Case | Scenario | UnfitCase:
    try:
        return _case(path, number, entry, ruleset)
    except CasesError as error:
        name = str(entry.get("name", f"case {number}"))
        return UnfitCase(name, error.message.removeprefix(f"{path}: ").removeprefix(f"case {number} ({name}): "))


def _table(path: Path) -> dict[str, Any]:
    # Decimals, so that 36.6 is 36.6.
    table = read_toml(path, str(path), CasesError, Decimal)
    check_keys(path, "the file", table, _FILE_KEYS)
    return table


def _read_as(path: Path, table: dict[str, Any], ruleset: Ruleset) -> Ruleset:
    """The rules in the reading that the file states, if it states one."""
    reading = table.get("reading")
    if reading is None:
        return ruleset
    if reading not in ("cascade", "priority"):
        raise CasesError(f"{path}: the reading is {shortened(repr(reading))}", "it is cascade or priority")
    return ruleset.read_as(reading)


def _entries(path: Path, table: dict[str, Any]) -> list[dict[str, Any]]:
    entries = table.get("case", [])
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        raise CasesError(f"{path}: case is not a list of tables", "begin each case with [[case]]")
    if not entries:
        raise CasesError(f"{path} contains no case", "begin each with [[case]]")
    return entries


def _beside(path: Path) -> str:
    return path.name.removesuffix(SUFFIX) + ".sleec"


def _check_sum(path: Path, table: dict[str, Any], ruleset: Ruleset) -> None:
    """Raises CasesError if the file states the SHA-256 of other rules."""
    stated = table.get("sha256")
    if stated is not None and stated != ruleset.source.sha256:
        raise CasesError(
            f"{path}: the cases are for another version of {ruleset.source.path}: its SHA-256 is not the stated one",
            "write the cases again with sleec-verify cases, or remove the line sha256",
        )


def _case(path: Path, number: int, entry: dict[str, Any], ruleset: Ruleset) -> Case | Scenario:
    name = text_of(path, "name", entry.get("name", f"case {number}"))
    where = f"case {number} ({name})"
    try:
        if "steps" in entry:
            return scenario_of_table(path, where, name, entry, ruleset)
        return _situation(path, where, name, entry, ruleset)
    except SituationError as error:
        raise CasesError(f"{path}: {where}: {error.message}", error.hint) from None


def _situation(path: Path, where: str, name: str, entry: dict[str, Any], ruleset: Ruleset) -> Case:
    check_keys(path, where, entry, _CASE_KEYS)
    if "obligations" not in entry and not entry.get("conflict"):
        raise CasesError(f"{path}: {where} does not say what is required", "give obligations = [], or conflict = true")
    triggers, conditions = situation_of(entry, ruleset)
    domain = domain_of(entry, ruleset)
    obligations = obligations_of(entry.get("obligations", []), ruleset)
    prohibitions = obligations_of(entry["prohibitions"], ruleset) if "prohibitions" in entry else None
    conflict = entry.get("conflict", False)
    if not isinstance(conflict, bool) or (conflict and obligations):
        raise CasesError(f"{path}: {where}: conflict must be true or false; a conflict has no obligations")
    reaches = goals_of(entry)
    return Case(name, triggers, conditions, obligations, prohibitions, conflict, domain, reaches)
