"""The goals of a set of situations, by criterion. Each criterion includes every clause.

- ``clause``: every clause is active once.
- ``condition``: every condition of a rule is true once and false once, while the rule is triggered.
- ``pairwise``: every two conditions of a rule in all four combinations.
- ``mcdc``: every condition of a rule decides once which clause is active, with all other conditions unchanged.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from itertools import combinations, product

from sleec_runtime.language import print_formula
from sleec_runtime.model import Atom, Comparison, Rule, formulas_of, leaves
from sleec_verify.conformance.cases.allowed_situations import AllowedSituations, Goal
from sleec_verify.conformance.cases.mcdc import deciding_vectors


def conditions_of(rule: Rule) -> list[Atom | Comparison]:
    """The atomic conditions of a rule, each once, in the order of the text."""
    return list(dict.fromkeys(leaf for formula in formulas_of(rule) for leaf in leaves(formula)))


def clause_name(rule: Rule, number: int) -> str:
    return rule.layer(number) or f"{rule.label} (default)"


def goals(world: AllowedSituations, criterion: str, labels: frozenset[str]) -> list[Goal]:
    """The goals of the rules with these labels."""
    return [
        goal
        for position, rule in enumerate(world.index.rules)
        if rule.label in labels
        for goal in (*_clauses(world, position), *CRITERIA[criterion](world, position))
    ]


def _clauses(world: AllowedSituations, position: int) -> Iterator[Goal]:
    rule = world.index.rules[position]
    for number, guard in enumerate(world.guards[position]):
        yield Goal(clause_name(rule, number), rule.trigger, guard)


def _no_more(world: AllowedSituations, position: int) -> Iterator[Goal]:
    yield from ()


def _literals(world: AllowedSituations, position: int) -> list[tuple[str, int]]:
    """Each condition of a rule by its text, with its literal."""
    return [(print_formula(c), world.literal(c)) for c in conditions_of(world.index.rules[position])]


def _conditions(world: AllowedSituations, position: int) -> Iterator[Goal]:
    rule = world.index.rules[position]
    in_guard = set(leaves(rule.guard)) if rule.guard is not None else set()
    asked = world.encoder.any_of(world.guards[position])
    for condition in conditions_of(rule):
        while_ = world.trigger(rule.trigger) if condition in in_guard else asked
        for value in (True, False):
            literal = world.literal(condition)
            yield Goal(
                f"{rule.label}: {print_formula(condition)} is {'true' if value else 'false'}",
                rule.trigger,
                world.encoder.both(while_, literal if value else -literal),
            )


def _pairs(world: AllowedSituations, position: int) -> Iterator[Goal]:
    rule = world.index.rules[position]
    conditions = _literals(world, position)
    if len(conditions) == 1:
        yield from _conditions(world, position)
    for two in combinations(conditions, 2):
        for values in product((True, False), repeat=2):
            yield _vector(world, rule, [text for text, _ in two], [literal for _, literal in two], values)


def _mcdc(world: AllowedSituations, position: int) -> Iterator[Goal]:
    rule = world.index.rules[position]
    conditions = conditions_of(rule)
    found = deciding_vectors(world.index, position, conditions)
    texts = [text for text, _ in _literals(world, position)]
    literals = [literal for _, literal in _literals(world, position)]
    for vector in found.vectors:
        yield _vector(world, rule, texts, literals, vector)
    for place in found.undecided:
        yield Goal(f"{rule.label}: {texts[place]} decides", rule.trigger, -world.encoder.true())


def _vector(
    world: AllowedSituations, rule: Rule, texts: list[str], literals: list[int], values: tuple[bool, ...]
) -> Goal:
    said = ", ".join(text if value else f"NOT ({text})" for text, value in zip(texts, values))
    signed = [literal if value else -literal for literal, value in zip(literals, values)]
    return Goal(f"{rule.label}: {said}", rule.trigger, world.encoder.all_of([world.trigger(rule.trigger), *signed]))


CRITERIA: Mapping[str, Callable[[AllowedSituations, int], Iterator[Goal]]] = {
    "clause": _no_more,
    "condition": _conditions,
    "mcdc": _mcdc,
    "pairwise": _pairs,
}
