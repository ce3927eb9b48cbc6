"""All small rulesets, up to the names of conditions and obligations. What is enumerated stands at each function."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, product

from sleec_runtime.model import (
    READINGS,
    And,
    Atom,
    Clause,
    Context,
    Formula,
    Not,
    Obligation,
    Or,
    Rule,
    Ruleset,
    Truth,
    leaves,
)
from tests.proofs.compared import Case

CONDITIONS = ("a", "b", "c")
HERE = tuple(
    {name: name in true for name in CONDITIONS}
    for size in range(len(CONDITIONS) + 1)
    for true in combinations(CONDITIONS, size)
)
"""The eight situations of three conditions."""


def _literals() -> list[Formula]:
    return [formula for name in CONDITIONS for formula in (Atom("condition", name), Not(Atom("condition", name)))]


def _formulas() -> list[Formula]:
    """The constants, the literals, and each conjunction and disjunction of two literals of different conditions."""
    found: list[Formula] = [Truth(True), Truth(False), *_literals()]
    for x, y in combinations(_literals(), 2):
        if list(leaves(x)) != list(leaves(y)):
            found += [And((x, y)), Or((x, y))]
    return found


def _named_in_order(formulas: Sequence[Formula]) -> bool:
    """Whether the conditions come up in the order of their names: one of each class of renamings does."""
    seen = dict.fromkeys(leaf.name for formula in formulas for leaf in leaves(formula) if isinstance(leaf, Atom))
    return tuple(seen) == CONDITIONS[: len(seen)]


def single_rules() -> Iterator[Case]:
    """Every rule with up to two hedges, where conditions are any of `_formulas`, the guard is a literal or none, and
    each clause obliges a name of its own; in both readings, in all eight situations. Up to renaming of the
    conditions."""
    contexts = [Context(frozenset({"t"}), here) for here in HERE]
    contexts.append(Context(frozenset(), HERE[-1]))
    formulas = _formulas()
    for hedges in range(3):
        for guard in (None, *_literals()):
            for conditions in product(formulas, repeat=hedges):
                if not _named_in_order([*([guard] if guard else []), *conditions]):
                    continue
                clauses = tuple(Clause(c, (Obligation(f"o{i}"),)) for i, c in enumerate(conditions, 1))
                rule = Rule("r", "t", guard, Clause(None, (Obligation("o0"),)), clauses)
                for reading in READINGS:
                    yield Ruleset((rule,), reading), contexts


RESPONSES: tuple[tuple[Obligation, ...], ...] = ((Obligation("o"),), (Obligation("o", True),), ())
"""What clauses of two rules may say of the obligation that they share."""


def pairs(hedges: tuple[int, int]) -> Iterator[Case]:
    """Every two rules with so many hedges each, where conditions are literals over three conditions and each clause
    says to do one shared thing, not to do it, or nothing; under one trigger or two, in both readings, in all eight
    situations with all triggers. Up to renaming of the conditions, negating one everywhere, and doing for not doing."""
    first, second = hedges
    for conditions in product(_literals(), repeat=first + second):
        if not _named_in_order(conditions) or not _first_positive(conditions):
            continue
        for responses in product(RESPONSES, repeat=first + second + 2):
            said = [literal for response in responses for literal in response]
            if said and said[0].negated:
                continue
            for other in ("t", "u"):
                contexts = [Context(frozenset({"t", other}), here) for here in HERE]
                rules = (
                    _rule("r", "t", responses[: first + 1], conditions[:first]),
                    _rule("s", other, responses[first + 1 :], conditions[first:]),
                )
                for reading in READINGS:
                    yield Ruleset(rules, reading), contexts


def _first_positive(conditions: Sequence[Formula]) -> bool:
    seen: set[str] = set()
    for condition in conditions:
        name = next(leaf.name for leaf in leaves(condition) if isinstance(leaf, Atom))
        if name not in seen and isinstance(condition, Not):
            return False
        seen.add(name)
    return True


def _rule(label: str, trigger: str, responses: Sequence[tuple[Obligation, ...]], conditions: Sequence[Formula]) -> Rule:
    default, *others = responses
    return Rule(
        label,
        trigger,
        None,
        Clause(None, default),
        tuple(Clause(condition, response) for condition, response in zip(conditions, others)),
    )
