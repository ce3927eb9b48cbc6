"""``sleec-verify check``."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

import click

from sleec_verify.cli import exits, options
from sleec_verify.cli.inputs import rulesets
from sleec_verify.cli.output import complain, write
from sleec_verify.finding import SEVERITIES, Severity
from sleec_verify.report import FORMATS, renderer
from sleec_verify.report.outcome import Checked, Outcome, Unusable, checked, tally

if TYPE_CHECKING:
    from sleec_runtime.model import Reading, Ruleset
    from sleec_verify.checks import Progress
    from sleec_verify.finding import CheckResult
    from sleec_verify.timed.scope import Untimed


@click.command(
    "check",
    short_help="Are the rules free of conflict, and does each make sense?",
    epilog="Example: sleec-verify check rulesets/ --format concise --fail-level warning",
)
@options.paths(several=True)
@options.reading
@options.domain
@options.untimed
@click.option(
    "--realizable",
    metavar="N",
    type=click.IntRange(1, 100),
    help="Ask besides: can the robot always keep the rules, if the environment acts up to N times?",
)
@click.option(
    "--fail-level",
    type=click.Choice(SEVERITIES),
    default="error",
    show_default=True,
    help="Exit with 1 if there is a finding as grave as this.",
)
@click.option(
    "--certify", "output", metavar="DIR", type=options.PATH, help="Write a certificate of it to this folder, too."
)
@options.output_format(*FORMATS)
def command(
    paths: tuple[str, ...],
    reading: Reading | None,
    domain: str | None,
    untimed: Untimed,
    realizable: int | None,
    fail_level: Severity,
    output: str | None,
    form: str,
) -> int:
    """Check rulesets: files, folders of *.sleec files, or - for standard input.

    Every check is decided for all situations, not for examples. A finding comes with the smallest situation that shows
    it. `sleec-verify rules` tells what is looked for.
    """
    from sleec_verify.checks import run_checks
    from sleec_verify.cli.progress import Progress as Bar
    from sleec_verify.report.palette import Palette
    from sleec_verify.timed.scope import speaks_of_traces

    outcomes: list[Outcome] = []
    if output is not None:
        from sleec_verify.certificates.directory import check_free

        check_free(output, force=False)
    found = rulesets(paths, reading, domain)
    if output is not None and len(found) > 1:
        raise click.UsageError("a certificate is of one ruleset: name one file")
    with Bar() as progress:
        for ruleset in found:
            if isinstance(ruleset, Unusable):
                complain(ruleset.error)
                outcomes.append(ruleset)
            else:
                told = progress.on(ruleset.source.path)
                if output is None:
                    results = run_checks(ruleset, None, domain, told, untimed, realizable)
                else:
                    results = _certified(ruleset, domain, told, untimed, output)
                    if realizable is not None:
                        # A strategy is no refutation: the certificate does not speak of it.
                        results += run_checks(ruleset, (), domain, None, untimed, realizable)
                outcomes.append(Checked(ruleset, results, untimed if speaks_of_traces(ruleset) else None))
    write(renderer(form)(outcomes, Palette.of(sys.stdout)))
    return _exit_code(outcomes, fail_level)


def _certified(
    ruleset: Ruleset, domain: str | None, told: Progress | None, untimed: Untimed, output: str
) -> tuple[CheckResult, ...]:
    from sleec_verify.certificates.making import certify
    from sleec_verify.cli.certify import save

    made = certify(ruleset, domain, untimed, told)
    save(made, output)
    return made.results


def _exit_code(outcomes: Sequence[Outcome], fail_level: Severity) -> int:
    if any(isinstance(outcome, Unusable) for outcome in outcomes):
        return exits.UNUSABLE
    counts = tally(outcomes)
    if any(counts[severity] for severity in SEVERITIES[: SEVERITIES.index(fail_level) + 1]):
        return exits.FINDINGS
    return exits.UNKNOWN if any(outcome.undecided for outcome in checked(outcomes)) else exits.HOLDS
