"""The cone of influence: the rules and constraints that can affect a question.

A rule whose trigger does not occur obliges nothing, and triggers are free unless an `ASSUME` names them. So a question
about a situation concerns the rules of its triggers and the assumptions that share names with them. It also concerns
the rules of the triggers that these rules name or these assumptions may require. Everything else can be left out
without changing the answer. So questions about ten rules stay questions about ten rules in a ruleset of 100,000.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from sleec_verify.query.assumption_slicing import slicing_of
from sleec_verify.query.names import Name, names_of_constraint, names_of_rule
from sleec_verify.query.prime_implicates import constraints_on_situations
from sleec_verify.query.ruleset_index import RulesetIndex


def rules_active_with(index: RulesetIndex, trigger: str, satisfying: bool = False) -> list[int]:
    """The positions of the rules that may have to be active when `trigger` occurs, in the order of the text.

    These are its own rules, and those of the triggers that such rules name, that assumptions connect to it or to the
    conditions of such rules, or that assumptions always require. With `satisfying`, they are also those that the
    constraints on the obligations of these rules require.
    """
    if not (index.names_triggers or (satisfying and index.constrains_triggers)):
        return index.by_trigger.get(trigger, [])

    def named(triggers: set[str]) -> Iterator[Name]:
        rules = {position for t in triggers for position in index.by_trigger.get(t, ())}
        for position in rules:
            yield from names_of_rule(index.rules[position])
        if satisfying:
            yield from _names_of_constraints(index, rules)

    triggers, _ = slicing_of(index).reached([trigger], named)
    return sorted(position for t in triggers for position in index.by_trigger.get(t, ()))


def _names_of_constraints(index: RulesetIndex, rules: Iterable[int]) -> Iterator[Name]:
    """The triggers, conditions and measures in the constraints that may conflict with the obligations of some rules."""
    obliged = {o.name for position in rules for clause in index.clauses[position] for o in clause.obligations}
    for constraint in (*index.constraints_about(obliged), *constraints_on_situations(index)):
        yield from names_of_constraint(constraint)


def rules_of_same_obligation(index: RulesetIndex, position: int) -> list[int]:
    """The other rules that may oblige the same as the rule at `position`, in situations that trigger it.

    They are in the order of the text.
    """
    known = index.once(_same_obligations)
    if position not in known:
        known[position] = _same_obligation(index, position)
    return known[position]


def _same_obligations(_: RulesetIndex) -> dict[int, list[int]]:
    return {}


def _same_obligation(index: RulesetIndex, position: int) -> list[int]:
    rule = index.rules[position]
    literals = {literal for clause in index.clauses[position] for literal in clause.obligations}
    found = {place.rule for literal in literals for place in index.by_obligation[literal]} - {position}
    if not index.names_triggers:
        return sorted(other for other in found if index.rules[other].trigger == rule.trigger)
    return sorted(found.intersection(rules_active_with(index, rule.trigger)))
