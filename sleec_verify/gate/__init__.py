"""One verdict on a change to the rules: checks, comparison with the base, assertions, conformance of the robot's code,
coverage by cases, each as far as the policy asks (docs/gate.md).

Only rulesets that differ from the base, byte for byte, are examined, unless all are asked for: the others passed
before.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence, Set
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from sleec_runtime.errors import SleecError
from sleec_runtime.language import load, parse_source
from sleec_runtime.model import Atom, Ruleset, Source, leaves, measures_of
from sleec_verify.checks import CHECKS, run_checks
from sleec_verify.compare import compare
from sleec_verify.finding import CheckResult, Finding
from sleec_verify.gate.baseline import Key, key
from sleec_verify.gate.policy import judge
from sleec_verify.gate.result import Block, Conformed, Examined, Gated
from sleec_verify.gate.suppressions import Suppression, new_suppressions, suppressions
from sleec_verify.internal_error import InternalError, internal_errors_of
from sleec_verify.renames import with_renames
from sleec_verify.timed.scope import Untimed

if TYPE_CHECKING:
    from sleec_runtime.errors import Problem
    from sleec_verify.assertions import Asked, Assertion, Vocabulary
    from sleec_verify.gate.keys import Policy, Target
    from sleec_verify.revisions import Place, Versions

__all__ = ["Asserting", "Check", "evidence", "findings_now", "gate"]

CONFLICT = "conflict"

Check = Callable[[Ruleset], tuple[CheckResult, ...]]
"""What checks a ruleset, or knows what came of it."""

Locate = Callable[[str], str]
"""From a path of the repository to the file that it is now. Raises `SleecError` for one outside the repository."""


class Asserting:
    """The assertions of the configuration and the command line, as texts; files of them are read already."""

    def __init__(self, texts: Sequence[str] = (), sources: Sequence[Source] = ()) -> None:
        self.texts = texts
        self.sources = sources

    def __bool__(self) -> bool:
        return bool(self.texts or self.sources)


class _Sides(NamedTuple):
    """A ruleset as it is now, and as it was."""

    new: Ruleset
    old: Ruleset


class _Known:
    """The findings of a baseline, and those of them that there are still."""

    def __init__(self, keys: Collection[Key] = ()) -> None:
        self.keys = frozenset(keys)
        self.met: set[Key] = set()

    def has(self, finding: Finding, paths: Sequence[str]) -> bool:
        """Whether it is known under one of the paths that its ruleset has had."""
        its = {key(path, finding) for path in paths}
        self.met |= its
        return not its.isdisjoint(self.keys)


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
    asserting: Asserting | None = None,
    untimed: Untimed = "at",
    touched: Set[str] = frozenset(),
) -> Gated:
    """The verdict on rulesets in two versions, the older one called `base`.

    `changes` are those of the settings, `known` the findings of the baseline, `touched` what differs from the base of
    the `evidence` beside the rulesets. A ruleset that is the same is left out, unless `everything` is examined or the
    cases or the certificate beside it changed; only the assertions are asked of all. Raises `LanguageError` for
    assertions that are none. Linear in the rulesets that are the same; for the others, what `check` and `diff` cost.
    """
    versions, before = with_renames(versions)
    found = Gated(base, changes=[*changes])
    baseline = _Known(known)
    asked: list[_Sides] = []
    for one in versions:
        if everything or not one.unchanged or not touched.isdisjoint(evidence(one.path, policy)):
            examined = _examine(one, before.get(one.path), base, policy, baseline, check, locate, untimed)
            found.examined.append(examined)
            if examined.difference is not None:
                asked.append(_Sides(examined.difference.new, examined.difference.old))
                found.paths[examined.difference.new.source.path] = one.path
        else:
            found.unchanged += 1
            if asserting:
                try:
                    with internal_errors_of(one.path):
                        ruleset = _read(one)
                    asked.append(_Sides(ruleset, ruleset))
                    found.paths[ruleset.source.path] = one.path
                except SleecError as error:
                    found.examined.append(Examined(one.path, errors=[error]))
    found.conformed = [_conform(target, locate, baseline) for target in targets]
    if asserting:
        found.asked = _ask(found, asked, asserting)
    about = {one.path for one in found.examined} | {target.code for target in targets} | {*before.values()}
    found.stale = sum(1 for one in baseline.keys - baseline.met if one[0] in about)
    judge(found, policy)
    return found


def evidence(path: str, policy: Policy) -> list[str]:
    """The files and folders beside a ruleset that the policy asks for."""
    stem = path.removesuffix(".sleec")
    cases = [f"{stem}.cases.toml"] if policy.clause_coverage is not None else []
    return cases + ([f"{stem}.certificate"] if policy.certificates else [])


def _read(one: Versions) -> Ruleset:
    """A ruleset that is the same in the base. Raises `SleecError`."""
    assert one.new is not None, "what is the same is there"
    return parse_source(one.new.read())


def findings_now(places: Mapping[str, Place], targets: Sequence[Target], check: Check, locate: Locate) -> set[Key]:
    """All findings of these rulesets, by what they are called, and of the targets that no suppression allows: what a
    baseline holds.

    Raises:
        SleecError: something cannot be read.
    """
    known = _Known()
    for name, place in places.items():
        ruleset = parse_source(place.read())
        allowing, _ = _suppressions(ruleset)
        _check(Examined(name), ruleset, known, check, allowing)
    for target in targets:
        found = _conform(target, locate, known)
        if found.error is not None:
            raise found.error
    return known.met


def _examine(
    versions: Versions,
    was: str | None,
    base: str,
    policy: Policy,
    known: _Known,
    check: Check,
    locate: Locate,
    untimed: Untimed,
) -> Examined:
    found = Examined(versions.path, was)
    try:
        with internal_errors_of(versions.path):
            _fill_in(found, versions, base, policy, known, check, locate, untimed)
    except InternalError as error:
        found.errors.append(error)
    return found


def _fill_in(
    found: Examined,
    versions: Versions,
    base: str,
    policy: Policy,
    known: _Known,
    check: Check,
    locate: Locate,
    untimed: Untimed,
) -> None:
    sides: list[Ruleset | None] = []
    for place in (versions.old, versions.new):
        try:
            sides.append(None if place is None else parse_source(place.read()))
        except SleecError as error:
            found.errors.append(error)
            sides.append(None)
    old, found.ruleset = sides
    if found.ruleset is not None:
        allowing, found.problems = _suppressions(found.ruleset)
        found.new = new_suppressions([] if old is None else _suppressions(old)[0], allowing)
        _check(found, found.ruleset, known, check, allowing, refused=found.new if policy.new_suppressions else ())
        for path in evidence(found.path, policy):
            try:
                locate(path)
            except SleecError as error:
                found.errors.append(error)
        if policy.clause_coverage is not None and not found.errors:
            from sleec_verify.gate.coverage import coverage

            found.coverage = coverage(found.ruleset, found.errors)
        if policy.certificates and not found.errors:
            from sleec_verify.gate.certification import certificate

            found.certificate = certificate(found.ruleset, untimed, policy)
    if not found.errors:
        new = found.ruleset
        found.difference = compare(
            old if old is not None else _nothing(new, f"{base}: no {versions.path}"),
            new if new is not None else _nothing(old, f"no {versions.path}"),
            untimed=untimed,
        )
        if old is not None and any(f.check == CONFLICT for f in found.known):
            found.conflicting = _conflicting(old, untimed)


def _conflicting(ruleset: Ruleset, untimed: Untimed) -> frozenset[frozenset[str]]:
    """The rules of each conflict."""
    (result,) = run_checks(ruleset, [CONFLICT], untimed=untimed)
    return frozenset(frozenset(finding.rules) for finding in result.findings)


def _nothing(other: Ruleset | None, called: str) -> Ruleset:
    """No rules, on the side that has no such file."""
    assert other is not None, "one side has it"
    return replace(other, statements=(), inferred=(), defects=(), source=Source(called, ""))


def _suppressions(ruleset: Ruleset) -> tuple[list[Suppression], list[Problem]]:
    codes = {kind.code for one in CHECKS.values() for kind in one.kinds}
    return suppressions(ruleset, {*codes, *CHECKS})


def _check(
    found: Examined,
    ruleset: Ruleset,
    known: _Known,
    check: Check,
    allowing: Sequence[Suppression],
    refused: Collection[Suppression] = (),
) -> None:
    """Check a ruleset. Of what is `allowing`, the suppressions that are `refused` allow nothing."""
    found.results = check(ruleset)
    used = set()
    paths = [found.path, *([] if found.was is None else [found.was])]
    for finding in (finding for result in found.results for finding in result.findings):
        covering = [one for one in allowing if one.covers(ruleset, finding)]
        used.update(covering[:1])
        allowed_by = next((one for one in covering if one not in refused), None)
        if allowed_by is not None:
            found.allowed.append((finding, allowed_by))
        elif known.has(finding, paths):
            found.known.append(finding)
        else:
            found.findings.append(finding)
    found.unused = [one for one in allowing if one not in used]


def _conform(target: Target, locate: Locate, known: _Known) -> Conformed:
    from sleec_runtime.errors import UnsupportedTimes
    from sleec_verify.conformance.structure import UNDECIDED, check_structure
    from sleec_verify.conformance.structure.target import python_files

    found = Conformed(target)
    try:
        with internal_errors_of(target.code):
            found.ruleset = load(locate(target.at(target.rules)))
            if target.domain is not None and target.domain not in found.ruleset.domains:
                named = ", ".join(found.ruleset.domains) or "none"
                raise SleecError(f"there is no domain {target.domain} in {target.rules}", f"it has {named}")
            found.result = check_structure(found.ruleset, python_files(locate(target.at(target.code))), target.domain)
    except UnsupportedTimes as error:
        found.why = str(error)
        return found
    except SleecError as error:
        found.error = error
        return found
    for finding in found.result.findings:
        if finding.code == UNDECIDED:
            continue
        (found.known if known.has(finding, [target.code]) else found.findings).append(finding)
    return found


def _ask(found: Gated, asked: Sequence[_Sides], asserting: Asserting) -> tuple[Asked, ...]:
    """The answers. An assertion is asked of each ruleset that knows one of its names, or did in the base: others are
    about other things, and a ruleset that is gone obliges nothing."""
    from sleec_runtime.errors import LanguageError
    from sleec_verify.assertions import Vocabulary, ask, read_assertion, read_assertions

    vocabulary = Vocabulary(side for sides in asked for side in sides)
    said: list[Assertion] = []
    for text in asserting.texts:
        said.append(read_assertion(text, vocabulary, "assertion"))
    problems: list[tuple[Source, tuple[Problem, ...]]] = []
    for source in asserting.sources:
        try:
            said += read_assertions(source, vocabulary)
        except LanguageError as error:
            problems.append((source, error.problems))
    if problems:
        raise LanguageError(*problems[0])
    answers = []
    for new, old in asked:
        path = found.paths[new.source.path]
        try:
            with internal_errors_of(path):
                known = _names(Vocabulary((new, old)))
                answers += [ask(new, one, known=vocabulary) for one in said if not known.isdisjoint(_names_in(one))]
        except InternalError as error:
            examined = next((one for one in found.examined if one.path == path), None)
            if examined is None:
                found.examined.append(examined := Examined(path))
            examined.errors.append(error)
    return tuple(answers)


def _names(vocabulary: Vocabulary) -> set[str]:
    return {*vocabulary.triggers, *vocabulary.conditions, *vocabulary.obligations, *vocabulary.measures}


def _names_in(assertion: Assertion) -> set[str]:
    names = {literal.name for literal in assertion.literals}
    for leaf in leaves(assertion.when):
        names.update((leaf.name,) if isinstance(leaf, Atom) else measures_of(leaf))
    return names
