"""``sleec-verify gate``."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from sleec_runtime.errors import SleecError
from sleec_verify.cli import exits, options
from sleec_verify.cli.output import complain, write

if TYPE_CHECKING:
    from sleec_verify.gate import Asserting
    from sleec_verify.gate.config import Config
    from sleec_verify.gate.result import Gated
    from sleec_verify.timed.scope import Untimed

STEP_SUMMARY = "GITHUB_STEP_SUMMARY"


@click.command(
    "gate",
    short_help="May this change to the rules go in?",
    epilog="Example: sleec-verify gate --base HEAD rulesets/",
)
@click.argument("paths", metavar="[PATH]…", nargs=-1, type=options.PATH)
@click.option(
    "--base", metavar="REV", help="The revision that the change is to go into; else that of the configuration."
)
@click.option(
    "--config", "config_file", metavar="FILE", type=options.PATH, help="The configuration; else the nearest one."
)
@click.option(
    "--all", "everything", is_flag=True, help="Examine every ruleset, not only those that differ from the base."
)
@click.option(
    "--assert",
    "texts",
    metavar="TEXT",
    multiple=True,
    help="What must hold of the rules, besides what the configuration says.",
)
@options.untimed
@click.option("--baseline", metavar="FILE", type=options.PATH, help="Findings that are known and do not block.")
@click.option(
    "--write-baseline", is_flag=True, help="Write all findings of now to the baseline file, and do nothing else."
)
@click.option(
    "--summary",
    metavar="FILE",
    type=options.PATH,
    help=f"Write a summary in Markdown; an earlier one is replaced. Where ${STEP_SUMMARY} is set, it goes there too.",
)
@options.output_format("full", "json")
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
    form: str,
) -> int:
    """One verdict on a change to the rules at or below PATH, for CI: check, diff with what the change and the base have
    in common, assertions, conformance of the configured code, and clause coverage.

    What blocks is set in [tool.sleec-verify] of pyproject.toml, or in sleec-verify.toml.

    Exit codes: 0 passed; 1 something blocks; 2 something cannot be read or set so; 3 something is not decided.
    """
    from sleec_verify.gate import gate
    from sleec_verify.gate.baseline import read_baseline
    from sleec_verify.gate.config import find_config, read_config
    from sleec_verify.report.gate import RENDERERS
    from sleec_verify.report.palette import Palette
    from sleec_verify.revisions import Repository

    config = find_config() if config_file is None else read_config(config_file)
    known_file = baseline or (None if config.baseline is None else config.at(config.baseline))
    chosen = paths or tuple(map(config.at, config.rulesets))
    if write_baseline:
        return _write_baseline(chosen, config, known_file, untimed)
    if base is None and config.base is None:
        raise click.UsageError("say which revision the change is to go into: --base main, or base in the configuration")
    _check_summary(summary)
    repository = Repository()
    name = base or str(config.base)
    shared = repository.merge_base(name, "HEAD")
    versions = repository.versions((name, shared), ("the files as they are now", None), chosen)
    known = None if known_file is None else read_baseline(known_file)
    found = gate(versions, name, config, known, everything, _asserting(config, texts), untimed)
    for one in found.examined:
        for error in one.errors:
            complain(error)
    for conformed in found.conformed:
        if conformed.error is not None:
            complain(conformed.error)
    write(RENDERERS[form](found, Palette.of(sys.stdout)))
    _summarize(found, summary)
    return _exit_code(found)


def _asserting(config: Config, texts: Sequence[str]) -> Asserting:
    """Those of the configuration name files where such a file is there, else they are the assertions themselves."""
    from sleec_runtime.language.source import read_source
    from sleec_verify.gate import Asserting

    said = [*texts]
    sources = []
    for one in config.assertions:
        if one.split(" ")[0].lower() in ("never", "always"):
            said.append(one)
        else:
            sources.append(read_source(config.at(one)))
    return Asserting(said, sources)


def _write_baseline(paths: Sequence[str], config: Config, target: str | None, untimed: Untimed) -> int:
    from sleec_verify.cli.files import write_whole
    from sleec_verify.cli.inputs import files
    from sleec_verify.gate import findings_now
    from sleec_verify.gate.baseline import baseline_text
    from sleec_verify.report.outcome import Unusable, counted
    from sleec_verify.revisions import Repository

    if target is None:
        raise click.UsageError("say where: --baseline FILE, or baseline in the configuration")
    found = list(files(paths))
    unusable = [one for one in found if isinstance(one, Unusable)]
    for one in unusable:
        complain(one.error)
    if unusable:
        return exits.UNUSABLE
    repository = Repository()
    names = {repository.inside(one): one for one in found if isinstance(one, str)}
    keys = findings_now(names, config, untimed)
    if os.path.lexists(target):
        # Only a baseline is replaced by one.
        from sleec_verify.gate.baseline import read_baseline

        read_baseline(target)
    write_whole(target, baseline_text(keys).encode())
    print(f"{target}: {counted(len(keys), 'finding')}", file=sys.stderr)
    return exits.HOLDS


def _check_summary(path: str | None) -> None:
    """Before anything is done: a file that is no summary is not replaced by one."""
    from sleec_verify.report.gate import MARK

    if path is None or not os.path.lexists(path):
        return
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            ours = file.read(len(MARK)) == MARK
    except OSError as error:
        raise SleecError(f"{path} cannot be read: {error.strerror}") from None
    if not ours:
        raise SleecError(f"{path} is there already, and is no summary of a gate", "name another file, or remove it")


def _summarize(found: Gated, path: str | None) -> None:
    step = os.environ.get(STEP_SUMMARY)
    if path is None and not step:
        return
    from sleec_verify.cli.files import write_whole
    from sleec_verify.report.gate import markdown

    text = markdown(found)
    if path is not None:
        write_whole(path, text.encode())
    if step:
        try:
            with open(step, "a", encoding="utf-8") as file:
                file.write(text)
        except OSError as error:
            raise SleecError(f"{step}, which ${STEP_SUMMARY} names, cannot be written: {error.strerror}") from None


def _exit_code(found: Gated) -> int:
    codes = {
        "passed": exits.HOLDS,
        "blocked": exits.FINDINGS,
        "unknown": exits.UNKNOWN,
        "unusable": exits.UNUSABLE,
    }
    return codes[found.status]
