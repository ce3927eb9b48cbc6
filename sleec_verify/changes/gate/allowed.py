"""Findings that a suppression in the text or a baseline allows, for `check`, which has no base to compare with."""

from __future__ import annotations

import os
from collections.abc import Collection, Sequence
from dataclasses import replace

from sleec_runtime.model import Ruleset
from sleec_verify.changes.gate.baseline import Key, key
from sleec_verify.changes.gate.examination import suppressions_of
from sleec_verify.results.finding import CheckResult, Finding, Refuted, Unknown
from sleec_verify.results.suppressions import Suppression, text_to_write
from sleec_verify.wording.sentence import joined, sentence


def with_allowed(
    ruleset: Ruleset, results: Sequence[CheckResult], known: Collection[Key] = ()
) -> tuple[CheckResult, ...]:
    """The results with each allowed finding as a note that gives the reason. `known` are the findings of a baseline.

    The verdicts stay: what is allowed is not proved.
    """
    allowing = suppressions_of(ruleset)[0]
    if not allowing and not known:
        return tuple(results)
    return tuple(_in_result(ruleset, result, allowing, known) for result in results)


def _in_result(
    ruleset: Ruleset, result: CheckResult, allowing: Sequence[Suppression], known: Collection[Key]
) -> CheckResult:
    findings = tuple(_marked(ruleset, finding, allowing, known) for finding in result.findings)
    if isinstance(result.verdict, Refuted):
        return replace(result, verdict=Refuted(findings))
    return (
        replace(result, verdict=replace(result.verdict, findings=findings))
        if isinstance(result.verdict, Unknown)
        else result
    )


def _marked(ruleset: Ruleset, finding: Finding, allowing: Sequence[Suppression], known: Collection[Key]) -> Finding:
    reason = next((one.reason for one in allowing if one.allows(ruleset, finding)), None)
    if reason is None and _is_known(ruleset, finding, known):
        reason = sentence("it is in the baseline")
    if reason is not None:
        note = sentence("allowed: {reason}", reason=reason)
        return replace(finding, severity="note", allowed=reason, note=joined("; ", filter(None, (note, finding.note))))
    stale = next((one for one in allowing if one.covers(ruleset, finding)), None)
    if stale is None:
        return finding
    note = sentence("to allow this finding, write: {text}", text=text_to_write(ruleset, finding, stale.reason))
    return replace(finding, note=joined("; ", filter(None, (finding.note, note))))


def _is_known(ruleset: Ruleset, finding: Finding, known: Collection[Key]) -> bool:
    """Whether a baseline has a finding. Its paths are relative to the top of a repository, which `check` does not
    know, so the end of the path has to be the same."""
    if not known:
        return False
    path, *own = key(ruleset.source.path, ruleset, finding)
    whole = os.path.abspath(path).replace(os.sep, "/")
    return any(own == rest and f"/{whole}".endswith(f"/{where}") for where, *rest in known)
