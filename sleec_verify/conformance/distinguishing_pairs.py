"""Pairs of contexts that reveal an incomplete change: some mixture of the two obliges what neither does."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from random import Random

from sleec_runtime.model import Context, Value, formulas_of
from sleec_verify.conformance.feasible_contexts import Assumptions
from sleec_verify.conformance.oracle import Oracle
from sleec_verify.conformance.regions import ValueRegion, context_of, givens

_TRIES = 40
_MIXTURES = 12
_SETS = 24


@dataclass(frozen=True)
class ContextPair:
    """Two contexts, the same triggers in both, and what is due in each. `telling`: a mixture would show."""

    before: Context
    after: Context
    due: tuple[tuple[str, ...], tuple[str, ...]]
    telling: bool

    @property
    def triggers(self) -> frozenset[str]:
        return self.before.triggers


def pairs(oracle: Oracle, assumptions: Assumptions) -> list[ContextPair]:
    """Pairs for single triggers and for sets of two, the telling ones first; always the same for the same rules."""
    found = []
    for triggers in _trigger_sets(oracle):
        pair = _pair(oracle, assumptions, triggers, Random(" ".join(sorted(triggers))))
        if pair is not None:
            found.append(pair)
    return sorted(found, key=lambda pair: not pair.telling)


def _trigger_sets(oracle: Oracle) -> Iterator[frozenset[str]]:
    named = list(dict.fromkeys(rule.trigger for rule in oracle.ruleset.rules))
    yield from (frozenset({name}) for name in named[:_SETS])
    yield from (frozenset(two) for two in list(combinations(named[:8], 2))[:_SETS])


def _pair(oracle: Oracle, assumptions: Assumptions, triggers: frozenset[str], dice: Random) -> ContextPair | None:
    formulas = [formula for rule in oracle.rules_of(triggers) for formula in formulas_of(rule)]
    given = givens(formulas, oracle.whole.measures, unreported=False)
    best: ContextPair | None = None
    for _ in range(_TRIES):
        first, second = (_drawn(given, triggers, assumptions, dice) for _ in range(2))
        if first is None or second is None or first.triggers != second.triggers:
            continue
        here, there = oracle.expected(first), oracle.expected(second)
        if here.conflict or there.conflict or here.due == there.due:
            continue
        justified = (here.due, there.due)
        if any(oracle.expected(mixed).due not in justified for mixed in _mixtures(first, second, dice)):
            return ContextPair(first, second, justified, True)
        best = best or ContextPair(first, second, justified, False)
    return best


def _drawn(
    given: Sequence[ValueRegion], triggers: frozenset[str], assumptions: Assumptions, dice: Random
) -> Context | None:
    return assumptions.nearest(context_of(given, [dice.choice(one.values) for one in given], triggers))


def _mixtures(first: Context, second: Context, dice: Random) -> Iterator[Context]:
    changed = [name for name, value in second.conditions.items() if first.conditions.get(name) != value]
    for _ in range(_MIXTURES if len(changed) > 1 else 0):
        taken: dict[str, Value] = {name: second.conditions[name] for name in changed if dice.random() < 0.5}
        yield Context(first.triggers, {**first.conditions, **taken})
