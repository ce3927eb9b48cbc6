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
    from sleec_verify.encoding.scope import Scope
    from sleec_verify.entailment.answer import Entailment
    from sleec_verify.wording.translation import Language


@click.command(
    "entail",
    short_help="Show what the rules require in a situation.",
    epilog='Example: sleec-verify entail rulesets/household.sleec --when CurtainOpenRequest --given "UserUndressed"',
)
@options.situation
@options.output_format("full", "concise", "json")
@options.language
def command(
    path: str, when: tuple[str, ...], given: tuple[str, ...], scope: Scope, form: str, language: Language
) -> int:
    """Show what the rules in FILE (- for standard input) require and forbid in one situation.

    If the rules contradict each other there, also at later times, the output is the conflict, and the exit code is 1.
    It is 3 if this is not known. An obligation with alternatives is shown as a whole: X, or else Y. If a response
    triggers other rules, the consequences are shown as a tree.
    """
    from sleec_verify.report import entailment
    from sleec_verify.report.palette import Palette

    ruleset, context, answer = ask(path, when, given, scope)
    write(entailment.RENDERERS[form](ruleset, context, answer, Palette.of(sys.stdout, language)))
    return exits.of_answer(answer.consistent)


def ask(path: str, when: tuple[str, ...], given: tuple[str, ...], scope: Scope) -> tuple[Ruleset, Context, Entailment]:
    """The ruleset (its rules in the domain), the situation of the options, and what is due in it."""
    from sleec_verify.entailment.explanation import explain
    from sleec_verify.entailment.situation_text import parse_situation

    ruleset = one_ruleset(path, scope.reading, scope.domain)
    context = parse_situation(ruleset, ",".join(when), ",".join(given))
    if scope.domain is None:
        note_mixed_domains(ruleset)
    else:
        ruleset = ruleset.in_domain(scope.domain)
    return ruleset, context, explain(ruleset, context, scope.untimed)
