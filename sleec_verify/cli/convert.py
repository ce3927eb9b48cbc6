"""``sleec-verify convert``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from sleec_verify.cli import exits, options
from sleec_verify.cli.inputs import one_ruleset
from sleec_verify.cli.output import note, write_data
from sleec_verify.exchange.conversion import TARGETS, Target, convert, of_domain

if TYPE_CHECKING:
    from sleec_runtime.model import Reading


@click.command(
    "convert",
    short_help="The rules in another language or reading.",
    epilog="Example: sleec-verify convert rulesets/medication-round.sleec --to legos",
)
@options.paths(several=False)
@click.option("--to", type=click.Choice(TARGETS), required=True, help="dsl is SLEEC-TK's dialect, legos LEGOS-SLEEC's.")
@click.option(
    "--reading",
    type=click.Choice(("cascade", "priority")),
    help="The reading of the result; hedges are rewritten where it changes. The DSL has only priority.",
)
@click.option("--domain", metavar="NAME", help="Only the rules of this domain, which then apply everywhere.")
@options.max_size
def command(path: str, to: Target, reading: Reading | None, domain: str | None) -> int:
    """Write the rules in FILE (- for standard input) in another language or for another reading.

    The result obliges the same in every situation; comments and the order stay. What the other language cannot say
    is refused, never left out.
    """
    ruleset = one_ruleset(path, None, domain)
    converted = convert(ruleset if domain is None else of_domain(ruleset, domain), to, reading)
    for message in converted.notes:
        note(message)
    write_data((converted.text,))
    return exits.HOLDS
