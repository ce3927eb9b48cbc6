"""Findings of two checks that people see once.

A dead rule can always be removed, so it is redundant as well, which adds nothing. For a dead hedge, redundancy adds
that its removal is safe. This is not always so: in the reading `cascade`, its condition counts for later hedges.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING

from sleec_verify.wording.sentence import sentence

if TYPE_CHECKING:
    from sleec_verify.results.finding import Finding

_ALSO = {"redundant-rule": "dead-rule", "redundant-hedge": "dead-hedge"}


def deduplicate(findings: Iterable[Finding]) -> list[Finding]:
    """The findings without those about a redundant rule or hedge that is also reported as dead."""
    found = list(findings)
    dead = {_of(finding, finding.check) for finding in found if finding.check in _ALSO.values()}
    removable = {
        _of(finding, _ALSO[finding.check])
        for finding in found
        if finding.check in _ALSO and _of(finding, _ALSO[finding.check]) in dead
    }
    return [
        replace(finding, help=sentence("{help}; the rules mean the same without it", help=finding.help or ""))
        if finding.check == "dead-hedge" and _of(finding, finding.check) in removable
        else finding
        for finding in found
        if finding.check not in _ALSO or _of(finding, _ALSO[finding.check]) not in removable
    ]


def stands_for(finding: Finding, check: str, others: Iterable[Finding]) -> bool:
    """Whether a finding is one of the `others`, which are those of `check`, or stands for one that is left out."""
    if finding.check == check:
        return True
    return finding.check == _ALSO.get(check) and any(
        _of(one, finding.check) == _of(finding, finding.check) for one in others
    )


def _of(finding: Finding, check: str) -> tuple[object, ...]:
    """The rule or hedge of a finding."""
    return check, finding.rules[:1], finding.clauses, finding.span, finding.domains
