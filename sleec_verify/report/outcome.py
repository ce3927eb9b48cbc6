"""The outcome for each file: its checks, or the error why it cannot be read."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple, Union

from sleec_verify.results.deduplication import deduplicate
from sleec_verify.results.finding import SEVERITIES, Unknown
from sleec_verify.wording.phrases import counted
from sleec_verify.wording.sentence import joined, sentence

if TYPE_CHECKING:
    from sleec_runtime.errors import SleecError
    from sleec_runtime.model import Ruleset
    from sleec_verify.audit.mission_result import AuditSummary
    from sleec_verify.encoding.trace_scope import Untimed
    from sleec_verify.repairs.numbering import FindingRepairs
    from sleec_verify.results.finding import CheckResult, Finding, Severity


class CheckedRuleset(NamedTuple):
    """A ruleset and the results of its checks, in order. `untimed` is the meaning of a response without a window; None
    for rules without time. `settings`: it is a settings file, and the ruleset only holds its path. `repairs` are those
    of the findings in `deduplicated`; None if nobody asked for them. `audit` is the summary of audited missions."""

    ruleset: Ruleset
    results: tuple[CheckResult, ...]
    untimed: Untimed | None = None
    settings: bool = False
    repairs: tuple[FindingRepairs, ...] | None = None
    audit: AuditSummary | None = None

    def repairs_of(self, finding: Finding) -> FindingRepairs | None:
        """The repairs of a finding; None if nobody asked for them, or if another finding stands for this one."""
        return next((one for one in self.repairs or () if _identity(one.finding) == _identity(finding)), None)

    @property
    def findings(self) -> list[Finding]:
        """All findings, sorted by file, place, severity (highest first) and code."""
        found = (finding for result in self.results for finding in result.findings)
        return sorted(found, key=lambda f: (_path(f), f.span, SEVERITIES.index(f.severity), f.code))

    @property
    def deduplicated(self) -> list[Finding]:
        """The findings without duplicates, for people."""
        return deduplicate(self.findings)

    @property
    def undecided(self) -> list[tuple[str, str]]:
        """The inconclusive checks, each with the reason."""
        return [(r.name, r.verdict.why) for r in self.results if isinstance(r.verdict, Unknown)]

    @property
    def unlisted(self) -> list[tuple[str, str]]:
        """The checks that list only a part of their findings, each with a message."""
        return [(r.name, r.reason) for r in self.results if r.reason is not None]

    @property
    def hedges(self) -> int:
        """The number of hedge clauses in the rules."""
        return sum(sum(1 for _ in rule.clauses()) - 1 for rule in self.ruleset.rules)


def _identity(finding: Finding) -> tuple[object, ...]:
    return finding.code, finding.span, finding.rules, finding.clauses, finding.obligations, finding.domains


def _path(finding: Finding) -> str:
    return "" if finding.source is None else finding.source.path


class UnusableInput(NamedTuple):
    """A file that is not a ruleset, or cannot be read."""

    path: str
    error: SleecError


Outcome = Union[CheckedRuleset, UnusableInput]


def checked(outcomes: Sequence[Outcome]) -> Iterator[CheckedRuleset]:
    """The outcomes that have results."""
    return (outcome for outcome in outcomes if isinstance(outcome, CheckedRuleset))


def tally(findings: Iterable[Finding]) -> dict[Severity, int]:
    """The number of findings of each severity."""
    counts: dict[Severity, int] = dict.fromkeys(SEVERITIES, 0)
    for finding in findings:
        counts[finding.severity] += 1
    return counts


def deduplicated_findings(outcomes: Sequence[Outcome]) -> list[Finding]:
    """All findings without duplicates, for people."""
    return [finding for outcome in checked(outcomes) for finding in outcome.deduplicated]


def severity_count(number: int, severity: Severity) -> str:
    """``1 error``, ``no warnings``"""
    words: dict[Severity, str] = {
        "error": counted(number, "error"),
        "warning": counted(number, "warning"),
        "note": counted(number, "note"),
    }
    return words[severity]


def in_short(outcomes: Sequence[Outcome]) -> str:
    """``2 rulesets: 1 error, no warnings, no notes, 1 unknown, 1 unusable``; the last two only if they are not 0."""
    found = tally(deduplicated_findings(outcomes)).items()
    parts = [severity_count(number, severity) for severity, number in found]
    undecided = sum(len(outcome.undecided) for outcome in checked(outcomes))
    unusable = sum(isinstance(outcome, UnusableInput) for outcome in outcomes)
    parts += [sentence("{number} unknown", number=undecided)] if undecided else []
    parts += [sentence("{number} unusable", number=unusable)] if unusable else []
    rulesets = sum(not (isinstance(outcome, CheckedRuleset) and outcome.settings) for outcome in outcomes)
    return joined(": ", [counted(rulesets, "ruleset"), joined(", ", parts)])
