"""``sleec-verify cases``."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from sleec_verify.cli import exits, options
from sleec_verify.cli.inputs import one_ruleset
from sleec_verify.cli.output import tell, write_data
from sleec_verify.wording.phrases import counted

if TYPE_CHECKING:
    from sleec_runtime.model import Reading, Ruleset
    from sleec_verify.conformance.cases.selection import UnreachedGoal


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
    each situation. If the rules have times, choose scenarios: events and values at given times, with the window of each
    obligation.

    Exit codes: 0 every goal is decided; 2 invalid input or usage; 3 a goal is unknown.

    The pytest plugin collects the TOML output from files named *.cases.toml. The output lists what no situation can
    cover.
    """
    from sleec_runtime.model import constructs

    if output is not None and os.path.lexists(output) and not force:
        raise click.UsageError(f"{output} exists; use --force to overwrite it")
    ruleset = one_ruleset(path, reading, domain)
    where = domain if domain in ruleset.domains else None
    choose = _scenarios if any(constructs(ruleset)) else _situations
    text, reached, unreached = choose(ruleset, criterion, where, single, form, _from(output, path))
    if output is None:
        write_data((text,))
    else:
        from sleec_verify.files.placement import write_new, write_whole

        (write_whole if force else write_new)(output, text.encode())
    unknown = sum(one.is_unknown for one in unreached)
    number, goals = reached
    total = f"{goals} of {goals + len(unreached)} goals covered"
    tell(f"{number}: {total}, {unknown} unknown" if unknown else f"{number}: {total}")
    return exits.UNKNOWN if unknown else exits.HOLDS


def _from(output: str | None, path: str) -> str | None:
    """The ruleset's path as the file of cases names it: from its own folder, which is the ruleset's if none is said."""
    if path == "-":
        return None
    if output is None:
        return os.path.basename(path)
    return os.path.relpath(path, os.path.dirname(output) or ".").replace(os.sep, "/")


def _situations(
    ruleset: Ruleset, criterion: str, domain: str | None, single: bool, form: str, path: str | None
) -> tuple[str, tuple[str, int], Sequence[UnreachedGoal]]:
    """The text of a set of situations, its size in words with the number of goals that it reaches, and the other
    goals."""
    from sleec_verify.conformance.cases.selection import choose_cases
    from sleec_verify.conformance.cases.writer import json_text, toml

    found = choose_cases(ruleset, criterion, domain, single)
    text = (toml if form == "toml" else json_text)(ruleset, criterion, found, path)
    return text, (counted(len(found.cases), "situation"), found.reached), found.unreached


def _scenarios(
    ruleset: Ruleset, criterion: str, domain: str | None, single: bool, form: str, path: str | None
) -> tuple[str, tuple[str, int], Sequence[UnreachedGoal]]:
    """The same, with scenarios."""
    from sleec_verify.conformance.scenarios.selection import choose_scenarios
    from sleec_verify.conformance.scenarios.writer import json_text, toml

    found = choose_scenarios(ruleset, criterion, domain, single)
    text = (toml if form == "toml" else json_text)(ruleset, criterion, found, path)
    return text, (counted(len(found.scenarios), "scenario"), found.reached), found.unreached
