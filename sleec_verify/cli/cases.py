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
    short_help="Few situations that reach every clause, for trials.",
    epilog="Example: sleec-verify cases rulesets/household.sleec --coverage mcdc",
)
@options.paths(several=False)
@click.option(
    "--coverage",
    "criterion",
    type=click.Choice(("clause", "condition", "mcdc", "pairwise")),
    default="clause",
    show_default=True,
    help="What to reach: every clause; besides, every condition true and false; every condition deciding by itself; "
    "every two conditions of a rule in all combinations.",
)
@click.option("--single", is_flag=True, help="One trigger at a time.")
@options.domain
@options.reading
@options.output_format("toml", "json")
@click.option("-o", "--output", metavar="FILE", type=options.PATH, help="Write to this file instead; it must be new.")
@click.option("--force", is_flag=True, help="With -o: replace the file.")
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
    """Choose a near-smallest set of situations for the rules in FILE that reaches every clause, or all of another
    criterion, with what is due in each (- for standard input).

    As TOML, it is what the pytest plugin collects from a file *.cases.toml. What no situation reaches is listed.
    """
    from sleec_verify.conformance.cases.selection import choose_cases
    from sleec_verify.conformance.cases.writer import json_text, toml

    if output is not None and os.path.lexists(output) and not force:
        raise click.UsageError(f"{output} exists; say --force to replace it")
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
    return f"{counted(len(found.cases), 'situation')}: {found.reached} of {every} goals reached"
