"""For programs: all results as one JSON object (docs/schema/check.schema.json)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from sleec_verify import __version__
from sleec_verify.report.outcome import Outcome, UnusableInput, checked, tally
from sleec_verify.results.finding import Unknown
from sleec_verify.results.json_values import VERDICTS, Json, dump, error_json, finding_json

if TYPE_CHECKING:
    from sleec_verify.report.palette import Palette
    from sleec_verify.results.finding import CheckResult


def render(outcomes: Sequence[Outcome], palette: Palette) -> Iterator[str]:
    """One object with the keys ``tool``, ``rulesets`` and ``summary``."""
    del palette  # a program reads this
    counts = tally(finding for outcome in checked(outcomes) for finding in outcome.findings)
    yield dump(
        {
            "tool": {"name": "sleec-verify", "version": __version__},
            "rulesets": [_ruleset(outcome) for outcome in outcomes],
            "summary": {f"{severity}s": number for severity, number in counts.items()},
        }
    )


def _ruleset(outcome: Outcome) -> Json:
    if isinstance(outcome, UnusableInput):
        return {"path": outcome.path, "error": error_json(outcome.error)}
    ruleset = outcome.ruleset
    return {
        "path": ruleset.source.path,
        "sha256": ruleset.source.sha256,
        "syntax": ruleset.syntax,
        "reading": ruleset.reading,
        **({} if outcome.untimed is None else {"untimed": outcome.untimed}),
        "rules": len(ruleset.rules),
        "hedges": outcome.hedges,
        "checks": [_check(result) for result in outcome.results],
        "findings": [finding_json(finding, finding.source or ruleset.source) for finding in outcome.findings],
    }


def _check(result: CheckResult) -> Json:
    verdict = result.verdict
    return {
        "name": result.name,
        "verdict": VERDICTS[type(verdict)],
        "seconds": round(result.seconds, 6),
        "reason": verdict.why if isinstance(verdict, Unknown) else result.reason,
    }
