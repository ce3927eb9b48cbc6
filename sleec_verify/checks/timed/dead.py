"""Hedges that decide at no instant of any trace that the relations allow.

A rule that only relations keep from being triggered is a vacuous conflict; one that nothing can trigger is dead in the
sense of situations."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from sleec_runtime.model import Rule
from sleec_verify.checks.base import clause_name
from sleec_verify.checks.dead import DEAD_HEDGE as HEDGE_OF_SITUATIONS
from sleec_verify.checks.each import each
from sleec_verify.checks.timed.matter import traces
from sleec_verify.cone import Cones
from sleec_verify.finding import ClauseRef, Finding
from sleec_verify.timed.questions import reachable


def _dead_hedges(cones: Cones) -> Iterator[Finding]:
    """A finding for each hedge that decides nowhere."""
    known = traces(cones)
    if not known.program.laws:
        yield from HEDGE_OF_SITUATIONS.run(cones)
        return

    def of(rule: Rule) -> Iterator[Finding]:
        if len(list(rule.clauses())) == 1:
            return
        for number, (clause, decides) in enumerate(zip(rule.clauses(), reachable(known.program, rule))):
            if number and not decides:
                yield DEAD_HEDGE.finding(
                    f"{clause_name(rule, number)} decides in no situation",
                    clause.span,
                    rules=(rule.label,),
                    clauses=(ClauseRef(rule.label, number),),
                    help="look at its condition and at the relations, or remove it",
                )

    yield from each(((rule.label, rule) for rule in known.rules), of)


DEAD_HEDGE = replace(HEDGE_OF_SITUATIONS, run=_dead_hedges)
