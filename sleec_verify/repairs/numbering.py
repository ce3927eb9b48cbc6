"""Identifiers of repairs, such as ``SLEEC101:3``: they count the repairs of a code in the order of the report."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from typing import NamedTuple

from sleec_verify.repairs.repair import Repair
from sleec_verify.repairs.search import RepairSearch
from sleec_verify.results.finding import Finding


class NumberedRepair(NamedTuple):
    """A repair and its identifier."""

    identifier: str
    repair: Repair


class FindingRepairs(NamedTuple):
    """A finding and its repairs, the smallest change first."""

    finding: Finding
    repairs: tuple[NumberedRepair, ...]


def numbered_repairs(findings: Iterable[Finding], search: RepairSearch) -> list[FindingRepairs]:
    """The repairs of `findings`, which are in the order of the report. Costs a search for each of them."""
    counts: Counter[str] = Counter()
    found = []
    for finding in findings:
        repairs = []
        for repair in search.repairs(finding):
            counts[finding.code] += 1
            repairs.append(NumberedRepair(f"{finding.code}:{counts[finding.code]}", repair))
        found.append(FindingRepairs(finding, tuple(repairs)))
    return found
