"""The documentation of finding codes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sleec_verify.results.finding import Severity


@dataclass(frozen=True)
class FindingKind:
    """The documentation of one finding code: `bad` is a ruleset with the problem, `good` is `bad` without it, and
    `mend` says how to fix it."""

    code: str
    severity: Severity
    title: str
    explanation: str
    mend: str
    bad: str
    good: str
