"""Concerns that the rules allow, and purposes that they block."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_verify.checks.base import Check, FindingKind, listed
from sleec_verify.checks.each import each
from sleec_verify.checks.relevant_rules import in_words, rules_in
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Finding, Witness
from sleec_verify.traces.index import trace_index_of

if TYPE_CHECKING:
    from sleec_runtime.model import Claim


def _concerns(index: RulesetIndex) -> Iterator[Finding]:
    """A finding for each concern that comes about in some trace that keeps all."""
    from sleec_runtime.model import claims
    from sleec_verify.replay.timeline import timeline_of
    from sleec_verify.traces.questions import find_claim

    def of(claim: Claim) -> Iterator[Finding]:
        answer = find_claim(trace_index_of(index), claim)
        if answer.trace is None:
            return
        timeline = timeline_of(trace_index_of(index), answer.trace)
        moment = next(m for m in timeline.moments if claim.event in m.events)
        yield CONCERN.finding(
            f"the concern {claim.label} can come about while every rule is kept",
            claim.label_span,
            rules=tuple(dict.fromkeys(due.rule for moment in timeline.moments for due in moment.due)),
            obligations=(claim.label,),
            witness=Witness(moment.events, moment.conditions),
            timeline=timeline,
            help="add a rule that prevents it, or a hedge to the one that leads to it",
        )

    yield from each(((claim.label, claim) for claim in claims(index.ruleset, "concern")), of)


def _purposes(index: RulesetIndex) -> Iterator[Finding]:
    """A finding for each purpose that comes about in no trace that keeps all."""
    from sleec_runtime.model import claims
    from sleec_verify.traces.questions import find_claim

    traces = trace_index_of(index)

    def of(claim: Claim) -> Iterator[Finding]:
        answer = find_claim(traces, claim)
        if answer.trace is not None:
            return
        blocking = in_words(traces, answer.matter)
        yield PURPOSE.finding(
            f"the purpose {claim.label} cannot come about",
            claim.label_span,
            rules=rules_in(traces, answer.matter),
            obligations=(claim.label,),
            note=f"{listed(blocking)} {'blocks' if len(blocking) == 1 else 'block'} it"
            if blocking
            else "it contradicts itself",
            help="give the rules that block it a hedge for this case, or drop the purpose",
        )

    yield from each(((claim.label, claim) for claim in claims(index.ruleset, "purpose")), of)


_EVENTS = "def_start\n  event UserCalls\n  event Answer\n  event Ring\n  measure asleep: boolean\ndef_end\n"

CONCERN = Check(
    "concern",
    "Do the rules rule out every concern?",
    (
        FindingKind(
            "SLEEC104",
            "error",
            "a concern that can come about while every rule is kept",
            "A concern is what must not come about. The robot can keep every rule and still bring it about: the rules "
            "are not enough. The timeline shows how.",
            "Add the rule or the hedge that prevents it. If nothing the robot does could, say with RELATION, or "
            "ASSUME, what is known of the world.",
            _EVENTS + "rule_start\n  R1 when UserCalls then Answer unless {asleep} then Ring\nrule_end\n"
            "concern_start\n  c1 when UserCalls and {asleep} then Ring\nconcern_end\n",
            _EVENTS + "rule_start\n  R1 when UserCalls then Answer unless {asleep} then not Ring\nrule_end\n"
            "concern_start\n  c1 when UserCalls and {asleep} then Ring\nconcern_end\n",
        ),
    ),
    _concerns,
)

PURPOSE = Check(
    "purpose",
    "Do the rules leave room for every purpose?",
    (
        FindingKind(
            "SLEEC105",
            "error",
            "a purpose that the rules block",
            "A purpose is what must be able to come about. Whatever happens, some rule is broken wherever it does: "
            "the rules ask too much. The rules that block it are named.",
            "Give the rules that are named a hedge for the purpose, or give up the purpose.",
            _EVENTS + "rule_start\n  R1 when UserCalls then not Answer\nrule_end\n"
            "purpose_start\n  p1 exists UserCalls while Answer\npurpose_end\n",
            _EVENTS + "rule_start\n  R1 when UserCalls then Answer unless {asleep} then not Answer\nrule_end\n"
            "purpose_start\n  p1 exists UserCalls while Answer\npurpose_end\n",
        ),
    ),
    _purposes,
)
