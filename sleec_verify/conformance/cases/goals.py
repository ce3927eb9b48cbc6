"""The goals of a set of situations, by criterion. Each criterion includes every clause.

- ``clause``: every clause is active once.
- ``condition``: every condition of a rule is true once and false once, while the rule is triggered.
- ``pairwise``: every two conditions of a rule in all four combinations.
- ``mcdc``: every condition of a rule decides once which clause is active, with all other conditions unchanged.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import combinations, product
from typing import Protocol

from sleec_runtime.language import print_formula
from sleec_runtime.model import Atom, Comparison, Formula, Rule, formulas_of, leaves
from sleec_verify.conformance.cases.allowed_situations import Goal
from sleec_verify.conformance.cases.mcdc import deciding_vectors
from sleec_verify.encoding.cnf import Encoder
from sleec_verify.query.ruleset_index import RulesetIndex


class Situations(Protocol):
    """All situations as one question, which encodes the triggers, formulas and guards of a situation as literals."""

    @property
    def index(self) -> RulesetIndex: ...

    @property
    def encoder(self) -> Encoder: ...

    def trigger(self, name: str) -> int: ...

    def literal(self, formula: Formula) -> int: ...

    def guards(self, position: int) -> Sequence[int]:
        """The literals of the guards of one rule's clauses."""
        ...


def conditions_of(rule: Rule) -> list[Atom | Comparison]:
    """The atomic conditions of a rule, each once, in the order of the text."""
    return list(dict.fromkeys(leaf for formula in formulas_of(rule) for leaf in leaves(formula)))


def clause_name(rule: Rule, number: int) -> str:
    return rule.layer(number) or f"{rule.label} (default)"


def goals(world: Situations, criterion: str, labels: frozenset[str]) -> list[Goal]:
    """The goals of the rules with these labels."""
    positions = [position for position, rule in enumerate(world.index.rules) if rule.label in labels]
    return [goal for position in positions for goal in goals_of_rule(world, criterion, position)]


def goals_of_rule(world: Situations, criterion: str, position: int) -> list[Goal]:
    return [*_clauses(world, position), *CRITERIA[criterion](world, position)]


def _clauses(world: Situations, position: int) -> Iterator[Goal]:
    rule = world.index.rules[position]
    for number, guard in enumerate(world.guards(position)):
        yield Goal(clause_name(rule, number), rule.trigger, guard)


def _no_more(world: Situations, position: int) -> Iterator[Goal]:
    yield from ()


def _literals(world: Situations, position: int) -> list[tuple[str, int]]:
    """Each condition of a rule by its text, with its literal."""
    return [(print_formula(c), world.literal(c)) for c in conditions_of(world.index.rules[position])]


def _conditions(world: Situations, position: int) -> Iterator[Goal]:
    rule = world.index.rules[position]
    in_guard = set(leaves(rule.guard)) if rule.guard is not None else set()
    asked = world.encoder.any_of(world.guards(position))
    for condition in conditions_of(rule):
        while_ = world.trigger(rule.trigger) if condition in in_guard else asked
        for value in (True, False):
            literal = world.literal(condition)
            yield Goal(
                f"{rule.label}: {print_formula(condition)} is {'true' if value else 'false'}",
                rule.trigger,
                world.encoder.both(while_, literal if value else -literal),
            )


def _pairs(world: Situations, position: int) -> Iterator[Goal]:
    rule = world.index.rules[position]
    conditions = _literals(world, position)
    if len(conditions) == 1:
        yield from _conditions(world, position)
    for two in combinations(conditions, 2):
        for values in product((True, False), repeat=2):
            yield _vector(world, rule, [text for text, _ in two], [literal for _, literal in two], values)


def _mcdc(world: Situations, position: int) -> Iterator[Goal]:
    rule = world.index.rules[position]
    conditions = conditions_of(rule)
    found = deciding_vectors(world.index, position, conditions)
    texts = [text for text, _ in _literals(world, position)]
    literals = [literal for _, literal in _literals(world, position)]
    for vector in found.vectors:
        yield _vector(world, rule, texts, literals, vector)
    for place in found.undecided:
        yield Goal(f"{rule.label}: {texts[place]} decides", rule.trigger, -world.encoder.true())


def _vector(world: Situations, rule: Rule, texts: list[str], literals: list[int], values: tuple[bool, ...]) -> Goal:
    said = ", ".join(text if value else f"NOT ({text})" for text, value in zip(texts, values))
    signed = [literal if value else -literal for literal, value in zip(literals, values)]
    return Goal(f"{rule.label}: {said}", rule.trigger, world.encoder.all_of([world.trigger(rule.trigger), *signed]))


CRITERIA: Mapping[str, Callable[[Situations, int], Iterator[Goal]]] = {
    "clause": _no_more,
    "condition": _conditions,
    "mcdc": _mcdc,
    "pairwise": _pairs,
}
