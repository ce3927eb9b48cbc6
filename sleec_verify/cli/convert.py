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
    short_help="Translate rules into another language or reading.",
    epilog="Example: sleec-verify convert rulesets/medication-round.sleec --to legos",
)
@options.paths(several=False)
@click.option(
    "--to", type=click.Choice(TARGETS), required=True, help="Output language: dsl for SLEEC-TK, legos for LEGOS-SLEEC."
)
@click.option(
    "--reading",
    type=click.Choice(("cascade", "priority")),
    help="The reading of the result. Exceptions are rewritten if it changes. The DSL has only priority.",
)
@click.option("--domain", metavar="NAME", help="Convert only the rules of this domain, without the domain.")
@options.max_size
def command(path: str, to: Target, reading: Reading | None, domain: str | None) -> int:
    """Translate the rules in FILE (- for standard input) into another language or another reading.

    The result requires the same in every situation. Comments and order are preserved. Rules that the other language
    cannot express are an error.
    """
    ruleset = one_ruleset(path, None, domain)
    converted = convert(ruleset if domain is None else of_domain(ruleset, domain), to, reading)
    for message in converted.notes:
        note(message)
    write_data((converted.text,))
    return exits.HOLDS
