"""For programs: all results as one JSON object (docs/schema/check.schema.json)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from sleec_runtime.model import Span
from sleec_verify import __version__
from sleec_verify.report.outcome import CheckedRuleset, Outcome, UnusableInput, checked, tally
from sleec_verify.results.finding import Unknown
from sleec_verify.results.json_values import VERDICTS, Json, dump, error_json, finding_json, span_json

if TYPE_CHECKING:
    from sleec_runtime.model import Source
    from sleec_verify.repairs.numbering import NumberedRepair
    from sleec_verify.report.palette import Palette
    from sleec_verify.results.finding import CheckResult, Finding


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
    audited: dict[str, Json] = {}
    if outcome.audit is not None:
        from sleec_verify.report.audit import json_of

        audited = {"audit": json_of(outcome.audit, ruleset)}
    return {
        "path": ruleset.source.path,
        "sha256": ruleset.source.sha256,
        "syntax": ruleset.syntax,
        "reading": ruleset.reading,
        **({} if outcome.untimed is None else {"untimed": outcome.untimed}),
        "rules": len(ruleset.rules),
        "hedges": outcome.hedges,
        "checks": [_check(result) for result in outcome.results],
        "findings": [_finding(finding, outcome) for finding in outcome.findings],
        **audited,
    }


def _finding(finding: Finding, outcome: CheckedRuleset) -> Json:
    source = outcome.ruleset.source
    shown = finding_json(finding, finding.source or source)
    if finding.allowed is not None:
        shown = {**shown, "allowed": finding.allowed}
    repairs = outcome.repairs_of(finding)
    if repairs is None:
        return shown
    unknown: dict[str, Json] = {} if repairs.undecided is None else {"repairs_unknown": repairs.undecided}
    if repairs.reason is not None:
        unknown["repairs_none"] = repairs.reason
    return {**shown, "repairs": [_repair(one, source) for one in repairs.repairs], **unknown}


def _repair(one: NumberedRepair, source: Source) -> Json:
    from sleec_verify.report.repair_phrases import effect_in_words

    candidate, effect = one.repair.candidate, one.repair.effect
    return {
        "id": one.identifier,
        "operator": candidate.operator,
        "title": candidate.title,
        "edits": [
            {"span": span_json(Span(edit.start, edit.end), source), "text": edit.text} for edit in candidate.edits
        ],
        "effect": effect_in_words(one.repair),
        "situations": effect.situations,
        "keeps_meaning": effect.keeps_meaning,
    }


def _check(result: CheckResult) -> Json:
    verdict = result.verdict
    return {
        "name": result.name,
        "verdict": VERDICTS[type(verdict)],
        "seconds": round(result.seconds, 6),
        "reason": verdict.why if isinstance(verdict, Unknown) else result.reason,
    }
