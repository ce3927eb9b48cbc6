"""``sleec-verify diff``."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Literal

import click

from sleec_runtime.errors import SleecError
from sleec_verify.cli import exits, options
from sleec_verify.cli.output import complain, note, note_link, write
from sleec_verify.results.internal_error import InternalError, internal_errors_of

if TYPE_CHECKING:
    from sleec_runtime.model import Reading, Ruleset, Source
    from sleec_verify.changes.assertions.assertion import AssertionResult
    from sleec_verify.changes.compare import Difference
    from sleec_verify.changes.revisions.versions import Version, Versions
    from sleec_verify.encoding.trace_scope import Untimed
    from sleec_verify.report.difference_report import DifferenceReport, RulesetDifference
    from sleec_verify.wording.translation import Language

FailOn = Literal["change", "loss", "conflict", "nothing"]
_READINGS = click.Choice(("cascade", "priority"))


@click.command(
    "diff",
    short_help="Compare the meaning of two versions of the rules.",
    epilog="Example: sleec-verify diff rulesets/hospital.sleec rulesets/household.sleec",
)
@click.argument("paths", metavar="OLD NEW | PATH…", nargs=-1, type=options.PATH)
@click.option(
    "--git",
    "revision",
    metavar="REV",
    help="Compare the files at or below PATH with this revision. OLD..NEW compares two revisions, OLD...NEW compares "
    "NEW with the common ancestor of both.",
)
@click.option(
    "--assert",
    "assertions",
    metavar="TEXT",
    multiple=True,
    help='An assertion about the new rules in every situation: "never RefuseRequest when MedicalEmergency", '
    '"always CallNurse when FallDetected".',
)
@click.option(
    "--assertions",
    "file",
    metavar="FILE",
    type=options.PATH,
    help="A file with one assertion per line, and # comments.",
)
@options.domain
@options.reading
@click.option("--old-reading", type=_READINGS, help="The reading of the old rules.")
@click.option("--new-reading", type=_READINGS, help="The reading of the new rules.")
@options.untimed
@click.option(
    "--missing-as-empty",
    is_flag=True,
    help="If only one side has a file, compare it with an empty ruleset. Otherwise this is an error.",
)
@click.option(
    "--fail-on",
    type=click.Choice(("change", "loss", "conflict", "nothing")),
    default="change",
    show_default=True,
    help="Exit with 1 for any change; for lost obligations and new conflicts; for new conflicts only; or never. "
    "Failed assertions always exit with 1.",
)
@options.output_format("full", "concise", "json")
@options.language
@options.timeout
@options.max_size
def command(
    paths: tuple[str, ...],
    revision: str | None,
    assertions: tuple[str, ...],
    file: str | None,
    domain: str | None,
    reading: Reading | None,
    old_reading: Reading | None,
    new_reading: Reading | None,
    untimed: Untimed,
    missing_as_empty: bool,
    fail_on: FailOn,
    form: str,
    language: Language,
) -> int:
    """Compare the meaning of two versions of the rules, not their text: two files, two folders, or with --git the files
    below PATH (default: .) with those of a revision.

    For every obligation that is gained or lost, the output shows a smallest situation, the clauses that decide before
    and after, and the number of affected situations.
    """
    from sleec_verify.report.difference import RENDERERS
    from sleec_verify.report.difference_report import DifferenceReport
    from sleec_verify.report.palette import Palette

    asserting = bool(assertions or file)
    if file == "-" and "-" in paths and revision is None:
        raise click.UsageError("standard input cannot be both rules and assertions; use a file for one of them")
    try:
        versions, names = _versions(paths, revision)
        said = None if file is None else _source(file)
    except SleecError as error:
        complain(error)
        return exits.UNUSABLE
    # Unchanged files are read only for assertions.
    left = [one for one in versions if asserting or len(versions) == 1 or not one.unchanged]
    readings = (old_reading or reading, new_reading or reading)
    compared, rulesets = [], []
    for one in left:
        found = _compared(one, names, readings, missing_as_empty, domain, untimed)
        compared.append(found)
        if found.difference is not None:
            rulesets.append(found.difference)
    _check_domain(domain, rulesets)
    asked = _asked(assertions, said, compared, domain) if asserting else ()
    if asked is None:
        return exits.UNUSABLE
    report = DifferenceReport(tuple(compared), len(versions) - len(left), asked)
    write(RENDERERS[form](report, Palette.of(sys.stdout, language)))
    return _exit_code(report, fail_on)


def _versions(paths: Sequence[str], revision: str | None) -> tuple[list[Versions], tuple[str, str]]:
    """The rulesets on both sides, in git those that moved under their new path, and what the sides are called."""
    from sleec_verify.changes.revisions.commits import revision_range
    from sleec_verify.changes.revisions.renames import with_renames
    from sleec_verify.changes.revisions.repository import Repository
    from sleec_verify.changes.revisions.versions import of_paths

    if revision is None:
        if len(paths) != 2:
            raise click.UsageError("name the old and the new version: two files, two folders, or --git REV")
        old_path, new_path = paths
        return of_paths(old_path, new_path, note_link), (old_path, new_path)
    repository = Repository(note_link)
    old, new = revision_range(revision)
    return with_renames(repository.versions(old, new, paths or (".",)))[0], (old[0], new[0])


def _source(path: str) -> Source:
    from sleec_runtime.language.common.source import read_source

    return read_source(path)


def _compared(
    versions: Versions,
    names: tuple[str, str],
    readings: tuple[Reading | None, Reading | None],
    missing_as_empty: bool,
    domain: str | None,
    untimed: Untimed,
) -> RulesetDifference:
    from sleec_verify.changes.compare import compare
    from sleec_verify.report.difference_report import RulesetDifference

    errors: list[SleecError] = []
    one_sided = None if missing_as_empty else versions.one_sided(*names)
    if one_sided is not None:
        errors.append(one_sided)
    sides = [_read(place, reading, errors) for place, reading in zip((versions.old, versions.new), readings)]
    for error in errors:
        complain(error)
    old, new = sides
    if errors or (old is None and new is None):
        return RulesetDifference(versions.path, None, tuple(errors))
    if old is None:
        assert new is not None
        old = _empty(new, names[0], versions.path)
    if new is None:
        new = _empty(old, names[1], versions.path)
    try:
        with internal_errors_of(versions.path):
            return RulesetDifference(versions.path, compare(old, new, domain, untimed))
    except InternalError as error:
        complain(error)
        return RulesetDifference(versions.path, None, (error,))


def _read(place: Version | None, reading: Reading | None, errors: list[SleecError]) -> Ruleset | None:
    from sleec_runtime.language import parse_source

    if place is None:
        return None
    try:
        with internal_errors_of(place.name):
            ruleset = parse_source(place.read())
    except SleecError as error:
        errors.append(error)
        return None
    return ruleset if reading is None else ruleset.read_as(reading)


def _empty(other: Ruleset, side: str, path: str) -> Ruleset:
    """No rules at all, on the side that has no such file."""
    from sleec_runtime.model import Source

    return replace(other, statements=(), inferred=(), defects=(), source=Source(f"{side}: no {path}", ""))


def _check_domain(domain: str | None, found: Sequence[Difference]) -> None:
    named = sorted({name for one in found for ruleset in (one.old, one.new) for name in ruleset.domains})
    if domain is None or domain in named:
        return
    from sleec_verify.cli.inputs import unknown_domain

    if named:
        raise unknown_domain(domain, named)
    note(f"no rule has a domain, so all of them count in {domain}")


def _asked(
    texts: Sequence[str], said: Source | None, compared: list[RulesetDifference], domain: str | None
) -> tuple[AssertionResult, ...] | None:
    """The answers to all assertions, of all new rulesets; None where an assertion is wrong, which is reported. Where a
    ruleset cannot be used, an assertion that seems wrong may be about its names, and is only left out."""
    from sleec_verify.changes.assertions.parser import parse_assertion, parse_assertions
    from sleec_verify.changes.assertions.verification import verify
    from sleec_verify.changes.assertions.vocabulary import Vocabulary

    found = [one.difference for one in compared if one.difference is not None]
    known = Vocabulary([*(one.new for one in found), *(one.old for one in found)])
    assertions = []
    wrong: list[SleecError] = []
    for text in texts:
        try:
            assertions.append(parse_assertion(text, known))
        except SleecError as error:
            wrong.append(error)
    if said is not None:
        try:
            assertions += parse_assertions(said, known)
        except SleecError as error:
            wrong.append(error)
    if wrong and not any(one.errors for one in compared):
        for mistake in wrong:
            complain(mistake)
        return None
    answers: list[AssertionResult] = []
    for index, one in enumerate(compared):
        if one.difference is None:
            continue
        try:
            with internal_errors_of(one.path):
                answers += [verify(one.difference.new, assertion, domain, known) for assertion in assertions]
        except InternalError as error:
            complain(error)
            compared[index] = one._replace(difference=None, errors=(error,))
    return tuple(answers)


def _exit_code(report: DifferenceReport, fail_on: FailOn) -> int:
    if any(one.errors for one in report.compared):
        return exits.UNUSABLE
    if any(isinstance(one.answer, tuple) for one in report.asked):
        return exits.FINDINGS
    found = report.differences
    new_conflict = any("added" in one.conflict_ways for one in found)
    lost = new_conflict or any(one.less for one in found)
    changed = lost or any(one.more or one.conflict_ways for one in found)
    if {"change": changed, "loss": lost, "conflict": new_conflict, "nothing": False}[fail_on]:
        return exits.FINDINGS
    if any(one.undecided for one in found) or any(isinstance(one.answer, str) for one in report.asked):
        return exits.UNKNOWN
    return exits.HOLDS
