"""The statements that apply in one domain, by the names that they depend on."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from itertools import combinations
from typing import NamedTuple, Union

from sleec_runtime.audit.moment import Moment
from sleec_runtime.evaluation.formula_truth import Situation
from sleec_runtime.evaluation.instant_formulas import instant_formula
from sleec_runtime.model import (
    And,
    Assume,
    Atom,
    Context,
    Effect,
    EventRelation,
    Exclusive,
    Formula,
    Lasting,
    MeasureRelation,
    Never,
    Not,
    Rule,
    Ruleset,
    leaves,
    names_of,
)

InstantStatement = Union[Exclusive, Never, Assume, EventRelation, MeasureRelation, Effect]


class Watched(NamedTuple):
    """A constraint or relation as a `formula` that holds at every instant. `events` are the events in it, and `number`
    is its place in the text. If it `is_of_domains`, it applies in some domains only."""

    number: int
    statement: InstantStatement
    formula: Formula
    events: frozenset[str]
    is_of_domains: bool


class DomainRules:
    """The statements of `ruleset`, which are those of one domain."""

    def __init__(self, ruleset: Ruleset) -> None:
        self.ruleset = ruleset
        self.by_trigger: dict[str, list[Rule]] = {}
        for rule in ruleset.rules:
            self.by_trigger.setdefault(rule.trigger, []).append(rule)
        self.before: list[EventRelation] = []
        self.lasting: list[Lasting] = []
        self._by_name: dict[str, list[Watched]] = {}
        self._of_domains: list[Watched] = []
        for number, statement in enumerate(ruleset.statements):
            if isinstance(statement, Lasting):
                self.lasting.append(statement)
            elif isinstance(statement, EventRelation) and statement.relation == "happenBefore":
                self.before.append(statement)
            elif isinstance(statement, (Exclusive, Never, Assume, EventRelation, MeasureRelation, Effect)):
                formula = _formula(statement)
                is_of_domains = isinstance(statement, (Exclusive, Never, Assume)) and statement.domains is not None
                watched = Watched(number, statement, formula, events_in(formula), is_of_domains)
                if is_of_domains and not watched.events:
                    self._of_domains.append(watched)
                for name in dict.fromkeys(names_of(formula)):
                    self._by_name.setdefault(name, []).append(watched)

    def watched(self, names: Iterable[str], has_entered: bool) -> list[Watched]:
        """The constraints and relations that depend on any of these names, in text order. If the domain `has_entered`,
        also those of domains that depend on conditions only."""
        found = {one.number: one for name in names for one in self._by_name.get(name, ())}
        if has_entered:
            found.update({one.number: one for one in self._of_domains})
        return [found[number] for number in sorted(found)]

    def context(self, moment: Moment) -> Situation:
        """The situation, in the open world, in which rules are decided at a moment."""
        return Situation(Context(frozenset(moment.occurred), moment.conditions), self.ruleset.measures, None)

    def situation(
        self,
        moment: Moment,
        occurred: Collection[str],
        executed: Collection[str],
        formula: Formula,
        is_over: bool = True,
    ) -> Situation:
        """The situation, in the open world, in which a formula about a moment with these events is decided. If the
        moment is not over, the other events of the formula are unknown."""
        names = events_in(formula)
        done = {name: name in executed for name in names if is_over or name in executed}
        context = Context(frozenset(occurred), moment.conditions)
        return Situation(context, self.ruleset.measures, None, done, False if is_over else None)


def events_in(formula: Formula) -> frozenset[str]:
    """The events that a formula names."""
    return frozenset(leaf.name for leaf in leaves(formula) if isinstance(leaf, Atom) and leaf.kind != "condition")


def _formula(statement: InstantStatement) -> Formula:
    if not isinstance(statement, Exclusive):
        return instant_formula(statement)
    # The names are obligations, also where one is a trigger, too.
    pairs = combinations([Atom("obligation", name) for name in statement.names], 2)
    return And(tuple(Not(And(pair)) for pair in pairs))
