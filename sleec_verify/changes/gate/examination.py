"""Examination of one ruleset of a change: its checks, its difference from the base, its cases and its certificate."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from sleec_runtime.errors import Problem, SleecError
from sleec_runtime.language import parse_source
from sleec_runtime.model import Ruleset, Source
from sleec_verify.changes.compare import compare
from sleec_verify.changes.gate.baseline import KnownFindings
from sleec_verify.changes.gate.keys import Policy
from sleec_verify.changes.gate.result import RulesetExamination
from sleec_verify.changes.revisions.versions import UnreadSubmodule
from sleec_verify.checks import CHECKS
from sleec_verify.checks.misread_names import ALLOWED_BY_COMMENTS
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.files.folders import beside
from sleec_verify.results.finding import CheckResult, Finding
from sleec_verify.results.internal_error import InternalError, internal_errors_of
from sleec_verify.results.suppressions import Suppression, new_suppressions, suppressions, text_to_write

if TYPE_CHECKING:
    from sleec_verify.changes.revisions.versions import Versions

Check = Callable[[Ruleset], tuple[CheckResult, ...]]
"""A function that checks a ruleset, or reads the result from a cache."""

_MOST = 3
"""The maximal number of findings whose suppression a message shows."""

Locate = Callable[[str], str]
"""From a path of the repository to the current file. Raises `SleecError` for a path outside the repository."""


def evidence(path: str, policy: Policy) -> list[str]:
    """The files and folders beside a ruleset that the policy requires."""
    cases = [beside(path, ".cases.toml")] if policy.clause_coverage is not None else []
    return cases + ([beside(path, ".certificate")] if policy.certificates else [])


class Examiner(NamedTuple):
    """The examination of rulesets against the base, which messages call `base`, by `policy` and with the `known`
    findings. `untimed` is the meaning of a response without a window."""

    base: str
    policy: Policy
    known: KnownFindings
    check: Check
    locate: Locate
    untimed: Untimed

    def examine(self, versions: Versions, was: str | None) -> RulesetExamination:
        """A ruleset in two versions. `was` is the path of the older one, if it differs."""
        found = RulesetExamination(versions.path, was, deleted=versions.new is None)
        try:
            with internal_errors_of(versions.path):
                self._fill_in(found, versions)
        except InternalError as error:
            found.errors.append(error)
        return found

    def _fill_in(self, found: RulesetExamination, versions: Versions) -> None:
        sides: list[Ruleset | None] = []
        for place in (versions.old, versions.new):
            try:
                sides.append(None if place is None else parse_source(place.read()))
            except UnreadSubmodule as error:
                found.unread = error
                return
            except SleecError as error:
                found.errors.append(error)
                sides.append(None)
        old, found.ruleset = sides
        if found.ruleset is not None:
            allowing, found.problems = suppressions_of(found.ruleset)
            found.new = new_suppressions([] if old is None else suppressions_of(old)[0], allowing)
            check_ruleset(
                found,
                found.ruleset,
                self.known,
                self.check,
                allowing,
                refused=found.new if self.policy.new_suppressions else (),
            )
            for path in evidence(found.path, self.policy):
                try:
                    self.locate(path)
                except SleecError as error:
                    found.errors.append(error)
            if self.policy.clause_coverage is not None and not found.errors:
                from sleec_verify.changes.gate.case_coverage import coverage

                found.coverage = coverage(found.ruleset, found.errors)
            if self.policy.certificates and not found.errors:
                from sleec_verify.changes.gate.certificates import certificate

                found.certificate = certificate(found.ruleset, self.untimed, self.policy)
        if not found.errors:
            new = found.ruleset
            found.difference = compare(
                old if old is not None else _nothing(new, f"{self.base}: no {versions.path}"),
                new if new is not None else _nothing(old, f"no {versions.path}"),
                untimed=self.untimed,
            )


def _nothing(other: Ruleset | None, called: str) -> Ruleset:
    """An empty ruleset, for the side without this file."""
    assert other is not None, "one side has it"
    return replace(other, statements=(), inferred=(), defects=(), source=Source(called, ""))


def suppressions_of(ruleset: Ruleset) -> tuple[list[Suppression], list[Problem]]:
    codes = {kind.code for one in CHECKS.values() for kind in one.kinds}
    return suppressions(ruleset, {*codes, *CHECKS})


def check_ruleset(
    found: RulesetExamination,
    ruleset: Ruleset,
    known: KnownFindings,
    check: Check,
    allowing: Sequence[Suppression],
    refused: Collection[Suppression] = (),
) -> None:
    """Check a ruleset. The suppressions in `refused` have no effect, even if they are in `allowing`."""
    found.results = check(ruleset)
    used = set()
    paths = [found.path, *([] if found.was is None else [found.was])]
    for finding in (finding for result in found.results for finding in result.findings):
        covering = [one for one in allowing if one.allows(ruleset, finding)]
        used.update(covering[:1])
        allowed_by = next((one for one in covering if one not in refused), None)
        if allowed_by is not None:
            found.allowed.append((finding, allowed_by))
        elif known.has(ruleset, finding, paths):
            found.known.append(finding)
        else:
            found.findings.append(finding)
    # The check of names heeds its suppressions itself, so nobody sees those findings.
    found.unused = [one for one in allowing if one not in used and one.allowed not in ALLOWED_BY_COMMENTS]
    for one in [*found.unused]:
        about = [finding for finding in found.findings if one.covers(ruleset, finding)]
        if about:
            found.unused.remove(one)
            found.problems.append(_names_no_finding(ruleset, one, about))


def _names_no_finding(ruleset: Ruleset, one: Suppression, about: Sequence[Finding]) -> Problem:
    """A suppression at the place of findings that names none of them."""
    message = "a suppression allows one finding, and this one has "
    message += (
        f"the fingerprint of none: the rules have changed since {one.fingerprint}"
        if one.fingerprint
        else "no fingerprint"
    )
    texts = [text_to_write(ruleset, finding, one.reason) for finding in about[:_MOST]]
    return Problem(message, one.span, f"to allow what is there now, write: {' or '.join(texts)}")
