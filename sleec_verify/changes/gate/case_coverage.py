"""The clauses that the cases beside a ruleset reach: ``household.cases.toml`` beside ``household.sleec``."""

from __future__ import annotations

from pathlib import Path

from sleec_runtime.errors import SleecError, UnsupportedTimes
from sleec_runtime.model import Ruleset
from sleec_verify.changes.gate.result import Coverage
from sleec_verify.conformance.cases.coverage import reached_clauses
from sleec_verify.conformance.cases.goals import clause_name
from sleec_verify.conformance.cases.reader import SUFFIX, read_cases


def coverage(ruleset: Ruleset, errors: list[SleecError]) -> Coverage | None:
    """The coverage of one ruleset. Without cases, no clause is reached. Errors in the cases go to `errors`."""
    every = {(rule.label, number): rule for rule in ruleset.rules for number, _ in enumerate(rule.clauses())}
    path = Path(ruleset.source.path)
    cases = path.with_name(path.name.removesuffix(".sleec") + SUFFIX)
    if ruleset.is_timed:
        return Coverage(0, len(every), why="cases do not support rules with time yet")
    reached: set[tuple[str, int]] = set()
    if cases.exists():
        try:
            found = read_cases(cases, ruleset).situations
        except UnsupportedTimes as error:
            return Coverage(0, len(every), why=str(error))
        except SleecError as error:
            errors.append(error)
            return None
        reached = reached_clauses(ruleset, found)
    missed = tuple(clause_name(rule, place[1]) for place, rule in every.items() if place not in reached)
    return Coverage(len(reached), len(every), missed)
