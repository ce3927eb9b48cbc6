"""Which clauses some situation makes active."""

from __future__ import annotations

from sleec_runtime.model import Ruleset
from sleec_verify.cone import Cones
from sleec_verify.finding import ClauseRef
from sleec_verify.question import Question


def reachable_clauses(ruleset: Ruleset) -> frozenset[ClauseRef]:
    """The clauses that are active in some situation of some domain in which their rule applies. One question a clause.

    Raises `Undecided` where the solver did not decide.
    """
    found: set[ClauseRef] = set()
    for domain in ruleset.domains or (None,):
        cones = Cones(ruleset if domain is None else ruleset.in_domain(domain))
        for position, rule in enumerate(cones.rules):
            refs = [ClauseRef(rule.label, number) for number in range(len(cones.clauses[position]))]
            if found.issuperset(refs):
                continue
            with Question(cones) as question:
                found.update(ref for ref, guard in zip(refs, question.guards(position)) if question.ask(guard))
    return frozenset(found)
