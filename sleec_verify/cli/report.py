"""``sleec-verify report``."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, NamedTuple

import click

from sleec_runtime.errors import SleecError, UnreadableFile
from sleec_runtime.language.common.gc_pause import gc_paused
from sleec_verify.cli import exits, options
from sleec_verify.cli.cached_checks import cache_of_environment
from sleec_verify.cli.cached_checks import results as kept_or_new
from sleec_verify.cli.inputs import files, rulesets
from sleec_verify.cli.output import complain, note_link, tell_written, write_data
from sleec_verify.report.outcome import CheckedRuleset, UnusableInput, in_short
from sleec_verify.results.finding import Severity
from sleec_verify.results.internal_error import InternalError, internal_errors_of

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.cli.cache.store import Cache
    from sleec_verify.cli.progress import Progress
    from sleec_verify.encoding.scope import Scope
    from sleec_verify.report.document.content import Base, Content
    from sleec_verify.wording.translation import Language


@click.command(
    "report",
    short_help="Write a report for people about the rules.",
    epilog="Example: sleec-verify report rulesets/household.sleec -o report.html",
)
@options.paths(several=True)
@options.scope(options.reading, options.domain, options.untimed, options.chains)
@click.option(
    "--base", metavar="REV|FILE", help="Also show what changed since this revision of git, or since this file."
)
@click.option(
    "--certificate",
    metavar="DIR",
    type=options.PATH,
    help="Also verify the certificate in this folder, and show what it proves.",
)
@click.option("--no-repairs", "repairs", flag_value=False, type=bool, default=True, help="Do not search for repairs.")
@options.fail_level
@options.output_format("html", "markdown")
@options.language
@options.output
@options.no_cache
@options.timeout
@options.max_size
def command(
    paths: tuple[str, ...],
    scope: Scope,
    base: str | None,
    certificate: str | None,
    repairs: bool,
    fail_level: Severity,
    form: str,
    language: Language,
    output: str | None,
    no_cache: bool,
) -> int:
    """Write a report about rulesets for people who do not know the language of rules. PATH is a file, a folder of
    *.sleec files, or - for standard input.

    The report has the verdicts, the rules as cards with their findings and verified repairs, decision tables, and the
    situations in which the readings differ. The HTML page needs no network and no scripts.
    """
    if output is not None:
        from sleec_verify.files.placement import require_writable

        inputs = [path for path in files(paths) if not isinstance(path, UnusableInput)]
        require_writable(output, (*inputs, *([] if base is None else [base]), *_files_below(certificate)))
    cache = None if no_cache else cache_of_environment()
    found = rulesets(paths, scope.reading, scope.domain)
    if certificate is not None and len(found) > 1:
        raise click.UsageError("--certificate needs exactly one file")
    contents = _contents(found, _Parts(scope, repairs, base, certificate, cache))
    outcomes = [one if isinstance(one, UnusableInput) else one.outcome for one in contents]
    with gc_paused():  # pages are trees without cycles
        parts = _rendered(contents, form, language)
    if output is None:
        write_data(parts)
    else:
        from sleec_verify.files.placement import write_whole

        write_whole(output, "".join(parts).encode("utf-8", "surrogateescape"))
        tell_written(output, in_short(outcomes), language)
    if any(isinstance(one, UnusableInput) or _has_unusable_base(one) for one in contents):
        return exits.UNUSABLE
    return exits.code(
        (result for one in contents if not isinstance(one, UnusableInput) for result in one.outcome.results), fail_level
    )


def _files_below(folder: str | None) -> Iterator[str]:
    for home, _, names in os.walk(folder) if folder is not None else ():
        yield from (os.path.join(home, name) for name in names)


def _has_unusable_base(content: Content) -> bool:
    return content.base is not None and content.base.compared.difference is None


def _rendered(contents: list[Content | UnusableInput], form: str, language: Language) -> list[str]:
    if form == "html":
        from sleec_verify.report.html.page import render

        return list(render(contents, language))
    from sleec_verify.report.document import markdown

    return list(markdown.render(contents, language))


class _Parts(NamedTuple):
    """What the options ask for."""

    scope: Scope
    repairs: bool
    base: str | None
    certificate: str | None
    cache: Cache | None


def _contents(found: list[Ruleset | UnusableInput], parts: _Parts) -> list[Content | UnusableInput]:
    from sleec_verify.cli.progress import Progress

    contents: list[Content | UnusableInput] = []
    with Progress() as progress:
        for ruleset in found:
            if isinstance(ruleset, UnusableInput):
                complain(ruleset.error)
                contents.append(ruleset)
                continue
            path = ruleset.source.path
            try:
                with internal_errors_of(path):
                    contents.append(_content(ruleset, parts, progress))
            except InternalError as error:
                complain(error)
                contents.append(UnusableInput(path, error))
    return contents


def _content(ruleset: Ruleset, parts: _Parts, progress: Progress) -> Content:
    from sleec_verify.encoding.trace_scope import speaks_of_traces
    from sleec_verify.report.document.content import content

    progressing, scope = progress.on(ruleset.source.path), parts.scope
    results = kept_or_new(ruleset, scope, parts.cache, progressing)
    outcome = CheckedRuleset(ruleset, results, scope.untimed if speaks_of_traces(ruleset) else None)
    if parts.repairs:
        from sleec_verify.report.document.repairs import repairs_to_show

        outcome = outcome._replace(repairs=repairs_to_show(outcome, scope, progressing))
    base = None if parts.base is None else _base(ruleset, parts.base, scope)
    proofs = () if parts.certificate is None else _certificate(ruleset, parts.certificate, scope, progressing)
    return content(outcome, scope, base, proofs)


def _base(ruleset: Ruleset, name: str, scope: Scope) -> Base:
    """The comparison with a file or a revision. Raises `UnreadableFile` if it does not exist."""
    from sleec_runtime.language import parse_source
    from sleec_verify.changes.compare import compare
    from sleec_verify.changes.revisions.commits import NOW, commit
    from sleec_verify.changes.revisions.repository import Repository
    from sleec_verify.changes.revisions.versions import Version
    from sleec_verify.report.difference_report import RulesetDifference
    from sleec_verify.report.document.content import Base

    path = ruleset.source.path
    old: Version | None
    if os.path.isfile(name):
        old = Version(name)
    else:
        try:
            (versions,) = Repository(note_link).versions((name, commit(name)), (NOW, None), (path,))
        except SleecError as error:
            raise UnreadableFile(
                f"--base {name} is neither a file nor a version in git: {error.message}",
                "name a file, a branch or a commit",
            ) from None
        old = versions.old
    try:
        if old is None:
            raise UnreadableFile(f"{path} is not in {name}")
        before = parse_source(old.read())
    except SleecError as error:
        complain(error)
        return Base(name, RulesetDifference(path, None, (error,)))
    before = before if scope.reading is None else before.read_as(scope.reading)
    return Base(name, RulesetDifference(path, compare(before, ruleset, scope.domain, scope.untimed)))


def _certificate(
    ruleset: Ruleset, folder: str, scope: Scope, progress: Callable[[str, int, int], None] | None
) -> tuple[str, ...]:
    """What a certificate proves. Raises CertificateRefused."""
    from sleec_runtime.certificate.coverage import Use
    from sleec_verify.certificates.checker import checker
    from sleec_verify.certificates.theory.oracle import built
    from sleec_verify.certificates.verification import check_certificate
    from sleec_verify.report.certificate import render

    judge = checker()
    use = Use(ruleset.reading, scope.domain, scope.untimed, scope.chains)
    found = check_certificate(ruleset, folder, judge, use, oracle=built(), progress=progress)
    lines = render("full", ruleset, folder, found.manifest.whole, found.shown, judge, found.tied, found.replayed)
    return tuple(line.rstrip("\n") for line in lines)
