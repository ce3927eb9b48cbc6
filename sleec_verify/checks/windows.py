"""Times that are not what they look like: windows of no length, prohibitions that last for one instant."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_runtime.model import Clause, Obligation, Rule, in_text_order, literals
from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Finding

if TYPE_CHECKING:
    from sleec_runtime.model import Claim


def _without_length(index: RulesetIndex) -> Iterator[Finding]:
    from sleec_runtime.model import Lasting

    for labels, literal in _literals(index):
        window = literal.timing.window if literal.timing is not None else None
        if window is not None and window.end is not None and window.end.seconds == 0:
            only = "is forbidden" if literal.negated else "is due"
            yield ZERO_WINDOW.finding(
                f"this window has no length: {literal.name} {only} at one instant only",
                window.span,
                rules=labels,
                obligations=(literal.name,),
                help="write the time that you mean; at once is what a response without a window says, too"
                if index.ruleset.dialect != "sleec-tk"
                else "write the time that you mean; if that is at once, SLEEC-TK has no other way to say so",
            )
    for statement in index.ruleset.statements:
        if isinstance(statement, Lasting) and statement.duration is not None and statement.duration.seconds == 0:
            yield ZERO_WINDOW.finding(
                "this time has no length: the relation says nothing",
                statement.duration.span,
                help="write the time that you mean, or remove the relation",
            )


def _bare(index: RulesetIndex) -> Iterator[Finding]:
    for labels, literal in _literals(index):
        if literal.negated and (literal.timing is None or literal.timing.window is None):
            yield BARE_PROHIBITION.finding(
                f"{literal.name} is forbidden without a window: at the instant of the trigger, and not later",
                literal.span,
                rules=labels,
                obligations=(literal.name,),
                note="SLEEC-TK refuses a prohibition without a window",
                help=f"say for how long, as in: not {literal.name} within 5 minutes",
            )


def _literals(index: RulesetIndex) -> Iterator[tuple[tuple[str, ...], Obligation]]:
    """Every response, those of concerns and purposes too, with the label of the rule that it stands in."""
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
            "a window of no length",
            "A response within 0 minutes is due at the very instant of the trigger, as it is without a window. A "
            "relation for 0 minutes says nothing. The number, or the constant behind it, is likely not what was "
            "meant.",
            "Write the length that is meant, or leave the window out.",
            _DEFINED + "R1 when Called then Answer within 0 minutes\nrule_end\n",
            _DEFINED + "R1 when Called then Answer within 1 minute\nrule_end\n",
        ),
    ),
    _without_length,
    scope="text",
)

BARE_PROHIBITION = Check(
    "bare-prohibition",
    "Does every prohibition in SLEEC-TK's dialect say how long it lasts?",
    (
        FindingKind(
            "SLEEC514",
            "note",
            "a prohibition without a window, in SLEEC-TK's dialect",
            "SLEEC-TK refuses `not` without a window. Here it is read as LEGOS-SLEEC reads it: the event is forbidden "
            "at the instant of the trigger, and allowed a second later. That is seldom what is meant.",
            "Say how long: `not E within 1 hour`.",
            _DEFINED + "R1 when Called and asleep then not Answer\nrule_end\n",
            _DEFINED + "R1 when Called and asleep then not Answer within 1 hour\nrule_end\n",
        ),
    ),
    _bare,
    scope="text",
)
