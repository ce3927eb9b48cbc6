"""Incremental checks compared with checks of the whole text."""

from __future__ import annotations

from collections.abc import Iterable

from sleec_runtime.errors import LanguageError
from sleec_runtime.language import parse
from sleec_verify.checks import run_checks
from sleec_verify.checks.incremental.checking import IncrementalChecks
from sleec_verify.results.finding import CheckResult, Verdict


def without_seconds(results: Iterable[CheckResult]) -> list[tuple[str, Verdict, str | None]]:
    return [(result.name, result.verdict, result.reason) for result in results]


def assert_equal_to_whole_checks(texts: Iterable[str]) -> None:
    """Check one text after the other. Findings, places, words and order are those of a check of the text alone."""
    checks = IncrementalChecks()
    for text in texts:
        try:
            ruleset = parse(text)
        except LanguageError:
            continue
        assert without_seconds(checks.results(ruleset)) == without_seconds(run_checks(ruleset)), text
