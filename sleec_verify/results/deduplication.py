"""What is told to people once, though two checks find it.

A rule that is active nowhere can always be removed, so that it is redundant says nothing more. Of a hedge that decides
nowhere it says that removing it is safe. It need not be: in the reading `cascade`, its condition counts for the others.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sleec_verify.results.finding import Finding

_ALSO = {"redundant-rule": "dead-rule", "redundant-hedge": "dead-hedge"}


def deduplicate(findings: Iterable[Finding]) -> list[Finding]:
    """The findings without those on a rule or hedge that can be removed, where another says that it is dead."""
    found = list(findings)
    dead = {_of(finding, finding.check) for finding in found if finding.check in _ALSO.values()}
    removable = {
        _of(finding, _ALSO[finding.check])
        for finding in found
        if finding.check in _ALSO and _of(finding, _ALSO[finding.check]) in dead
    }
    return [
        replace(finding, help=f"{finding.help}; the rules mean the same without it")
        if finding.check == "dead-hedge" and _of(finding, finding.check) in removable
        else finding
        for finding in found
        if finding.check not in _ALSO or _of(finding, _ALSO[finding.check]) not in removable
    ]


def _of(finding: Finding, check: str) -> tuple[object, ...]:
    """The rule or hedge that a finding is about, as one of `check`."""
    return check, finding.rules[:1], finding.clauses, finding.span, finding.domains
