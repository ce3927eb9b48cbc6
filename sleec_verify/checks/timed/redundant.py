"""Rules and hedges without which the same traces are allowed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import islice

from sleec_runtime.model import Rule
from sleec_verify.checks.base import clause_name, listed
from sleec_verify.checks.each import each
from sleec_verify.checks.redundant import REDUNDANT_HEDGE as HEDGE_OF_SITUATIONS
from sleec_verify.checks.redundant import REDUNDANT_RULE as RULE_OF_SITUATIONS
from sleec_verify.checks.redundant import what_to_do, with_others, without_hedge
from sleec_verify.checks.timed.matter import in_words, rules_in, traces
from sleec_verify.cone import Cones
from sleec_verify.finding import ClauseRef, Finding
from sleec_verify.timed.questions import breaking, exchanging


def _redundant_rules(cones: Cones) -> Iterator[Finding]:
    """A finding for each rule that no trace breaks which keeps all the others."""
    known = traces(cones)

    def of(rule: Rule) -> Iterator[Finding]:
        answer = breaking(known.program, rule)
        if answer.trace is not None:
            return
        others = in_words(known, answer.matter)
        yield REDUNDANT_RULE.finding(
            f"{rule.label} can be removed: without it the same is allowed and called for",
            rule.label_span if rule.labelled else rule.span,
            rules=(rule.label, *rules_in(known, answer.matter)),
            note=f"it is kept wherever {listed(others)} {'is' if len(others) == 1 else 'are'} kept"
            if others
            else "nothing can break it",
        )

    yield from each(((rule.label, rule) for rule in known.rules), of)


def _redundant_hedges(cones: Cones) -> Iterator[Finding]:
    """A finding for each hedge without which the same traces keep all: none breaks the rule and keeps it without the
    hedge, and none breaks that and keeps the rule."""
    known = traces(cones)

    def of(place: tuple[Rule, int]) -> Iterator[Finding]:
        rule, number = place
        less = without_hedge(rule, number)
        if exchanging(known.program, rule, less).trace is not None:
            return
        if exchanging(known.program, less, rule).trace is not None:
            return
        hedge = next(islice(rule.clauses(), number, None))
        yield REDUNDANT_HEDGE.finding(
            f"{clause_name(rule, number)} can be removed: without it the same is allowed and called for",
            hedge.span,
            rules=(rule.label,),
            clauses=(ClauseRef(rule.label, number),),
            help=what_to_do(hedge),
        )

    hedges = (
        (clause_name(rule, number), (rule, number))
        for position, rule in enumerate(known.rules)
        for number in range(1, len(known.clauses[position]))
    )
    yield from each(hedges, of)


REDUNDANT_RULE = replace(RULE_OF_SITUATIONS, run=lambda cones: with_others(_redundant_rules(cones)))
REDUNDANT_HEDGE = replace(HEDGE_OF_SITUATIONS, run=_redundant_hedges)
