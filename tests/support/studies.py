"""Our studies, and the published case studies if they are beside the checkout: they are not part of the project."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from pathlib import Path

import pytest

from sleec_runtime.language import load
from sleec_runtime.model import Ruleset
from sleec_verify.checks import run_checks
from sleec_verify.results.finding import CheckResult
from tests.support.paths import ROOT

OWN = ROOT / "rulesets" / "studies"
PUBLISHED = ROOT.parent / "shared" / "case-studies"
published_only = pytest.mark.skipif(
    not PUBLISHED.is_dir(), reason="the published case studies are not part of the project"
)
NOT_READ = ("dialects/*", "more/TABIAT-corrected.sleec")
"""Published files that are refused: dialects with other constructs, and a text saved as RTF."""


def published_files() -> list[Path]:
    """The published files that are in a known dialect, sorted; none without the case studies."""
    return [path for path in sorted(PUBLISHED.glob("*/*.sleec")) if not is_refused(path)]


def is_refused(path: Path) -> bool:
    return any(path.match(pattern) for pattern in NOT_READ)


def _each(paths: Iterable[Path]) -> pytest.MarkDecorator:
    params = [pytest.param(path, id=f"{path.parent.name}-{path.stem}") for path in paths]
    if not PUBLISHED.is_dir():
        params.append(pytest.param(None, id="published", marks=published_only))
    return pytest.mark.parametrize("path", params)


_FILES = [*sorted(OWN.glob("*.sleec")), *published_files()]
each_study = _each(_FILES)
each_dsl_study = _each(path for path in _FILES if "def_start" in path.read_text(encoding="utf-8"))


@cache
def checked(path: Path) -> tuple[Ruleset, dict[str, CheckResult]]:
    """A ruleset, and the result of each check by its name."""
    ruleset = load(path)
    return ruleset, {result.name: result for result in run_checks(ruleset)}
