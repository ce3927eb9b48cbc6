"""Events in concerns, purposes and relations that no rule mentions."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_runtime.model import Span, in_text_order, literals
from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.encoding.name_uses import events_of_rules
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence

if TYPE_CHECKING:
    from sleec_runtime.model import Claim


def _stray(index: RulesetIndex) -> Iterator[Finding]:
    from sleec_runtime.model import RELATIONS, Claim
    from sleec_runtime.support.suggestions import nearest
    from sleec_verify.encoding.relations import events_of

    ruleset = index.ruleset
    known = events_of_rules(ruleset)
    related = Counter(name for law in ruleset.constraints for name in set(events_of(law)))
    relations = [(s, set(events_of(s))) for s in ruleset.statements if isinstance(s, RELATIONS)]
    related.update(name for _, names in relations for name in names)
    claimed: set[str] = set()
    for claim in (s for s in ruleset.statements if isinstance(s, Claim)):
        said: set[str] = set()
        for name, span in _mentioned(claim):
            # A relation may connect the event to one that a rule mentions.
            if name in known or name in related or name in said:
                claimed.add(name)
                continue
            said.add(name)
            meant, label = nearest(name, sorted(known)), quoted(claim.label)
            yield STRAY_EVENT.finding(
                (
                    sentence("the concern {claim} names {name}, which no rule mentions", claim=label, name=quoted(name))
                    if claim.kind == "concern"
                    else sentence(
                        "the purpose {claim} names {name}, which no rule mentions", claim=label, name=quoted(name)
                    )
                ),
                span,
                obligations=(claim.label,),
                help=sentence("did you mean {meant}?", meant=quoted(meant))
                if meant
                else sentence("check whether a rule is missing, or remove it"),
            )
    for relation, names in relations:
        for name in sorted(names - known - claimed):
            # If two relations name the event, it can connect them.
            if related[name] == 1:
                yield STRAY_EVENT.finding(
                    sentence("a relation names {name}, which nothing else mentions", name=quoted(name)),
                    relation.span,
                    kind=1,
                    help=sentence("check the spelling, and whether a rule is missing"),
                )


def _mentioned(claim: Claim) -> Iterator[tuple[str, Span]]:
    yield claim.event, claim.event_span
    for response in claim.responses:
        for clause in in_text_order(response):
            yield from ((literal.name, literal.span) for literal in literals(clause))
    if claim.meanwhile is not None:
        yield from _mentioned(claim.meanwhile)


_EVENTS = "def_start\nevent UserFalls\nevent CallHelp\nevent CallAmbulance\ndef_end\n"
_RULES = "rule_start\nR1 when UserFalls then CallHelp\nrule_end\n"
_BOTH = _RULES.replace("rule_end", "R2 when CallHelp then CallAmbulance within 5 minutes\nrule_end")
_PURPOSE = "purpose_start\np1 when UserFalls then CallAmbulance within 5 minutes\npurpose_end\n"
_RELATION = "relation_start\nhappenBefore CallHelp CallAmbulance\nrelation_end\n"

STRAY_EVENT = Check(
    "stray-event",
    "Do the rules mention every event that concerns, purposes and relations name?",
    (
        FindingKind(
            "SLEEC510",
            "note",
            "a concern or purpose about an event that no rule mentions",
            "The event is neither the trigger nor the response of a rule, and no relation connects it to one. So the "
            "rules neither cause nor prevent it. A purpose that needs it is always possible, and a concern about it "
            "cannot be prevented.",
            "Check the spelling of the event first, then look for a missing rule.",
            _EVENTS + _RULES + _PURPOSE,
            _EVENTS + _BOTH + _PURPOSE,
        ),
        FindingKind(
            "SLEEC511",
            "note",
            "a relation about an event that nothing else mentions",
            "The event appears in one relation and nowhere else, so the relation has almost no effect on the rules.",
            "Check the spelling of the event first, then look for a missing rule. If neither is the cause, remove the "
            "relation.",
            _EVENTS + _RULES + _RELATION,
            _EVENTS + _BOTH + _RELATION,
        ),
    ),
    _stray,
    scope="text",
)
