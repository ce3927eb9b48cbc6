"""For GitLab: a code quality report. GitLab shows it in merge requests and separates new findings from old ones."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from hashlib import sha256
from typing import TYPE_CHECKING

from sleec_verify.report.outcome import CheckedRuleset, Outcome
from sleec_verify.report.plain import described, in_project, located, troubles
from sleec_verify.results.json_values import Json, dump

if TYPE_CHECKING:
    from sleec_runtime.model import Place
    from sleec_verify.report.palette import Palette
    from sleec_verify.results.finding import Severity

_SEVERITIES: Mapping[Severity, str] = {"error": "critical", "warning": "major", "note": "info"}


def render(outcomes: Sequence[Outcome], palette: Palette) -> Iterator[str]:
    """A list of findings. An inconclusive check is ``critical``; a text that cannot be read is a ``blocker``."""
    del palette  # a program reads this
    seen: dict[str, int] = {}
    issues: list[Json] = []
    for outcome in outcomes:
        if not isinstance(outcome, CheckedRuleset):
            for path, message, place in troubles(outcome):
                issues.append(_issue("unusable", "blocker", path, place, message, _hash("unusable", path, message)))
            continue
        for finding, source, fingerprint in located(outcome, seen):
            text = "\n".join([f"{finding.code}: {finding.message}", *described(finding)])
            place, severity = source.place(finding.span), _SEVERITIES[finding.severity]
            issues.append(_issue(finding.check, severity, source.path, place, text, fingerprint))
        path = outcome.ruleset.source.path
        for name, why in outcome.unlisted:
            issues.append(_issue(name, "info", path, None, why, _hash("unlisted", path, name)))
        for name, why in outcome.undecided:
            text = f"{name} is inconclusive: {why}"
            issues.append(_issue(name, "critical", path, None, text, _hash("unknown", path, name)))
    yield dump(issues)


def _issue(check: str, severity: str, path: str, place: Place | None, text: str, fingerprint: str) -> Json:
    # The format requires a line: issues about a whole file are at its first line.
    lines: dict[str, Json] = {"begin": 1} if place is None else {"begin": place.line, "end": place.end_line}
    return {
        "description": text,
        "check_name": check,
        "fingerprint": fingerprint,
        "severity": severity,
        "location": {"path": in_project(path), "lines": lines},
    }


def _hash(what: str, path: str, name: str) -> str:
    return sha256(ascii((what, in_project(path), name)).encode()).hexdigest()
