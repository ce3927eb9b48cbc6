"""``sleec-verify gate``."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence, Set
from typing import TYPE_CHECKING

import click

from sleec_runtime.errors import SleecError
from sleec_runtime.support.files import read_file
from sleec_verify.cli import exits, options
from sleec_verify.cli.output import complain, note_link, tell, write
from sleec_verify.files.folders import SUFFIX
from sleec_verify.report import FORMATS

if TYPE_CHECKING:
    from sleec_verify.changes.gate import AssertionSources, Check, Config, GateResult, Settings, Target
    from sleec_verify.changes.revisions.repository import Repository
    from sleec_verify.encoding.trace_scope import Untimed

STEP_SUMMARY = "GITHUB_STEP_SUMMARY"


@click.command(
    "gate",
    short_help="Decide in CI whether a change may be merged.",
    epilog="Example: sleec-verify gate --base HEAD rulesets/",
)
@click.argument("paths", metavar="[PATH]…", nargs=-1, type=options.PATH)
@click.option(
    "--base", metavar="REV", help="The revision into which the change is merged. Default: from the configuration."
)
@click.option(
    "--config",
    "config_file",
    metavar="FILE",
    type=options.PATH,
    help="The configuration file. Default: the nearest one.",
)
@click.option(
    "--all", "everything", is_flag=True, help="Examine all rulesets, not only those that differ from the base."
)
@click.option(
    "--assert",
    "texts",
    metavar="TEXT",
    multiple=True,
    help="An assertion about the rules, in addition to the configuration.",
)
@options.untimed
@click.option("--baseline", metavar="FILE", type=options.PATH, help="A file of known findings, which do not block.")
@click.option(
    "--write-baseline", is_flag=True, help="Write all current findings to the baseline file, and do nothing else."
)
@click.option(
    "--summary",
    metavar="FILE",
    type=options.PATH,
    help=f"Write a Markdown summary to this file, and overwrite an earlier summary. If ${STEP_SUMMARY} is set, also "
    "write the summary there.",
)
@options.requirements("Require certificates. ")
@options.output_format(*FORMATS)
@options.output
@options.no_cache
@options.timeout
@options.max_size
def command(
    paths: tuple[str, ...],
    base: str | None,
    config_file: str | None,
    everything: bool,
    texts: tuple[str, ...],
    untimed: Untimed,
    baseline: str | None,
    write_baseline: bool,
    summary: str | None,
    require_proved: bool,
    require_tied: bool,
    form: str,
    output: str | None,
    no_cache: bool,
) -> int:
    """Decide whether a change to the rules at or below PATH may be merged.

    The gate runs:

    \b
    - check
    - diff against the common ancestor of the change and the base
    - the assertions
    - conformance of the configured code
    - clause coverage

    The policy is in [tool.sleec-verify] of pyproject.toml, or in sleec-verify.toml, in the version of the base.

    Exit codes: 0 passed; 1 blocked; 2 invalid input or configuration; 3 inconclusive.
    """
    from sleec_verify.changes.gate import config_of, evidence, gate, no_config, policy_changes, read_sides
    from sleec_verify.changes.revisions.commits import NOW, commit, merge_base
    from sleec_verify.changes.revisions.repository import Repository
    from sleec_verify.changes.revisions.single_file import Tree

    repository = Repository(note_link)
    now = Tree(repository)
    own = config_of(now, config_file)
    check = _check(untimed, no_cache)
    if write_baseline:
        from sleec_verify.cli.baseline import write_baseline as write_findings

        if own is None:
            raise no_config(config_file or "")
        return write_findings(now, own, paths, baseline, check)
    name = base if base is not None or own is None else own.base
    if name is None:
        raise click.UsageError("name the base revision: --base main, or base in the configuration")
    _check_files(output, summary)
    tip = commit(name)
    shared = merge_base((name, tip), ("HEAD", "HEAD"))
    start = None if shared == tip else Tree(repository, shared[:10], shared)
    sides = read_sides(Tree(repository, name, tip), start, now, config_file, baseline)
    config = sides.base.config
    policy = config.block.requiring(require_proved, require_tied)
    chosen = paths or [now.called(config.at(one)) for one in config.rulesets]
    also = [] if paths else _selected(sides.change.config) - _selected(config)
    versions = repository.versions((name, shared), (NOW, None), chosen, also)
    if output is not None:
        from sleec_verify.files.placement import require_writable

        require_writable(output, (one.new.name for one in versions if one.new is not None))
    beside = {path for one in versions for path in evidence(one.path, policy)}
    found = gate(
        versions,
        name,
        policy,
        check,
        repository.here,
        targets=_targets(config, sides.change.config, repository),
        changes=policy_changes(now, sides.start, sides.change),
        known=sides.base.known,
        everything=everything,
        asserting=_asserting(sides.base, texts),
        untimed=untimed,
        touched=repository.touched(shared, beside) if beside else frozenset(),
        files=repository.paths(shared),
    )
    for one in found.examined:
        for error in one.errors:
            complain(error)
    for conformed in found.conformed:
        if conformed.error is not None:
            complain(conformed.error)
    _report(found, form, output)
    _summarize(found, summary)
    return _exit_code(found)


def _check(untimed: Untimed, no_cache: bool) -> Check:
    """Checks a ruleset as `check` does, and uses the same cache."""
    from sleec_verify.cli.cached_checks import cache_of_environment, results
    from sleec_verify.encoding.scope import Scope

    cache = None if no_cache else cache_of_environment()
    return lambda ruleset: results(ruleset, Scope(untimed=untimed), cache)


def _report(found: GateResult, form: str, output: str | None) -> None:
    from sleec_verify.report.gate import render, verdict
    from sleec_verify.report.palette import PLAIN, Palette

    if output is None:
        write(render(found, form, Palette.of(sys.stdout)))
        return
    from sleec_verify.files.placement import write_whole

    write_whole(output, "".join(render(found, form, PLAIN)).encode("utf-8", "surrogateescape"))
    tell(f"{output}: {verdict(found, PLAIN)}")


def _asserting(settings: Settings, texts: Sequence[str]) -> AssertionSources:
    from sleec_verify.changes.gate import AssertionSources, is_assertion

    return AssertionSources(
        [*texts, *filter(is_assertion, settings.config.assertions)], [*settings.assertions.values()]
    )


def _selected(config: Config) -> Set[str]:
    """Where the rulesets of a configuration are."""
    return {config.at(one) for one in config.rulesets}


def _targets(base: Config, own: Config, repository: Repository) -> list[Target]:
    """Those of the base and those of the change, but none that the change removes together with its code, and none that
    the change adds with rules in other files than rulesets: errors in them would print their lines."""
    kept = (
        one
        for one in base.targets
        if one in own.targets or os.path.lexists(os.path.join(repository.folder, one.at(one.code)))
    )
    return list(dict.fromkeys([*kept, *(one for one in own.targets if one.rules.endswith(SUFFIX))]))


def _check_files(output: str | None, summary: str | None) -> None:
    """Check before any work that the output files can be written. Only an earlier summary may be overwritten."""
    from sleec_verify.files.placement import require_writable
    from sleec_verify.report.gate import MARK

    for path in (output, summary):
        if path is not None:
            require_writable(path, ())
    if summary is None or not os.path.isfile(summary):
        return
    try:
        ours = read_file(summary).startswith(MARK.encode())
    except OSError as error:
        raise SleecError(f"{summary} cannot be read: {error.strerror}") from None
    if not ours:
        raise SleecError(f"{summary} exists and is not a summary of the gate", "name another file, or remove it")


def _summarize(found: GateResult, path: str | None) -> None:
    step = os.environ.get(STEP_SUMMARY)
    if path is None and not step:
        return
    from sleec_verify.files.placement import write_whole
    from sleec_verify.report.gate import markdown

    text = markdown(found)
    if path is not None:
        write_whole(path, text.encode("utf-8", "replace"))
    if step:
        try:
            with open(step, "a", encoding="utf-8", errors="replace") as file:
                file.write(text)
        except OSError as error:
            raise SleecError(f"{step} (from ${STEP_SUMMARY}) cannot be written: {error.strerror}") from None


def _exit_code(found: GateResult) -> int:
    codes = {
        "passed": exits.HOLDS,
        "blocked": exits.FINDINGS,
        "unknown": exits.UNKNOWN,
        "unusable": exits.UNUSABLE,
    }
    return codes[found.status]
