"""``sleec-verify explain``."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import click

from sleec_verify.cli import exits, options
from sleec_verify.cli.entail import ask
from sleec_verify.cli.output import write

if TYPE_CHECKING:
    from sleec_verify.cli.scope import Scope


@click.command(
    "explain",
    short_help="What do the rules oblige in a situation, and why?",
    epilog="Example: sleec-verify explain rulesets/household.sleec --when CurtainOpenRequest --given UserUndressed",
)
@options.situation
def command(path: str, when: tuple[str, ...], given: tuple[str, ...], scope: Scope) -> int:
    """Why the rules in FILE oblige what they do in one situation (- for standard input).

    For each rule that is triggered: which clause decides, by which conditions, and where they stand. What follows
    only from EXCLUSIVE and NEVER is told apart: no rule says to do it, and nothing executes it.
    """
    from sleec_verify.report.explanation import render
    from sleec_verify.report.palette import Palette

    ruleset, context, answer = ask(path, when, given, scope)
    write(render(ruleset, context, answer, Palette.of(sys.stdout)))
    return exits.HOLDS if answer.consistent else exits.FINDINGS
