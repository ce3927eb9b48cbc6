"""One verdict on a change to the rules: checks, comparison with the base, assertions, conformance of the robot's code,
coverage by cases, each as far as the policy asks (docs/gate.md).

Only rulesets that differ from the base, byte for byte, are examined, unless all are asked for: the others passed
before.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from sleec_runtime.errors import SleecError
from sleec_runtime.language import load, parse_source
from sleec_runtime.model import Ruleset, Source
from sleec_verify.checks import CHECKS, checks_for, run_checks
from sleec_verify.compare import compare
from sleec_verify.finding import Finding
from sleec_verify.gate.baseline import Key, key
from sleec_verify.gate.config import Config
from sleec_verify.gate.policy import judge
from sleec_verify.gate.result import Conformed, Examined, Gated
from sleec_verify.gate.suppressions import suppressions
from sleec_verify.timed.scope import Untimed

if TYPE_CHECKING:
    from sleec_runtime.errors import Problem
    from sleec_verify.assertions import Asked
    from sleec_verify.gate.config import Target
    from sleec_verify.revisions import Versions

__all__ = ["Asserting", "findings_now", "gate"]


class Asserting:
    """The assertions of the configuration and the command line, as texts; files of them are read already."""

    def __init__(self, texts: Sequence[str] = (), sources: Sequence[Source] = ()) -> None:
        self.texts = texts
        self.sources = sources

    def __bool__(self) -> bool:
        return bool(self.texts or self.sources)


def gate(
    versions: Sequence[Versions],
    base: str,
    config: Config,
    known: set[Key] | None = None,
    everything: bool = False,
    asserting: Asserting | None = None,
    untimed: Untimed = "at",
) -> Gated:
    """The verdict on rulesets in two versions, the older one called `base`.

    `known` are the findings of the baseline. Raises `LanguageError` for assertions that are none. Linear in the
    rulesets that are the same; for the others, what `check` and `diff` cost.
    """
    changed = [one for one in versions if everything or asserting or not one.unchanged]
    found = Gated(base, unchanged=len(versions) - len(changed))
    met: set[Key] = set()
    for one in changed:
        examined = _examine(one, base, config, known or set(), met, untimed)
        found.examined.append(examined)
    found.conformed = [_conform(target, config, known or set(), met) for target in config.targets]
    if asserting:
        found.asked = _ask(found.examined, asserting)
    about = {one.path for one in found.examined} | {target.code for target in config.targets}
    found.stale = sum(1 for one in (known or set()) - met if one[0] in about)
    judge(found, config.block)
    return found


def findings_now(paths: Mapping[str, str], config: Config, untimed: Untimed = "at") -> set[Key]:
    """All findings of these rulesets (what each is called, and its file) and of the configured targets that no
    suppression allows: what a baseline holds.

    Raises:
        SleecError: something cannot be read.
    """
    met: set[Key] = set()
    for name, path in paths.items():
        _check(Examined(name), load(path), set(), met, untimed)
    for target in config.targets:
        found = _conform(target, config, set(), met)
        if found.error is not None:
            raise found.error
    return met


def _examine(
    versions: Versions, base: str, config: Config, known: set[Key], met: set[Key], untimed: Untimed
) -> Examined:
    found = Examined(versions.path)
    sides: list[Ruleset | None] = []
    for place in (versions.old, versions.new):
        try:
            sides.append(None if place is None else parse_source(place.read()))
        except SleecError as error:
            found.errors.append(error)
            sides.append(None)
    old, found.ruleset = sides
    if found.ruleset is not None:
        _check(found, found.ruleset, known, met, untimed)
        if config.block.clause_coverage is not None and not found.errors:
            from sleec_verify.gate.coverage import coverage

            found.coverage = coverage(found.ruleset, found.errors)
        if config.block.certificates:
            from sleec_verify.gate.certification import without_certificate

            found.uncertified = without_certificate(found.ruleset)
    if not found.errors:
        new = found.ruleset
        found.difference = compare(
            old if old is not None else _nothing(new, f"{base}: no {versions.path}"),
            new if new is not None else _nothing(old, f"no {versions.path}"),
            untimed=untimed,
        )
    return found


def _nothing(other: Ruleset | None, called: str) -> Ruleset:
    """No rules, on the side that has no such file."""
    assert other is not None, "one side has it"
    return replace(other, statements=(), inferred=(), defects=(), source=Source(called, ""))


def _check(found: Examined, ruleset: Ruleset, known: set[Key], met: set[Key], untimed: Untimed) -> None:
    found.results = run_checks(ruleset, checks_for(ruleset), untimed=untimed)
    codes = {kind.code for check in CHECKS.values() for kind in check.kinds}
    allowing, found.problems = suppressions(ruleset, {*codes, *CHECKS})
    used = set()
    for finding in (finding for result in found.results for finding in result.findings):
        covering = next((one for one in allowing if one.covers(ruleset, finding)), None)
        if covering is not None:
            used.add(covering)
            found.allowed.append((finding, covering))
        elif _is_known(found.path, finding, known, met):
            found.known.append(finding)
        else:
            found.findings.append(finding)
    found.unused = [one for one in allowing if one not in used]


def _is_known(path: str, finding: Finding, known: set[Key], met: set[Key]) -> bool:
    its = key(path, finding)
    met.add(its)
    return its in known


def _conform(target: Target, config: Config, known: set[Key], met: set[Key]) -> Conformed:
    from sleec_runtime.errors import UnsupportedTimes
    from sleec_verify.conformance.structure import UNDECIDED, check_structure
    from sleec_verify.conformance.structure.target import python_files

    found = Conformed(target)
    try:
        found.ruleset = load(config.at(target.rules))
        if target.domain is not None and target.domain not in found.ruleset.domains:
            named = ", ".join(found.ruleset.domains) or "none"
            raise SleecError(f"there is no domain {target.domain} in {target.rules}", f"it has {named}")
        found.result = check_structure(found.ruleset, python_files(config.at(target.code)), target.domain)
    except UnsupportedTimes as error:
        found.why = str(error)
        return found
    except SleecError as error:
        found.error = error
        return found
    for finding in found.result.findings:
        if finding.code == UNDECIDED:
            continue
        (found.known if _is_known(target.code, finding, known, met) else found.findings).append(finding)
    return found


def _ask(examined: Iterable[Examined], asserting: Asserting) -> tuple[Asked, ...]:
    from sleec_runtime.errors import LanguageError
    from sleec_verify.assertions import Assertion, Vocabulary, ask, read_assertion, read_assertions

    rulesets = [one.ruleset for one in examined if one.ruleset is not None]
    before = [one.difference.old for one in examined if one.difference is not None]
    vocabulary = Vocabulary([*rulesets, *before])
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
    return tuple(ask(ruleset, assertion, known=vocabulary) for ruleset in rulesets for assertion in said)
