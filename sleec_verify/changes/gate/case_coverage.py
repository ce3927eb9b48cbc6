"""The clauses and windows that the cases beside a ruleset reach, such as ``home.cases.toml`` beside ``home.sleec``."""

from __future__ import annotations

from pathlib import Path

from sleec_runtime.errors import SleecError
from sleec_runtime.model import Ruleset
from sleec_verify.changes.gate.result import Coverage
from sleec_verify.conformance.cases.coverage import reached_clauses
from sleec_verify.conformance.cases.goals import clause_name
from sleec_verify.conformance.cases.reader import SUFFIX, read_cases
from sleec_verify.conformance.scenarios.window_coverage import reached_windows
from sleec_verify.conformance.scenarios.windows import windows_of
from sleec_verify.files.folders import beside


def coverage(ruleset: Ruleset, errors: list[SleecError]) -> Coverage | None:
    """The coverage of one ruleset. Without cases, nothing is reached. Errors in the cases go to `errors`."""
    clauses = {(rule.label, number): rule for rule in ruleset.rules for number, _ in enumerate(rule.clauses())}
    windows = [window for rule in ruleset.rules for window in windows_of(rule)]
    path = Path(ruleset.source.path)
    file = path.with_name(beside(path.name, SUFFIX))
    reached: set[tuple[str, int]] = set()
    met: set[object] = set()
    if file.exists():
        try:
            found = read_cases(file, ruleset)
            reached.update(reached_clauses(ruleset, found.cases))
            met.update(reached_windows(ruleset, found.scenarios))
        except SleecError as error:
            errors.append(error)
            return None
    missed = [clause_name(rule, place[1]) for place, rule in clauses.items() if place not in reached]
    missed += [str(window) for window in windows if window not in met]
    return Coverage(len(reached), len(clauses), tuple(missed), len(met), len(windows))
