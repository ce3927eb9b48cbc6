"""``sleec-verify cases``."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import click

from sleec_verify.cli import exits, options
from sleec_verify.cli.inputs import one_ruleset
from sleec_verify.cli.output import tell, write_data
from sleec_verify.results.phrases import counted

if TYPE_CHECKING:
    from sleec_runtime.model import Reading
    from sleec_verify.conformance.cases.selection import Cases


@click.command(
    "cases",
    short_help="Choose a small set of situations for tests.",
    epilog="Example: sleec-verify cases rulesets/household.sleec --coverage mcdc",
)
@options.paths(several=False)
@click.option(
    "--coverage",
    "criterion",
    type=click.Choice(("clause", "condition", "mcdc", "pairwise")),
    default="clause",
    show_default=True,
    help="What to cover: every clause; or also every condition true and false; or also every condition deciding on its "
    "own; or also all combinations of any two conditions of a rule.",
)
@click.option("--single", is_flag=True, help="Use only one trigger in each situation.")
@options.domain
@options.reading
@options.output_format("toml", "json")
@click.option("-o", "--output", metavar="FILE", type=options.PATH, help="Write to this file. It must not exist.")
@click.option("--force", is_flag=True, help="With -o: overwrite the file.")
@options.max_size
def command(
    path: str,
    criterion: str,
    single: bool,
    domain: str | None,
    reading: Reading | None,
    form: str,
    output: str | None,
    force: bool,
) -> int:
    """Choose a small set of situations that covers the rules in FILE (- for standard input), with the obligations in
    each situation.

    The pytest plugin collects the TOML output from files named *.cases.toml. The output lists what no situation can
    cover.
    """
    from sleec_verify.conformance.cases.selection import choose_cases
    from sleec_verify.conformance.cases.writer import json_text, toml

    if output is not None and os.path.lexists(output) and not force:
        raise click.UsageError(f"{output} exists; use --force to overwrite it")
    ruleset = one_ruleset(path, reading, domain)
    found = choose_cases(ruleset, criterion, domain if domain in ruleset.domains else None, single)
    render = toml if form == "toml" else json_text
    text = render(ruleset, criterion, found, _from(output, path))
    if output is None:
        write_data((text,))
    else:
        from sleec_verify.files.placement import write_new, write_whole

        (write_whole if force else write_new)(output, text.encode())
    tell(_in_short(found))
    return exits.HOLDS


def _from(output: str | None, path: str) -> str | None:
    """The ruleset's path as the file of cases names it: from its own folder, which is the ruleset's if none is said."""
    if path == "-":
        return None
    if output is None:
        return os.path.basename(path)
    return os.path.relpath(path, os.path.dirname(output) or ".").replace(os.sep, "/")


def _in_short(found: Cases) -> str:
    every = found.reached + len(found.unreached)
    return f"{counted(len(found.cases), 'situation')}: {found.reached} of {every} goals covered"
