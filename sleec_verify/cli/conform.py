"""``sleec-verify conform``."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import click

from sleec_verify.cli import exits, options
from sleec_verify.cli.inputs import one_ruleset
from sleec_verify.cli.output import write
from sleec_verify.finding import SEVERITIES, CheckResult, Severity, Unknown
from sleec_verify.report import FORMATS, renderer
from sleec_verify.report.outcome import Checked

if TYPE_CHECKING:
    from sleec_runtime.model import Reading


@click.command(
    "conform",
    short_help="Does a robot's code have the structure that the rules ask for?",
    epilog="Example: sleec-verify conform examples/household_robot.py --ruleset rulesets/household.sleec",
)
@click.argument("target", metavar="TARGET", type=options.PATH)
@click.option("--ruleset", "path", metavar="FILE", required=True, type=options.PATH, help="The rules.")
@options.domain
@options.reading
@click.option(
    "--fail-level",
    type=click.Choice(SEVERITIES),
    default="error",
    show_default=True,
    help="Exit with 1 if there is a finding as grave as this.",
)
@options.output_format(*FORMATS)
def command(
    target: str, path: str, domain: str | None, reading: Reading | None, fail_level: Severity, form: str
) -> int:
    """Check that the code in TARGET does what the rules say, by reading it: a Python file, a folder, the name of a
    module on sys.path, or - for standard input. Nothing of it is imported or run.

    Each rule must have a method with a variant for each clause, which calls what implements the obligations of the
    clause, in order; and nothing may reach these around the dispatch. A place that cannot be decided without running
    the code is reported as such, and the exit code is 3 if nothing worse is found.
    """
    from sleec_verify.conformance.structure import check_structure
    from sleec_verify.conformance.structure.target import python_files
    from sleec_verify.report.palette import Palette

    if target == path == "-":
        raise click.UsageError("standard input can be TARGET or the rules, not both")
    ruleset = one_ruleset(path, reading, domain)
    result = check_structure(ruleset, python_files(target), domain)
    write(renderer(form)([Checked(ruleset, (result,))], Palette.of(sys.stdout)))
    return _exit_code(result, fail_level)


def _exit_code(result: CheckResult, fail_level: Severity) -> int:
    from sleec_verify.conformance.structure import UNDECIDED

    failing = SEVERITIES[: SEVERITIES.index(fail_level) + 1]
    if any(finding.severity in failing and finding.code != UNDECIDED for finding in result.findings):
        return exits.FINDINGS
    return exits.UNKNOWN if isinstance(result.verdict, Unknown) else exits.HOLDS
