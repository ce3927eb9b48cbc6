"""Windows without length, and prohibitions that last only for one instant."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_runtime.model import Clause, Obligation, Rule, in_text_order, literals
from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Claim


def _without_length(index: RulesetIndex) -> Iterator[Finding]:
    from sleec_runtime.model import Lasting

    for labels, literal in _literals(index):
        window = literal.timing.window if literal.timing is not None else None
        if window is not None and window.end is not None and window.end.seconds == 0:
            name = quoted(literal.name)
            yield ZERO_WINDOW.finding(
                sentence("this window has no length: {name} is forbidden only at the instant of the trigger", name=name)
                if literal.negated
                else sentence(
                    "this window has no length: {name} is required only at the instant of the trigger", name=name
                ),
                window.span,
                rules=labels,
                obligations=(literal.name,),
                help=sentence("write the time that you mean; if you mean immediately, remove the window")
                if index.ruleset.dialect != "sleec-tk"
                else sentence(
                    "write the time that you mean; if you mean immediately, keep it: SLEEC-TK has no other "
                    "way to say so"
                ),
            )
    for statement in index.ruleset.statements:
        if isinstance(statement, Lasting) and statement.duration is not None and statement.duration.seconds == 0:
            yield ZERO_WINDOW.finding(
                sentence("this time has no length, so the relation has no effect"),
                statement.duration.span,
                help=sentence("write the time that you mean, or remove the relation"),
            )


def _bare(index: RulesetIndex) -> Iterator[Finding]:
    for labels, literal in _literals(index):
        if literal.negated and (literal.timing is None or literal.timing.window is None):
            yield BARE_PROHIBITION.finding(
                sentence(
                    "{literal} is forbidden without a window, so only at the instant of the trigger",
                    literal=quoted(literal.name),
                ),
                literal.span,
                rules=labels,
                obligations=(literal.name,),
                note=sentence("SLEEC-TK rejects a prohibition without a window"),
                help=sentence("give a duration, for example: not {literal} within 5 minutes", literal=literal.name),
            )


def _literals(index: RulesetIndex) -> Iterator[tuple[tuple[str, ...], Obligation]]:
    """Every response, also of concerns and purposes, with the label of its rule."""
    from sleec_runtime.model import Claim

    for statement in index.ruleset.statements:
        if isinstance(statement, Rule):
            for clause in statement.clauses():
                yield from (((statement.label,), literal) for literal in literals(clause))
        elif isinstance(statement, Claim):
            for response in _responses(statement):
                yield from (((), literal) for clause in in_text_order(response) for literal in literals(clause))


def _responses(claim: Claim) -> Iterator[Clause]:
    yield from claim.responses
    if claim.meanwhile is not None:
        yield from _responses(claim.meanwhile)


_DEFINED = "def_start\nevent Called\nevent Answer\nmeasure asleep: boolean\ndef_end\nrule_start\n"

ZERO_WINDOW = Check(
    "zero-window",
    "Does every window have a length?",
    (
        FindingKind(
            "SLEEC513",
            "note",
            "a window without length",
            "A response within 0 minutes is required at the instant of the trigger. A relation for 0 minutes has no "
            "effect. The number, or the constant that gives it, is probably wrong.",
            "Write the length that you mean, or remove the window.",
            _DEFINED + "R1 when Called then Answer within 0 minutes\nrule_end\n",
            _DEFINED + "R1 when Called then Answer within 1 minute\nrule_end\n",
        ),
    ),
    _without_length,
    scope="text",
)

BARE_PROHIBITION = Check(
    "bare-prohibition",
    "Does every prohibition in SLEEC-TK's dialect have a duration?",
    (
        FindingKind(
            "SLEEC514",
            "note",
            "a prohibition without a window, in SLEEC-TK's dialect",
            "SLEEC-TK rejects `not` without a window. sleec-verify reads it as LEGOS-SLEEC does: the event is "
            "forbidden only at that instant, and allowed a second later. This is rarely what you mean.",
            "Give a duration: `not E within 1 hour`.",
            _DEFINED + "R1 when Called and asleep then not Answer\nrule_end\n",
            _DEFINED + "R1 when Called and asleep then not Answer within 1 hour\nrule_end\n",
        ),
    ),
    _bare,
    scope="text",
)
