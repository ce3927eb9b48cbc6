"""The verdict on a change to the rules."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence, Set
from typing import TYPE_CHECKING

from sleec_runtime.errors import SleecError
from sleec_runtime.language import parse_source
from sleec_runtime.model import Ruleset
from sleec_verify.changes.gate.assertion_results import AssertionSources, RulesetVersions, verify_assertions
from sleec_verify.changes.gate.baseline import Key, KnownFindings
from sleec_verify.changes.gate.examination import Check, Examiner, Locate, check_ruleset, evidence, suppressions_of
from sleec_verify.changes.gate.keys import Target
from sleec_verify.changes.gate.lost_evidence import lost_evidence
from sleec_verify.changes.gate.policy import judge
from sleec_verify.changes.gate.result import (
    Block,
    GateResult,
    RulesetExamination,
)
from sleec_verify.changes.gate.targets import check_target
from sleec_verify.changes.revisions.renames import with_renames
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.results.internal_error import internal_errors_of

if TYPE_CHECKING:
    from sleec_verify.changes.gate.keys import Policy, Target
    from sleec_verify.changes.revisions.versions import Version, Versions


def gate(
    versions: Sequence[Versions],
    base: str,
    policy: Policy,
    check: Check,
    locate: Locate,
    *,
    targets: Sequence[Target] = (),
    changes: Sequence[Block] = (),
    known: Collection[Key] = (),
    everything: bool = False,
    asserting: AssertionSources | None = None,
    untimed: Untimed = "at",
    touched: Set[str] = frozenset(),
    files: Set[str] = frozenset(),
) -> GateResult:
    """The verdict on rulesets in two versions. Messages call the older one `base`.

    `changes` are those of the settings, `known` the findings of the baseline, `touched` the changed parts of the
    `evidence` beside the rulesets, and `files` the paths of the base. An unchanged ruleset is left out, unless
    `everything` is examined or its cases or certificate changed. Assertions are checked for all rulesets. Raises
    `LanguageError` for invalid assertions. Linear in the unchanged rulesets; the others cost as much as `check` and
    `diff`.
    """
    versions, before = with_renames(versions)
    found = GateResult(base, changes=[*changes, *lost_evidence(versions, before, files, locate)])
    baseline = KnownFindings(known)
    examiner = Examiner(base, policy, baseline, check, locate, untimed)
    asked: list[RulesetVersions] = []
    for one in versions:
        if everything or not one.unchanged or not touched.isdisjoint(evidence(one.path, policy)):
            examined = examiner.examine(one, before.get(one.path))
            found.examined.append(examined)
            if examined.difference is not None:
                asked.append(RulesetVersions(examined.difference.new, examined.difference.old))
                found.paths[examined.difference.new.source.path] = one.path
        else:
            found.unchanged += 1
            if asserting:
                try:
                    with internal_errors_of(one.path):
                        ruleset = _read(one)
                    asked.append(RulesetVersions(ruleset, ruleset))
                    found.paths[ruleset.source.path] = one.path
                except SleecError as error:
                    found.examined.append(RulesetExamination(one.path, errors=[error]))
    found.conformed = [check_target(target, locate, baseline) for target in targets]
    if asserting:
        found.asked = verify_assertions(found, asked, asserting)
    about = {one.path for one in found.examined} | {target.code for target in targets} | {*before.values()}
    found.stale = sum(1 for one in baseline.keys - baseline.met if one[0] in about)
    judge(found, policy)
    return found


def _read(one: Versions) -> Ruleset:
    """An unchanged ruleset. Raises `SleecError`."""
    assert one.new is not None, "what is the same is there"
    return parse_source(one.new.read())


def findings_now(places: Mapping[str, Version], targets: Sequence[Target], check: Check, locate: Locate) -> set[Key]:
    """All findings of these rulesets and targets that no suppression allows, by their keys: the content of a baseline.

    Raises:
        SleecError: a file cannot be read.
    """
    known = KnownFindings()
    for name, place in places.items():
        with internal_errors_of(name):
            ruleset = parse_source(place.read())
            allowing, _ = suppressions_of(ruleset)
            check_ruleset(RulesetExamination(name), ruleset, known, check, allowing)
    for target in targets:
        found = check_target(target, locate, known)
        if found.error is not None:
            raise found.error
    return known.met
