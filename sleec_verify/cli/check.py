"""``sleec-verify check``."""

from __future__ import annotations

import sys
from collections.abc import Sequence, Set
from contextlib import nullcontext
from typing import TYPE_CHECKING

import click

from sleec_verify.cli import exits, options
from sleec_verify.cli.cached_checks import cache_of_environment
from sleec_verify.cli.cached_checks import results as kept_or_new
from sleec_verify.cli.fix_option import FixCommand, identifiers
from sleec_verify.cli.inputs import files, rulesets
from sleec_verify.cli.output import complain, report, tell, tell_written
from sleec_verify.encoding.budget import limited
from sleec_verify.report import FORMATS
from sleec_verify.report.outcome import CheckedRuleset, Outcome, UnusableInput, checked
from sleec_verify.results.finding import Severity
from sleec_verify.results.internal_error import InternalError, internal_errors_of
from sleec_verify.wording.phrases import counted

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.changes.gate import Key
    from sleec_verify.cli.cache.store import Cache
    from sleec_verify.cli.progress import Progress
    from sleec_verify.encoding.scope import Scope
    from sleec_verify.repairs.numbering import FindingRepairs
    from sleec_verify.results.finding import CheckResult
    from sleec_verify.wording.translation import Language


@click.command(
    "check",
    cls=FixCommand,
    short_help="Check the rules for contradictions and other mistakes.",
    epilog="Example: sleec-verify check rulesets/ --format concise --fail-level warning",
)
@options.paths(several=True)
@options.scope(options.reading, options.domain, options.untimed, options.chains)
@click.option(
    "--realizable",
    metavar="N",
    type=click.IntRange(1, 100),
    help="Also check whether the robot can always follow the rules, if the environment acts at most N times.",
)
@click.option("--fixes", is_flag=True, help="Also list the verified repairs of each finding, with their effects.")
@click.option(
    "--fix",
    "fix",
    metavar="[CODE:N]",
    multiple=True,
    help="Apply the repair that --fixes lists as CODE:N. Without a value, apply all repairs that need no decision: "
    "those that change no meaning, and one spelling for variants of a name. Then check again.",
)
@click.option("--diff", "only_show", is_flag=True, help="With --fix: show the changes, and write nothing.")
@options.fail_level
@click.option(
    "--baseline",
    metavar="FILE",
    type=options.PATH,
    help="A file of known findings, as `gate --write-baseline` writes it. They are notes, and do not count.",
)
@options.output_format(*FORMATS)
@options.output
@click.option(
    "--certify",
    "certificate",
    metavar="DIR",
    type=options.PATH,
    help="Also write a certificate of the results to this folder.",
)
@options.requirements("With --certify: ")
@click.option(
    "--svg",
    "pictures",
    metavar="DIR",
    type=options.PATH,
    help="Also write pictures to this folder: the graph of all rules, the flow of each rule, and the timelines of "
    "findings.",
)
@options.language
@options.no_cache
@click.option("--watch", "watched", is_flag=True, help="Check again after each change of a file, until Ctrl-C.")
@options.timeout_of_each_run
@options.max_size
def command(
    paths: tuple[str, ...],
    scope: Scope,
    realizable: int | None,
    fixes: bool,
    fix: tuple[str, ...],
    only_show: bool,
    fail_level: Severity,
    baseline: str | None,
    form: str,
    output: str | None,
    certificate: str | None,
    require_proved: bool,
    require_tied: bool,
    pictures: str | None,
    language: Language,
    no_cache: bool,
    watched: bool,
    timeout: float | None,
) -> int:
    """Check rulesets. PATH is a file, a folder of *.sleec files, or - for standard input.

    Every check covers all situations. Findings show a smallest situation. `sleec-verify rules` lists all findings.

    Results are cached: rules that did not change are not checked again. The cache is in the user's cache folder, or in
    the folder that the environment variable SLEEC_VERIFY_CACHE names. SLEEC_VERIFY_CACHE=off disables it.
    """
    if output is not None:
        from sleec_verify.files.placement import require_writable

        require_writable(output, (path for path in files(paths) if not isinstance(path, UnusableInput)))
    cache = None if no_cache else cache_of_environment()
    if only_show and not fix:
        raise click.UsageError("--diff needs --fix")
    if fix:
        for given, option in (
            (watched, "--watch"),
            (certificate, "--certify"),
            (only_show and output, "--diff -o"),
            (only_show and form != "full", "--diff --format"),
        ):
            if given:
                raise click.UsageError(f"--fix cannot be combined with {option}")

    if certificate is None and (require_proved or require_tied):
        raise click.UsageError("--require-proved and --require-tied need --certify DIR")
    if certificate is not None:
        from sleec_verify.certificates.directory import check_free

        if watched:
            raise click.UsageError("--certify cannot be combined with --watch")
        check_free(certificate, force=False)

    if fix:
        from sleec_verify.cli.fixing import apply

        chosen = identifiers(fix)
        with nullcontext() if timeout is None else limited(timeout):
            code = apply(paths, chosen, scope, cache, only_show)
        if code is not None:
            return code

    known = _known(baseline)

    def once() -> int:
        found = rulesets(paths, scope.reading, scope.domain)
        if certificate is not None and len(found) > 1:
            raise click.UsageError("--certify needs exactly one file")
        with nullcontext() if timeout is None else limited(timeout):
            required = (require_proved, require_tied)
            outcomes = _outcomes(found, scope, realizable, fixes, cache, certificate, required, known)
        report(outcomes, form, output, language)
        if pictures is not None:
            from sleec_verify.cli.pictures import write_pictures

            number = write_pictures(list(checked(outcomes)), pictures, language)
            tell_written(pictures, counted(number, "picture"), language)
        if form == "full" and output is None and sys.stdout.isatty():
            _hint(list(checked(outcomes)))
        if any(isinstance(outcome, UnusableInput) for outcome in outcomes):
            return exits.UNUSABLE
        return exits.code((result for outcome in checked(outcomes) for result in outcome.results), fail_level)

    if not watched:
        return once()
    from sleec_verify.cli.watch import watch

    return watch(paths, once)


