"""All small rulesets, up to the names of conditions and obligations. What is enumerated stands at each function."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
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
from tests.support.theory_cases import Case

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


def pairs(hedges: tuple[int, int], names: Sequence[str] = ("o",)) -> Iterator[Case]:
    """Every two rules with so many hedges each, where conditions are literals over three conditions and each clause
    says of each of `names` to do it, not to do it, or nothing; under one trigger or two, in both readings, in every
    context: all triggers or some or none, and all values of the conditions that the rules have. Up to renaming of
    conditions and obligations, negating a condition everywhere, and doing for not doing.

    In one context, rules with any conditions do what they do with literals that are true in the same places; that the
    conditions are evaluated alike, whatever their shape, is for `single_rules`.
    """
    first, second = hedges
    responses = [
        tuple(Obligation(name, negated) for name, negated in zip(names, said) if negated is not None)
        for said in product((False, True, None), repeat=len(names))
    ]
    for conditions in product(_literals(), repeat=first + second):
        if not _named_in_order(conditions) or not _first_positive(conditions):
            continue
        seen = {leaf.name for condition in conditions for leaf in leaves(condition) if isinstance(leaf, Atom)}
        here = [situation for situation in HERE if seen.issuperset(name for name in CONDITIONS if situation[name])]
        for said in product(responses, repeat=first + second + 2):
            if not _obliged_in_order([literal for response in said for literal in response], names):
                continue
            for other in ("t", "u"):
                contexts = [
                    Context(frozenset(triggers), situation)
                    for size in range(len({"t", other}) + 1)
                    for triggers in combinations(sorted({"t", other}), size)
                    for situation in here
                ]
                rules = (
                    _rule("r", "t", said[: first + 1], conditions[:first]),
                    _rule("s", other, said[first + 1 :], conditions[first:]),
                )
                for reading in READINGS:
                    yield Ruleset(rules, reading), contexts


def _obliged_in_order(literals: Iterable[Obligation], names: Sequence[str]) -> bool:
    """Whether the obligations come up in the order of their names, each as one to be done."""
    seen: list[str] = []
    for literal in literals:
        if literal.name not in seen:
            if literal.negated or literal.name != names[len(seen)]:
                return False
            seen.append(literal.name)
    return True


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
