"""The results of `gate` as outcomes of checks, so that every format of `check` can show them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from sleec_runtime.model import Ruleset
from sleec_verify.changes.gate import POLICY_CHANGES
from sleec_verify.report.outcome import CheckedRuleset, Outcome, UnusableInput
from sleec_verify.results.finding import CheckResult, Finding, Proved, Refuted, Unknown, Verdict

if TYPE_CHECKING:
    from sleec_runtime.errors import SleecError
    from sleec_runtime.model import Source
    from sleec_verify.changes.gate import GateResult, RulesetExamination, TargetConformance

_OWN = ("findings", "dead-hedges")
"""Policies that block because of findings, which are outcomes already."""


def outcomes(found: GateResult) -> list[Outcome]:
    """An outcome for each changed settings file, for each ruleset that was examined or has an assertion, and for each
    target.

    Findings that are allowed or in the baseline are omitted. A reason to block that is not the finding of a check
    becomes a finding of a check with the name of the policy. The same holds for changes that the policy allows.
    """
    made: list[Outcome] = [*_of_settings(found)]
    blocks = _by_path(found)
    for one in found.examined:
        made += (UnusableInput(one.path, _of_path(error, one)) for error in one.errors)
        ruleset = one.ruleset or _gone(one)
        if ruleset is not None:
            results = [replace(result, verdict=_counted(result.verdict, one.findings)) for result in one.results]
            made.append(CheckedRuleset(ruleset, (*results, *_of_comparison(one), *blocks.pop(one.path, ()))))
    for _, ruleset, _ in found.asked:
        asked = blocks.pop(found.paths[ruleset.source.path], ())
        if asked:
            made.append(CheckedRuleset(ruleset, tuple(asked)))
    for conformed in found.conformed:
        made += _of_code(conformed)
    return made


def _of_settings(found: GateResult) -> Iterator[Outcome]:
    """The changes in each settings file."""
    grouped: dict[Source, list[Finding]] = {}
    for change in found.changes:
        if change.policy == POLICY_CHANGES and change.finding is not None and change.finding.source is not None:
            grouped.setdefault(change.finding.source, []).append(change.finding)
    for source, findings in grouped.items():
        result = CheckResult(POLICY_CHANGES, Refuted(tuple(findings)), 0.0)
        yield CheckedRuleset(Ruleset((), source=source), (result,), settings=True)


def _by_path(found: GateResult) -> dict[str, list[CheckResult]]:
    """The results of policies and undecided assertions, by ruleset."""
    grouped: dict[str, dict[str, list[Finding]]] = {}
    for block in (*found.blocks, *found.tolerated):
        if block.policy not in (*_OWN, POLICY_CHANGES) and block.finding is not None:
            grouped.setdefault(block.where, {}).setdefault(block.policy, []).append(block.finding)
    results = {
        path: [CheckResult(name, Refuted(tuple(findings)), 0.0) for name, findings in policies.items()]
        for path, policies in grouped.items()
    }
    for assertion, ruleset, answer in found.asked:
        if isinstance(answer, str):
            unknown = CheckResult("assertions", Unknown(f"{assertion.text}: {answer}"), 0.0)
            results.setdefault(found.paths[ruleset.source.path], []).append(unknown)
    return results


def _counted(verdict: Verdict, counting: Iterable[Finding]) -> Verdict:
    """A verdict with only the findings in `counting`."""
    if isinstance(verdict, Proved):
        return verdict
    wanted = {id(finding) for finding in counting}
    findings = tuple(finding for finding in verdict.findings if id(finding) in wanted)
    if isinstance(verdict, Unknown):
        return Unknown(verdict.why, findings)
    return Refuted(findings) if findings else Proved()


def _of_comparison(one: RulesetExamination) -> Iterator[CheckResult]:
    """The undecided parts of the comparison."""
    for what, why in () if one.difference is None else one.difference.undecided:
        yield CheckResult("comparison", Unknown(f"{what}: {why}"), 0.0)


def _of_path(error: SleecError, one: RulesetExamination) -> SleecError:
    """An error without places if it is about the base, whose text is another one."""
    from sleec_runtime.errors import LanguageError, SleecError

    if not isinstance(error, LanguageError) or one.ruleset is None:
        return error
    return SleecError(str(error).partition("\n")[0])


def _gone(one: RulesetExamination) -> Ruleset | None:
    """An empty ruleset for a file that the change removes."""
    if one.difference is None:
        return None
    return replace(one.difference.new, source=replace(one.difference.new.source, path=one.path))


def _of_code(one: TargetConformance) -> Iterator[Outcome]:
    if one.error is not None:
        yield UnusableInput(one.target.code, one.error)
    elif one.ruleset is not None and one.result is not None:
        known = {id(finding) for finding in one.known}
        counting = [finding for finding in one.result.findings if id(finding) not in known]
        yield CheckedRuleset(one.ruleset, (replace(one.result, verdict=_counted(one.result.verdict, counting)),))
