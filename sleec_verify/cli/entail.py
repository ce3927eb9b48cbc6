"""``sleec-verify entail``."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import click

from sleec_verify.cli import exits, options
from sleec_verify.cli.inputs import note_mixed_domains, one_ruleset
from sleec_verify.cli.output import write

if TYPE_CHECKING:
    from sleec_runtime.model import Context, Ruleset
    from sleec_verify.cli.scope import Scope
    from sleec_verify.entailment.answer import Entailment


@click.command(
    "entail",
    short_help="What do the rules oblige in a situation?",
    epilog='Example: sleec-verify entail rulesets/household.sleec --when CurtainOpenRequest --given "UserUndressed"',
)
@options.situation
@options.output_format("full", "concise", "json")
def command(path: str, when: tuple[str, ...], given: tuple[str, ...], scope: Scope, form: str) -> int:
    """What the rules in FILE oblige in one situation (- for standard input).

    Where the rules contradict one another in it, nothing is due, the conflict is shown, and the exit code is 1. What is
    done may be a trigger, too: what becomes due once it is done is shown as a tree.
    """
    from sleec_verify.report import entailment
    from sleec_verify.report.palette import Palette

    ruleset, context, answer = ask(path, when, given, scope)
    write(entailment.RENDERERS[form](ruleset, context, answer, Palette.of(sys.stdout)))
    return exits.HOLDS if answer.consistent else exits.FINDINGS


def ask(path: str, when: tuple[str, ...], given: tuple[str, ...], scope: Scope) -> tuple[Ruleset, Context, Entailment]:
    """The ruleset (its rules in domain), the situation that the options describe, and what is due in it."""
    from sleec_verify.entailment.explanation import explain
    from sleec_verify.entailment.situation_text import parse_situation

    ruleset = one_ruleset(path, scope.reading, scope.domain)
    context = parse_situation(ruleset, ",".join(when), ",".join(given))
    if scope.domain is None:
        note_mixed_domains(ruleset)
    else:
        ruleset = ruleset.in_domain(scope.domain)
    return ruleset, context, explain(ruleset, context, scope.untimed)
