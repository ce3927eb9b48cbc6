"""``sleec-verify compile``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from sleec_verify.cli import exits, options
from sleec_verify.cli.inputs import note_mixed_domains, one_ruleset
from sleec_verify.cli.output import write_data
from sleec_verify.exchange.compilation import FORMS, compile_to

if TYPE_CHECKING:
    from sleec_runtime.model import Reading
    from sleec_verify.encoding.trace_scope import Untimed


@click.command(
    "compile",
    short_help="Translate the rules into formulas or clauses.",
    epilog="Example: sleec-verify compile rulesets/household.sleec --to dimacs > household.cnf",
)
@options.paths(several=False)
@click.option("--to", "form", type=click.Choice(FORMS), required=True, help="Output format.")
@options.domain
@options.reading
@options.untimed
@options.max_size
def command(path: str, form: str, domain: str | None, reading: Reading | None, untimed: Untimed) -> int:
    """Translate the rules in FILE (- for standard input) into logic.

    sympy and latex are for people: the guards and implications of Equation 1 of the paper. cnf, dimacs, smtlib and json
    are for solvers: clauses, with a map from variables to names. The number of clauses grows linearly with the rules.

    In these formats, a response with a window is one proposition, such as Call[0,300]: Call occurs within 300 seconds.
    mtl and mtl-latex are metric temporal logic. They state the full meaning of rules with time. fretish is for NASA's
    requirements tool FRET. Comments name the rules that it cannot express.
    """
    ruleset = one_ruleset(path, reading, domain)
    if domain is None:
        note_mixed_domains(ruleset)
    text = compile_to(ruleset, form, domain, untimed)
    write_data((text if text.endswith("\n") else text + "\n",))
    return exits.HOLDS
