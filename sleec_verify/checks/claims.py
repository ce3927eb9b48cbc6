"""Concerns that the rules allow, and purposes that they block."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.checks.questions import ask_each
from sleec_verify.checks.relevant_rules import in_words, rules_in
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Finding, Witness
from sleec_verify.traces.index import trace_index_of
from sleec_verify.wording.phrases import listed, quoted
from sleec_verify.wording.sentence import plural, sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Claim


def _concerns(index: RulesetIndex) -> Iterator[Finding]:
    """A finding for each concern that holds in some trace without a violation."""
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
            sentence("the concern {claim} can happen although every rule is followed", claim=quoted(claim.label)),
            claim.label_span,
            rules=tuple(dict.fromkeys(due.rule for moment in timeline.moments for due in moment.due)),
            obligations=(claim.label,),
            witness=Witness(moment.events, moment.conditions),
            timeline=timeline,
            help=sentence("add a rule that prevents it, or an exception to the rule that causes it"),
        )

    yield from ask_each(((quoted(claim.label), claim) for claim in claims(index.ruleset, "concern")), of)


def _purposes(index: RulesetIndex) -> Iterator[Finding]:
    """A finding for each purpose that holds in no trace without a violation."""
    from sleec_runtime.model import claims
    from sleec_verify.traces.questions import find_claim

    traces = trace_index_of(index)

    def of(claim: Claim) -> Iterator[Finding]:
        answer = find_claim(traces, claim)
        if answer.trace is not None:
            return
        blocking = in_words(traces, answer.matter)
        yield PURPOSE.finding(
            sentence("the purpose {claim} is impossible if every rule is followed", claim=quoted(claim.label)),
            claim.label_span,
            rules=rules_in(traces, answer.matter),
            obligations=(claim.label,),
            note=plural(len(blocking), "{rules} blocks it", "{rules} block it", rules=listed(blocking))
            if blocking
            else sentence("it contradicts itself"),
            help=sentence("add an exception for this case to the rules that block it, or remove the purpose"),
        )

    yield from ask_each(((quoted(claim.label), claim) for claim in claims(index.ruleset, "purpose")), of)


_EVENTS = "def_start\n  event UserCalls\n  event Answer\n  event Ring\n  measure asleep: boolean\ndef_end\n"

CONCERN = Check(
    "concern",
    "Do the rules prevent every concern?",
    (
        FindingKind(
            "SLEEC104",
            "error",
            "a concern that can happen although every rule is followed",
            "A concern describes something that must not happen. The robot can follow every rule and still cause it, "
            "so the rules are not sufficient. The timeline shows how.",
            "Add a rule or an exception that prevents it. If it cannot happen in reality, exclude it with RELATION or "
            "ASSUME.",
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
    "Do the rules allow every purpose?",
    (
        FindingKind(
            "SLEEC105",
            "error",
            "a purpose that the rules block",
            "A purpose describes something that must be possible. Here it never happens unless a rule is broken, so "
            "the rules demand too much. The finding names the rules that block it.",
            "Add an exception for the purpose to the named rules, or remove the purpose.",
            _EVENTS + "rule_start\n  R1 when UserCalls then not Answer\nrule_end\n"
            "purpose_start\n  p1 exists UserCalls while Answer\npurpose_end\n",
            _EVENTS + "rule_start\n  R1 when UserCalls then Answer unless {asleep} then not Answer\nrule_end\n"
            "purpose_start\n  p1 exists UserCalls while Answer\npurpose_end\n",
        ),
    ),
    _purposes,
)
