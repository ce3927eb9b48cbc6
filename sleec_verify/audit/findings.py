"""The results of audits as findings with a verdict."""

from __future__ import annotations

from collections.abc import Sequence

from sleec_runtime.model import Rule, Ruleset, Source, Span
from sleec_verify.audit.kinds import KINDS, NAME
from sleec_verify.audit.mission_result import MissionResult
from sleec_verify.audit.record import Record
from sleec_verify.results.finding import CheckResult, ClauseRef, Finding, Proved, Refuted, Unknown, Verdict
from sleec_verify.results.finding_kind import FindingKind
from sleec_verify.wording.phrases import counted

INCONCLUSIVE = {
    "nothing-audited": "no rule is triggered",
    "undetermined": "decisions depend on values that were not reported",
    "open": "a log ends before a window closes",
    "unreadable": "a part of a log cannot be used",
    "wrong-value": "values do not fit their conditions",
    "out-of-order": "a log is not in chronological order",
    "unrecorded-topic": "a recording does not have a topic of the mapping",
}
"""The kinds with which an audit is not a pass, and why."""
_SHARED = {"wrong-value": "unreadable", "unrecorded-topic": "missing-topic"}
"""The kinds that have the code of another one."""


def result_of(missions: Sequence[MissionResult], ruleset: Ruleset, seconds: float) -> CheckResult:
    """The verdict on some missions: proved, refuted, or unknown where something is not known."""
    findings = tuple(_finding(record, mission.path, ruleset) for mission in missions for record in mission.records)
    kinds = {record.kind for mission in missions for record in mission.records}
    unknown = "; ".join(why for kind, why in INCONCLUSIVE.items() if kind in kinds)
    more = sum(mission.more for mission in missions)
    left = [f"{counted(more, 'more deviation')} of the same kinds are not listed"] if more else []
    verdict: Verdict = Refuted(findings) if findings else Proved()
    if unknown and all(finding.severity != "error" for finding in findings):
        verdict = Unknown(unknown, findings)
    elif unknown:
        left.append(unknown)
    reason = "; ".join(left) or None
    return CheckResult(NAME, verdict, seconds, reason)


def _finding(record: Record, path: str, ruleset: Ruleset) -> Finding:
    """A deviation as a finding at the clause or statement of the rules; a problem of the log, in the log at `path`."""
    kind = kind_of(record)
    source: Source | None = None
    span = Span(0, 0)
    clauses: tuple[ClauseRef, ...] = ()
    if record.rule is not None:
        rule = ruleset.by_label[record.rule]
        span = _place(rule, record.clause)
        clauses = () if record.clause is None else (ClauseRef(record.rule, record.clause),)
    elif record.statement is not None:
        span = ruleset.statements[record.statement].span
    else:
        source = Source(path, "", first_line=record.line or 1)
    return Finding(
        NAME,
        kind.code,
        kind.severity,
        record.message if source is not None else f"{path}: {record.message}",
        span,
        () if record.rule is None else (record.rule,),
        clauses,
        () if record.obligation is None else (record.obligation,),
        note="; ".join(record.reasons) or None,
        source=source,
    )


def kind_of(record: Record) -> FindingKind:
    """The kind of finding of a record."""
    return KINDS[_SHARED.get(record.kind, record.kind)]


def _place(rule: Rule, clause: int | None) -> Span:
    return rule.heading_span if clause is None else tuple(rule.clauses())[clause].span
