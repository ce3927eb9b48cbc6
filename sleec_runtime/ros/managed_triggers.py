"""The triggers that the Context Manager decides, because their rules depend on times."""

from __future__ import annotations

from sleec_runtime.evaluation.conflicts import forbidding, mentioned
from sleec_runtime.model import Ruleset, literals


def managed_triggers(ruleset: Ruleset) -> frozenset[str]:
    """The triggers of rules with time, and those of rules that share obligations with them, directly or through
    constraints. A deadline or prohibition of the former may decide about the latter. O(triggers * size of the rules).
    """
    named: dict[str, set[str]] = {}
    managed = set()
    for rule in ruleset.rules:
        for clause in rule.clauses():
            named.setdefault(rule.trigger, set()).update(literal.name for literal in literals(clause))
            if any(obligation.timing is not None for obligation in clause.obligations):
                managed.add(rule.trigger)
    groups = [*named.values(), *map(mentioned, forbidding(ruleset))]
    names = {name for trigger in managed for name in named[trigger]}
    grows = True
    while grows:
        joined = names.union(*(group for group in groups if not names.isdisjoint(group)))
        grows = joined != names
        names = joined
    return frozenset(trigger for trigger, own in named.items() if trigger in managed or not names.isdisjoint(own))
