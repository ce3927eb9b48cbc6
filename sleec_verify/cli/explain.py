"""``sleec-verify explain``."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import click

from sleec_verify.cli import exits, options
from sleec_verify.cli.entail import ask
from sleec_verify.cli.output import write

if TYPE_CHECKING:
    from sleec_verify.encoding.scope import Scope
    from sleec_verify.wording.translation import Language


@click.command(
    "explain",
    short_help="Explain what the rules require in a situation.",
    epilog="Example: sleec-verify explain rulesets/household.sleec --when CurtainOpenRequest --given UserUndressed",
)
@options.situation
@options.language
def command(path: str, when: tuple[str, ...], given: tuple[str, ...], scope: Scope, language: Language) -> int:
    """Explain what the rules in FILE (- for standard input) require in one situation.

    For each triggered rule, the output says which response or exception applies, and because of which conditions.
    The output also lists what follows from EXCLUSIVE and NEVER. The robot executes only what rules require, and not
    these consequences.
    """
    from sleec_verify.report.explanation import render
    from sleec_verify.report.palette import Palette

    ruleset, context, answer = ask(path, when, given, scope)
    write(render(ruleset, context, answer, Palette.of(sys.stdout, language)))
    return exits.of_answer(answer.consistent)
