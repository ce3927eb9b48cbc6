"""The summary of an audit: observations, clause coverage and response times, as text and as JSON values."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_runtime.language.common.formula_printer import print_number
from sleec_verify.audit.findings import kind_of
from sleec_verify.wording.phrases import counted

if TYPE_CHECKING:
    from sleec_runtime.model import Rational, Ruleset
    from sleec_verify.audit.mission_result import AuditSummary, MissionResult
    from sleec_verify.audit.record import Record
    from sleec_verify.results.json_values import Json

_QUANTILES = ("min", "median", "95 %", "max")


def lines(audit: AuditSummary, ruleset: Ruleset) -> Iterator[str]:
    """The summary for people."""
    for mission in audit.missions:
        yield f"{mission.path}: {_observed(mission)} (tolerance {print_number(audit.tolerance)} s)"
    clauses = _clauses(audit, ruleset)
    decided = sum(bool(times) for _, _, _, times in clauses)
    yield f"clause coverage: {decided} of {len(clauses)}"
    width = max((len(layer) for _, _, layer, _ in clauses), default=0)
    yield from (f"  {layer:{width}}  {times:,}" for _, _, layer, times in clauses)
    if audit.responses:
        yield from ("response times in seconds", *_table(audit, ruleset))


def _table(audit: AuditSummary, ruleset: Ruleset) -> Iterator[str]:
    """A row for each obligation of a clause. The last column is the largest share of the window."""
    rows = [("", "executed", "missed", *_QUANTILES, "of window")]
    for one in audit.responses:
        layer = ruleset.by_label[one.rule].layer(one.clause) or one.rule
        seconds = ("",) * len(_QUANTILES) if one.seconds is None else [_rounded(value) for value in one.seconds]
        share = "" if one.shares is None else f"{one.shares.max:.0%}"
        rows.append((f"{one.obligation} ({layer})", f"{one.executed:,}", f"{one.missed:,}", *seconds, share))
    widths = [max(map(len, column)) for column in zip(*rows)]
    for first, *others in rows:
        cells = [f"{cell:>{width}}" for cell, width in zip(others, widths[1:])]
        yield f"  {first:{widths[0]}}  {'  '.join(cells)}".rstrip()


def json_of(audit: AuditSummary, ruleset: Ruleset) -> Json:
    """The summary for programs. Times are in seconds."""
    return {
        "tolerance": float(audit.tolerance),
        "missions": [
            {
                "path": mission.path,
                "observations": mission.observations,
                "first": _optional(mission.first),
                "last": _optional(mission.last),
                "deviations": [_record(record) for record in mission.records],
                "unlisted": mission.more,
            }
            for mission in audit.missions
        ],
        "coverage": [
            {"rule": rule, "clause": clause, "layer": layer, "times": times}
            for rule, clause, layer, times in _clauses(audit, ruleset)
        ],
        "undetermined": dict(sorted(audit.coverage.undetermined.items())),
        "responses": [
            {
                "rule": one.rule,
                "clause": one.clause,
                "obligation": one.obligation,
                "executed": one.executed,
                "missed": one.missed,
                "seconds": None if one.seconds is None else one.seconds._asdict(),
                "window_share": None if one.shares is None else one.shares._asdict(),
            }
            for one in audit.responses
        ],
    }


def _clauses(audit: AuditSummary, ruleset: Ruleset) -> list[tuple[str, int, str, int]]:
    """Each clause: its rule, its number, the name of its layer, and how often it decided."""
    counts = audit.coverage.clauses
    return [
        (rule.label, number, rule.layer(number) or rule.label, counts[rule.label, number])
        for rule in ruleset.rules
        for number, _ in enumerate(rule.clauses())
    ]


def _observed(mission: MissionResult) -> str:
    said = counted(mission.observations, "observation")
    if mission.first is None or mission.last is None:
        return said
    return f"{said} in {print_number(mission.last - mission.first)} s"


def _record(record: Record) -> Json:
    return {
        "code": kind_of(record).code,
        "kind": record.kind,
        "message": record.message,
        "time": _optional(record.time),
        "triggered": _optional(record.since),
        "rule": record.rule,
        "clause": record.clause,
        "obligation": record.obligation,
        "from": _optional(record.first),
        "until": _optional(record.last),
        "decided_by": list(record.reasons),
    }


def _optional(number: Rational | None) -> float | None:
    return None if number is None else float(number)


def _rounded(seconds: float) -> str:
    return f"{seconds:,.0f}" if seconds >= 100 else f"{seconds:.3g}"
