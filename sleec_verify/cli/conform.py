"""``sleec-verify conform``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from sleec_verify.cli import exits, options
from sleec_verify.cli.inputs import one_ruleset
from sleec_verify.cli.output import complain, report
from sleec_verify.report import FORMATS
from sleec_verify.report.outcome import CheckedRuleset, UnusableInput
from sleec_verify.results.finding import Severity
from sleec_verify.results.internal_error import InternalError, internal_errors_of

if TYPE_CHECKING:
    from sleec_runtime.model import Reading


@click.command(
    "conform",
    short_help="Check a robot's code against the rules.",
    epilog="Example: sleec-verify conform examples/household_robot.py --ruleset rulesets/household.sleec",
)
@click.argument("target", metavar="TARGET", type=options.PATH)
@click.option("--ruleset", "path", metavar="FILE", required=True, type=options.PATH, help="The file with the rules.")
@options.domain
@options.reading
@options.fail_level
@options.output_format(*FORMATS)
@options.output
@options.max_size
def command(
    target: str,
    path: str,
    domain: str | None,
    reading: Reading | None,
    fail_level: Severity,
    form: str,
    output: str | None,
) -> int:
    """Check that the code in TARGET follows the rules. TARGET is a Python file, a folder, the name of a module on
    sys.path, or - for standard input. The code is read, but not imported or run.

    Each rule needs a method with a variant for each clause. The variant must call the code of the obligations of its
    clause, in order. No other code may call these directly. Code that cannot be decided without running it is reported
    as inconclusive, with exit code 3 if there are no findings.
    """
    from sleec_verify.conformance.structure import UNDECIDED, check_structure, python_files

    if target == path == "-":
        raise click.UsageError("TARGET and the rules cannot both be standard input")
    if output is not None:
        from sleec_verify.files.placement import require_writable

        require_writable(output, (path, target))
    try:
        ruleset = one_ruleset(path, reading, domain)
        with internal_errors_of(target):
            result = check_structure(ruleset, python_files(target), domain)
    except InternalError as error:
        complain(error)
        report([UnusableInput(error.path, error)], form, output)
        return exits.UNUSABLE
    report([CheckedRuleset(ruleset, (result,))], form, output)
    return exits.code([result], fail_level, ignored=UNDECIDED)
