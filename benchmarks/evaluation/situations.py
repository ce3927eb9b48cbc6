"""Situations to test rules in: random cases, and every context of every rule, with the obligations of each."""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Union

from sleec_runtime.model import Comparison, Context, Number, Rule, Ruleset, formulas_of, leaves, names_of
from sleec_verify.entailment.definition1 import Definition1

Reported = Union[bool, int, str, None]
"""The value of a condition or measure in a message. None means that nobody reported it."""


@dataclass(frozen=True)
class Situation:
    """A domain, and the values of conditions and measures."""

    domain: str
    conditions: dict[str, Reported]


def random_situations(ruleset: Ruleset, count: int, seed: int = 0) -> list[Situation]:
    """The test cases of the paper: random values of all conditions, in a random domain."""
    draw = random.Random(seed)
    values = critical_values(ruleset)
    return [
        Situation(draw.choice(ruleset.domains), {name: draw.choice(choices) for name, choices in values.items()})
        for _ in range(count)
    ]


def every_situation(ruleset: Ruleset) -> list[tuple[Rule, Situation]]:
    """Each rule with every context that it distinguishes, in each domain."""
    return [
        (rule, Situation(domain, conditions))
        for rule in ruleset.rules
        for conditions in contexts_of(rule, ruleset)
        for domain in ruleset.domains
    ]


def packed(cases: Iterable[tuple[Rule, Situation]]) -> list[Situation]:
    """Fewer situations with the same contexts of the rules: those of several rules, if they share no condition or
    agree on it. First fit. All of them report the same names."""
    found: list[tuple[Situation, set[str]]] = []
    for rule, case in cases:
        for situation, labels in found:
            values = {**situation.conditions, **case.conditions}
            if (
                situation.domain == case.domain
                and rule.label not in labels
                and values.items() >= situation.conditions.items()
            ):
                break
        else:
            situation, labels = Situation(case.domain, {}), set()
            found.append((situation, labels))
        situation.conditions.update(case.conditions)
        labels.add(rule.label)
    names = {name for situation, _ in found for name in situation.conditions}
    return [
        Situation(situation.domain, {name: situation.conditions.get(name) for name in sorted(names)})
        for situation, _ in found
    ]


def contexts_of(rule: Rule, ruleset: Ruleset) -> Iterator[dict[str, Reported]]:
    """All combinations of the critical values of what a rule names."""
    values = critical_values(ruleset)
    names = sorted({name for formula in formulas_of(rule) for name in names_of(formula)})
    for chosen in product(*(values[name] for name in names)):
        yield dict(zip(names, chosen))


def critical_values(ruleset: Ruleset) -> dict[str, list[Reported]]:
    """For each condition and measure: no value, and true and false, the values of its scale, or for each threshold the
    whole numbers up to one from it."""
    found: dict[str, list[Reported]] = {name: [None, False, True] for name in sorted(ruleset.conditions)}
    for name, measure in sorted(ruleset.measures.items()):
        numbers = {n + step for n in _thresholds(ruleset, name) for step in (-1, 0, 1)}
        found[name] = [None, *(measure.values if measure.kind == "scale" else sorted(numbers))]
    return found


def _thresholds(ruleset: Ruleset, measure: str) -> Iterator[int]:
    for rule in ruleset.rules:
        for formula in formulas_of(rule):
            for leaf in leaves(formula):
                if isinstance(leaf, Comparison) and measure in names_of(leaf):
                    yield from (int(side.value) for side in (leaf.left, leaf.right) if isinstance(side, Number))


class GroundTruth:
    """What the rules entail by Definition 1, from the solver."""

    def __init__(self, ruleset: Ruleset) -> None:
        self._in_domain = {domain: ruleset.in_domain(domain) for domain in ruleset.domains}

    def obligations(self, situation: Situation, trigger: str) -> Sequence[str]:
        """The obligations in a situation in which `trigger` occurs, sorted."""
        ruleset = self._in_domain[situation.domain]
        reported = {name: value for name, value in situation.conditions.items() if value is not None}
        missing = frozenset(ruleset.measures.keys() - reported.keys())
        rules = [rule for rule in ruleset.rules if rule.trigger == trigger]
        if not rules:
            return ()
        entailed = Definition1(ruleset, rules, missing=missing).entailed(Context(frozenset({trigger}), reported))
        assert entailed is not None, f"the rules conflict in {situation}"
        return tuple(sorted(obligation.name for obligation in entailed if not obligation.negated))
