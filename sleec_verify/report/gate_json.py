"""The output of `gate` for programs: one JSON object (docs/schema/gate.schema.json)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from sleec_runtime.model import NOWHERE
from sleec_verify import __version__
from sleec_verify.results.json_values import VERDICTS, dump, error_json, finding_json, span_json, witness_json

if TYPE_CHECKING:
    from sleec_runtime.certificate.manifest import Manifest
    from sleec_runtime.model import Source
    from sleec_verify.changes.assertions.assertion import AssertionResult
    from sleec_verify.changes.gate import Block, GateResult, RulesetExamination, TargetConformance
    from sleec_verify.report.palette import Palette
    from sleec_verify.results.json_values import Json


def render(found: GateResult, palette: Palette) -> Iterator[str]:
    """All results as one object."""
    del palette  # a program reads this
    sources = {path: ruleset.source for _, ruleset, _ in found.asked for path in [found.paths[ruleset.source.path]]}
    sources |= {one.path: one.ruleset.source for one in found.examined if one.ruleset is not None}
    yield dump(
        {
            "tool": {"name": "sleec-verify", "version": __version__},
            "base": found.base,
            "status": found.status,
            "blocks": [_block(block, sources) for block in found.blocks],
            "policy_changes": [_change(change, found, sources) for change in found.changes],
            "unknown": [{"where": block.where, "what": block.what} for block in found.unknown],
            "rulesets": [_examined(one) for one in found.examined],
            "targets": [_conformed(one) for one in found.conformed],
            "assertions": [_asked(one, found.paths) for one in found.asked],
            "unchanged": found.unchanged,
            "stale": found.stale,
        }
    )


def _block(block: Block, sources: Mapping[str, Source]) -> dict[str, Json]:
    finding = block.finding
    assert finding is not None, "what blocks has a finding"
    source = finding.source or sources.get(block.where)
    return {
        "policy": block.policy,
        "where": block.where,
        "what": block.what,
        "rules": list(finding.rules),
        "obligations": list(finding.obligations),
        "span": None if source is None or finding.span == NOWHERE else span_json(finding.span, source),
        "witness": None if finding.witness is None else witness_json(finding.witness),
    }


def _change(change: Block, found: GateResult, sources: Mapping[str, Source]) -> Json:
    shown = _block(change, sources)
    return {key: shown[key] for key in ("policy", "where", "what", "span")} | {"blocks": change in found.blocks}


def _examined(one: RulesetExamination) -> Json:
    ruleset = one.ruleset
    reached = one.coverage
    return {
        "path": one.path,
        "moved_from": one.was,
        "relation": None if one.difference is None else one.difference.relation,
        "checks": [{"name": result.name, "verdict": VERDICTS[type(result.verdict)]} for result in one.results],
        "findings": []
        if ruleset is None
        else [finding_json(finding, finding.source or ruleset.source) for finding in one.findings],
        "allowed": [
            {"code": finding.code, "rules": list(finding.rules), "reason": suppression.reason}
            for finding, suppression in one.allowed
        ],
        "baseline": len(one.known),
        "unused_suppressions": [{"line": one.line(unused.span), "allowed": [unused.allowed]} for unused in one.unused],
        "coverage": None
        if reached is None
        else {
            "reached": reached.reached,
            "clauses": reached.clauses,
            "missed": list(reached.missed),
            "windows_reached": reached.windows_reached,
            "windows": reached.windows,
        },
        "certificate": _certificate(one.certificate),
        "errors": [error_json(error) for error in one.errors],
    }


def _certificate(found: Manifest | str | None) -> Json:
    if found is None or isinstance(found, str):
        return None
    from sleec_verify.report.certificate import scope_json

    return scope_json(found.whole)


def _conformed(one: TargetConformance) -> Json:
    findings = [
        finding_json(finding, finding.source or one.ruleset.source)
        for finding in one.findings
        if one.ruleset is not None
    ]
    return {
        "code": one.target.code,
        "rules": one.target.rules,
        "domain": one.target.domain,
        "verdict": None if one.result is None else _verdict(one),
        "findings": [dict(finding) for finding in findings],
        "baseline": len(one.known),
        "error": None if one.error is None else error_json(one.error),
    }


def _verdict(one: TargetConformance) -> str:
    assert one.result is not None, "without a result there is no verdict"
    return VERDICTS[type(one.result.verdict)]


def _asked(one: AssertionResult, paths: Mapping[str, str]) -> Json:
    assertion, ruleset, answer = one
    return {
        "assertion": assertion.text,
        "ruleset": paths[ruleset.source.path],
        "holds": None if isinstance(answer, str) else answer is None,
        "reason": answer if isinstance(answer, str) else None,
        "witness": None if answer is None or isinstance(answer, str) else witness_json(answer.witness),
    }