def _known(baseline: str | None) -> Set[Key]:
    """The findings of a baseline. Raises `SleecError`."""
    if baseline is None:
        return frozenset()
    from sleec_verify.cli.baseline import known_findings

    return known_findings(baseline)


def _hint(outcomes: Sequence[CheckedRuleset]) -> None:
    """Tell a person at a terminal what to do about the findings."""
    found = [repair for outcome in outcomes for one in outcome.repairs or () for repair in one.repairs]
    if found:
        tell(f"to apply a repair, add --fix and its identifier, for example --fix {found[0].identifier}")
    elif any(outcome.findings and outcome.repairs is None for outcome in outcomes):
        tell("to list repairs, add --fixes; to resolve the conflicts one by one, run sleec-verify resolve")


def _outcomes(
    found: Sequence[Ruleset | UnusableInput],
    scope: Scope,
    realizable: int | None,
    fixes: bool,
    cache: Cache | None,
    certificate: str | None,
    required: tuple[bool, bool],
    known: Set[Key],
) -> list[Outcome]:
    from sleec_verify.cli.progress import Progress
    from sleec_verify.encoding.trace_scope import speaks_of_traces

    outcomes: list[Outcome] = []
    with Progress() as progress:
        for ruleset in found:
            if isinstance(ruleset, UnusableInput):
                complain(ruleset.error)
                outcomes.append(ruleset)
            else:
                path = ruleset.source.path
                try:
                    with internal_errors_of(path):
                        if certificate is None:
                            results = kept_or_new(ruleset, scope, cache, progress.on(path))
                        else:
                            results = _certified(ruleset, scope, certificate, required, progress)
                        repairs = _repairs(ruleset, results, scope, progress) if fixes else None
                        if realizable is not None:
                            # A strategy is no refutation, of which certificates speak.
                            results += _realizability(ruleset, scope, realizable, progress)
                        if known or "sleec" in ruleset.source.text:
                            from sleec_verify.changes.gate.allowed import with_allowed

                            results = with_allowed(ruleset, results, known)
                        untimed = scope.untimed if speaks_of_traces(ruleset) else None
                        outcomes.append(CheckedRuleset(ruleset, results, untimed, repairs=repairs))
                except InternalError as error:
                    complain(error)
                    outcomes.append(UnusableInput(path, error))
    return outcomes


def _certified(
    ruleset: Ruleset, scope: Scope, certificate: str, required: tuple[bool, bool], progress: Progress
) -> tuple[CheckResult, ...]:
    from sleec_runtime.certificate.manifest import Required
    from sleec_verify.certificates.certification import certify
    from sleec_verify.cli.certify import save

    progressing = progress.on(ruleset.source.path)
    made = certify(ruleset, scope.domain, scope.untimed, progressing, Required(*required), scope.chains)
    save(made, ruleset, certificate)
    return made.results


def _repairs(
    ruleset: Ruleset, results: Sequence[CheckResult], scope: Scope, progress: Progress
) -> tuple[FindingRepairs, ...]:
    from sleec_verify.repairs.numbering import numbered_repairs
    from sleec_verify.repairs.search import RepairSearch

    search = RepairSearch(ruleset, results, scope)
    findings = CheckedRuleset(ruleset, tuple(results)).deduplicated
    return tuple(numbered_repairs(findings, search, progress.on(ruleset.source.path)))


def _realizability(ruleset: Ruleset, scope: Scope, acts: int, progress: Progress) -> tuple[CheckResult, ...]:
    from sleec_verify.checks import run_checks

    return run_checks(ruleset, (), scope.domain, progress.on(ruleset.source.path), scope.untimed, acts)
