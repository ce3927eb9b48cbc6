"""Events that no rule knows: concerns, purposes and relations that speak past the rules."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import TYPE_CHECKING

from sleec_runtime.model import Span, in_text_order, literals
from sleec_verify.checks.base import Check, FindingKind
from sleec_verify.encoding.name_uses import events_of_rules
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Finding

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
            # What a relation ties to something else is not out of the rules' reach.
            if name in known or name in related or name in said:
                claimed.add(name)
                continue
            said.add(name)
            meant = nearest(name, sorted(known))
            yield STRAY_EVENT.finding(
                f"the {claim.kind} {claim.label} speaks of {name}, which no rule knows",
                span,
                obligations=(claim.label,),
                help=f"did you mean {meant}?" if meant else "check that no rule is missing, or drop it from the text",
            )
    for relation, names in relations:
        for name in sorted(names - known - claimed):
            # Named by two, it can matter to one by way of the other.
            if related[name] == 1:
                yield STRAY_EVENT.finding(
                    f"a relation speaks of {name}, and nothing else does",
                    relation.span,
                    kind=1,
                    help="check the name, and whether a rule is missing",
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
    "Does some rule know every event that concerns, purposes and relations speak of?",
    (
        FindingKind(
            "SLEEC510",
            "note",
            "a concern or purpose that speaks of an event no rule knows",
            "The event triggers no rule, answers none, and no relation ties it to one that does: nothing in the rules "
            "brings it about or prevents it. So a purpose that waits for it is reached too easily, and a concern "
            "about it cannot be ruled out.",
            "Look for another spelling of the event first, then for a rule that is missing.",
            _EVENTS + _RULES + _PURPOSE,
            _EVENTS + _BOTH + _PURPOSE,
        ),
        FindingKind(
            "SLEEC511",
            "note",
            "a relation that speaks of an event nothing else speaks of",
            "The event stands in one relation and nowhere else. Then the relation says next to nothing of what the "
            "rules are about.",
            "Look for another spelling of the event first, then for a rule that is missing. If it is neither, remove "
            "the relation.",
            _EVENTS + _RULES + _RELATION,
            _EVENTS + _BOTH + _RELATION,
        ),
    ),
    _stray,
    scope="text",
)
