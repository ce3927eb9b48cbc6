"""Rules that no trace triggers, because triggering them leads to a conflict in any case."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from sleec_runtime.model import Rule
from sleec_verify.checks.base import listed
from sleec_verify.checks.each import each
from sleec_verify.checks.timed.matter import in_words, rules_in, traces
from sleec_verify.checks.vacuous import VACUOUS_CONFLICT as OF_SITUATIONS
from sleec_verify.cone import Cones
from sleec_verify.finding import Finding
from sleec_verify.question import Question
from sleec_verify.solver import Undecided
from sleec_verify.timed.program import Program
from sleec_verify.timed.questions import triggering
from sleec_verify.timed.traces import Traces


def _vacuous(cones: Cones) -> Iterator[Finding]:
    """A finding for each rule that no trace that keeps all triggers, though its condition can hold."""
    known = traces(cones)

    def of(rule: Rule) -> Iterator[Finding]:
        answer = triggering(known.program, rule)
        if answer.trace is not None or not _by_itself(known, rule):
            return
        others = in_words(known, (name for name in answer.matter if name != rule.label))
        yield VACUOUS_CONFLICT.finding(
            f"{rule.label} can be triggered, but never without a conflict",
            rule.label_span if rule.labelled else rule.span,
            rules=(rule.label, *rules_in(known, answer.matter, but=rule.label)),
            note=f"it always meets {listed(others)}" if others else _alone(known, rule),
            help="no course of events is left in which it is triggered and all is kept; mend it, or what it meets",
        )

    yield from each(((rule.label, rule) for rule in known.rules), of)


def _alone(cones: Traces, rule: Rule) -> str:
    """Why a rule that meets no other cannot be kept."""
    program = Program(
        replace(cones.ruleset, statements=(rule,), inferred=tuple(cones.ruleset.measures.values())), cones.untimed
    )
    try:
        contradicts = triggering(program, rule).trace is None and not program.impossible()
    except Undecided:
        contradicts = False
    return "it contradicts itself" if contradicts else "what it calls for never comes to an end"


def _by_itself(cones: Cones, rule: Rule) -> bool:
    """Whether some situation triggers the rule, whatever relations say of it; else it is a dead rule."""
    with Question(cones) as question:
        return question.ask(question.encoder.any_of(question.guards_of(rule)))


VACUOUS_CONFLICT = replace(OF_SITUATIONS, run=_vacuous)
