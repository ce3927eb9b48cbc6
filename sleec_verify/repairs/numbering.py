"""Identifiers of repairs, such as ``SLEEC101:3``: they count the repairs of a code in the order of the report."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from sleec_verify.checks import Progress
from sleec_verify.encoding.budget import current
from sleec_verify.repairs.repair import Repair
from sleec_verify.repairs.search import RepairSearch
from sleec_verify.results.finding import Finding


class NumberedRepair(NamedTuple):
    """A repair and its identifier."""

    identifier: str
    repair: Repair


class FindingRepairs(NamedTuple):
    """A finding and its repairs, the smallest change first. `undecided` says why there may be more, if there may."""

    finding: Finding
    repairs: tuple[NumberedRepair, ...]
    undecided: str | None = None


def numbered_repairs(
    findings: Sequence[Finding], search: RepairSearch, progress: Progress | None = None
) -> Iterator[FindingRepairs]:
    """The repairs of `findings`, which are in the order of the report. Costs a search for each of them."""
    counts: Counter[str] = Counter()
    for done, finding in enumerate(findings):
        if progress is not None:
            progress(f"repairs of {finding.code}", done, len(findings))
        repairs = []
        for repair in search.repairs(finding):
            counts[finding.code] += 1
            repairs.append(NumberedRepair(f"{finding.code}:{counts[finding.code]}", repair))
        undecided = search.undecided
        if undecided is not None and ends_by_time():
            undecided += "; another run may number the repairs in another way"
        yield FindingRepairs(finding, tuple(repairs), undecided)


def ends_by_time() -> bool:
    """Whether another run may find other repairs, and number them in another way."""
    budget = current()
    return budget is not None and budget.is_timed
