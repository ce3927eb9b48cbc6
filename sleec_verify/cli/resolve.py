"""``sleec-verify resolve``."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import nullcontext
from typing import TYPE_CHECKING

import click

from sleec_verify.cli import options
from sleec_verify.cli.inputs import one_ruleset
from sleec_verify.cli.output import write
from sleec_verify.encoding.budget import limited
from sleec_verify.report.escape import as_text
from sleec_verify.report.full import finding_lines
from sleec_verify.report.palette import Palette
from sleec_verify.wording.phrases import counted

if TYPE_CHECKING:
    from sleec_verify.cli.conflicts import Conflicts
    from sleec_verify.encoding.scope import Scope


@click.command(
    "resolve",
    short_help="Resolve conflicts one by one, and record the decisions.",
    epilog="Example: sleec-verify resolve rulesets/night-watch.sleec",
)
@options.paths(several=False)
@options.scope(options.reading, options.domain, options.untimed, options.chains)
@options.timeout_of_each_run
@options.max_size
def command(path: str, scope: Scope, timeout: float | None) -> int:
    """Show each conflict of FILE with its verified repairs, apply the one that you choose, and check again.

    A comment above the changed rule records the decision: who gives way to whom, and why. The file is replaced
    atomically after each choice. Ctrl-C keeps it as it was after the last one.

    Without a terminal, the command only prints the plan: each conflict with its repairs, of which the first is the
    proposal.
    """
    if path != "-" and is_terminal():
        from sleec_verify.cli.resolution import Dialogue

        return Dialogue(path, scope, timeout).run()
    from sleec_verify.cli.conflicts import Conflicts

    with nullcontext() if timeout is None else limited(timeout):
        conflicts = Conflicts.of(one_ruleset(path, scope.reading, scope.domain), scope)
        write(_plan(conflicts, path, Palette.of(sys.stdout)))
    return conflicts.exit_code


def is_terminal() -> bool:
    """Whether a person can read and answer."""
    return sys.stdin.isatty() and sys.stdout.isatty()


@as_text
def _plan(conflicts: Conflicts, path: str, palette: Palette) -> Iterator[str]:
    from sleec_verify.repairs.numbering import numbered_repairs
    from sleec_verify.report.outcome import CheckedRuleset

    source = conflicts.ruleset.source
    # The numbers of repairs are those of a report, which has all findings.
    every = CheckedRuleset(conflicts.ruleset, conflicts.results).deduplicated
    for found in numbered_repairs(every, conflicts.search):
        if found.finding not in conflicts.findings:
            continue
        yield from finding_lines(found.finding, source, palette, found)
        if found.repairs:
            yield f"proposal: sleec-verify check --fix {found.repairs[0].identifier} {path}"
        yield ""
    if conflicts.undecided is not None:
        yield f"{source.path}: {palette('unknown', 'unknown[conflict]')} {conflicts.undecided}"
    yield f"{source.path}: {counted(len(conflicts.findings), 'conflict')}"
