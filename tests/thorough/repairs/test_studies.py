"""The share of the issues in the published case studies for which there is a repair."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path

import pytest

from sleec_verify.repairs.search import RepairSearch
from tests.support.repairs import assert_is_repair
from tests.support.studies import PUBLISHED, checked, published_files, published_only

ISSUES = ("SLEEC101", "SLEEC102", "SLEEC104", "SLEEC105", "SLEEC107", "SLEEC202", "SLEEC301", "SLEEC302")
"""Conflicts, concerns, purposes, forbidden inputs and redundancies."""
WITHOUT_REPAIR: Mapping[str, Mapping[str, int]] = {
    "jss_running_example": {"SLEEC301": 1},
    "ALMI-tutorial": {"SLEEC102": 1},
    "TABIAT": {"SLEEC101": 3, "SLEEC102": 2, "SLEEC104": 3, "SLEEC105": 2},
    "covidfree": {"SLEEC101": 2, "SLEEC102": 1},
}
"""In the first one, a check of the rules without the redundant one is unknown."""
LONG = (
    "firefighter-initial",
    "jss_running_example",
    "Autocar-corrected",
    "Autocar",
    "TABIAT",
    "covidfree",
    "firefighter-valid",
)
"""Files with many issues, or with hard ones."""


def _files() -> Iterable[object]:
    for path in published_files():
        marks = [pytest.mark.long] if path.stem in LONG else []
        yield pytest.param(path, id=f"{path.parent.name}-{path.stem}", marks=marks)
    if not PUBLISHED.is_dir():
        yield pytest.param(None, id="published", marks=published_only)


@pytest.mark.slow
@pytest.mark.parametrize("path", [*_files()])
def test_issues_have_repairs(path: Path) -> None:
    ruleset, by_name = checked(path)
    results = tuple(by_name.values())
    search = RepairSearch(ruleset, results)
    missing: Counter[str] = Counter()
    for result in results:
        for finding in result.findings:
            if finding.code in ISSUES:
                repairs = search.repairs(finding)
                if repairs:
                    assert_is_repair(ruleset, results, repairs[0])
                else:
                    missing[finding.code] += 1
                    assert search.reason or search.undecided
    assert missing == WITHOUT_REPAIR.get(path.stem, {})
