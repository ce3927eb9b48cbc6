"""Identifiers of repairs, such as ``SLEEC101:3``: they count the repairs of a code in the order of the report."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from sleec_verify.checks import Progress
from sleec_verify.encoding.budget import FILE_SPENT, Budget, current, limited_to_steps, share, steps_for
from sleec_verify.repairs.operators import OPERATORS
from sleec_verify.repairs.repair import Repair
from sleec_verify.repairs.search import RepairSearch
from sleec_verify.results.finding import SEVERITIES, Finding
from sleec_verify.wording.sentence import sentence

_MOST_OF_REST = 1 / 2
"""The part of the remaining budget that one finding may spend."""


class NumberedRepair(NamedTuple):
    """A repair and its identifier."""

    identifier: str
    repair: Repair


class FindingRepairs(NamedTuple):
    """A finding and its repairs, what takes away least first. `undecided` says why there may be more, if there may, and
    `reason` why there is none, if there is none."""

    finding: Finding
    repairs: tuple[NumberedRepair, ...]
    undecided: str | None = None
    reason: str | None = None


def numbered_repairs(
    findings: Sequence[Finding], search: RepairSearch, progress: Progress | None = None
) -> Iterator[FindingRepairs]:
    """The repairs of `findings`, which are all of a report, in its order: first those of errors, then of warnings.

    The findings are searched one after the other with one budget: that of the file, unless there is a budget already.
    Each may spend a part of the rest. Those that the budget does not reach are not searched, and say so.
    """
    counts: Counter[str] = Counter()
    steps = steps_for(len(search.source.text))
    for done, finding in enumerate(sorted(findings, key=lambda one: SEVERITIES.index(one.severity))):
        if progress is not None:
            progress(f"repairs of {finding.code}", done, len(findings))
        repairs = []
        found: list[Repair] = []
        undecided: str | None = None
        reason: str | None = None
        with limited_to_steps(int(steps), FILE_SPENT) as budget:
            if budget.is_spent() and finding.code in OPERATORS:
                undecided = _not_searched(budget)
            else:
                with share(_MOST_OF_REST if done + 1 < len(findings) else 1):
                    found, undecided, reason = search.repairs(finding), search.undecided, search.reason
            if not budget.is_timed:
                steps = int(budget.steps)
        for repair in found:
            counts[finding.code] += 1
            repairs.append(NumberedRepair(f"{finding.code}:{counts[finding.code]}", repair))
        if undecided is not None and ends_by_time():
            undecided += "; another run may number the repairs in another way"
        yield FindingRepairs(finding, tuple(repairs), undecided, reason)


def _not_searched(budget: Budget) -> str:
    return sentence("the search ended before this finding: {why}", why=budget.reason)


def ends_by_time() -> bool:
    """Whether another run may find other repairs, and number them in another way."""
    budget = current()
    return budget is not None and budget.is_timed
