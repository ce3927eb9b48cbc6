"""Hypothesis strategies: contexts of a ruleset, values near the bounds of its measures, and changes of context.

`rulesets` is here too, so that one import serves. What is drawn keeps the ruleset's assumptions, and shrinks towards
the situation with the fewest facts.
"""

from __future__ import annotations

from collections.abc import Collection
from fractions import Fraction

from hypothesis import strategies as st

from sleec_runtime.model import Assume, Context, Formula, Never, Ruleset, Value, formulas_of
from sleec_verify.conformance.feasible_contexts import Assumptions
from sleec_verify.conformance.regions import constants, values_of
from sleec_verify.conformance.rulesets import formulas, rulesets

__all__ = ["changes", "contexts", "formulas", "histories", "rulesets", "values"]

_NEAR = (Fraction(1, 1000), Fraction(1, 10), Fraction(1))


def values(ruleset: Ruleset, name: str) -> st.SearchStrategy[Value]:
    """Values of a condition or measure: for numbers, mostly those that the rules compare it with, and just beside."""
    if name in ruleset.conditions:
        return st.booleans()
    measure = ruleset.measures[name]
    compared = _formulas(ruleset)
    regions = values_of(measure, compared)
    if measure.kind == "scale":
        return st.sampled_from(regions)
    if measure.kind == "integer":
        return st.one_of(st.sampled_from(regions), st.integers(-(10**6), 10**6))
    bounds = constants(compared).get(name) or {0}
    near = sorted({bound + side * step for bound in bounds for step in _NEAR for side in (-1, 1)})
    exact = [value.numerator if value.denominator == 1 else value for value in map(Fraction, near)]
    anything = st.integers(-(10**6), 10**6)
    return st.one_of(st.sampled_from(regions), st.sampled_from(exact), anything)


def contexts(
    ruleset: Ruleset, triggers: Collection[str] | None = None, unreported: bool = True
) -> st.SearchStrategy[Context]:
    """Contexts that the assumptions allow. `triggers` are those that occur, or else any do; `unreported` leaves some
    conditions and measures out."""
    assumptions = Assumptions(ruleset)
    known = sorted(ruleset.triggers)
    occurring = st.just(frozenset(triggers)) if triggers is not None else _some(known)
    facts = _facts(ruleset, unreported)

    def kept(drawn: tuple[frozenset[str], dict[str, Value]]) -> Context:
        context = assumptions.nearest(Context(*drawn), triggers or ())
        return context if context is not None else Context(frozenset(), {})

    return st.tuples(occurring, facts).map(kept)


def changes(ruleset: Ruleset, unreported: bool = True) -> st.SearchStrategy[dict[str, Value | None]]:
    """Changes as `Sleec.update` takes them: some conditions and measures with new values, None where unknown."""
    named = sorted({*ruleset.conditions, *ruleset.measures})
    new = {name: st.one_of(values(ruleset, name), *([st.none()] if unreported else [])) for name in named}
    if not named:
        return st.just({})
    return st.lists(st.sampled_from(named), min_size=1, max_size=6, unique=True).flatmap(
        lambda chosen: st.fixed_dictionaries({name: new[name] for name in chosen})
    )


def histories(
    ruleset: Ruleset, max_size: int = 8, unreported: bool = True
) -> st.SearchStrategy[list[dict[str, Value | None]]]:
    """Sequences of changes of context."""
    return st.lists(changes(ruleset, unreported), min_size=1, max_size=max_size)


def _some(triggers: list[str]) -> st.SearchStrategy[frozenset[str]]:
    if not triggers:
        return st.just(frozenset())
    # One more often than several: most dispatches of a robot are of one trigger.
    one = st.sampled_from(triggers).map(lambda name: frozenset({name}))
    return st.one_of(one, st.frozensets(st.sampled_from(triggers), min_size=1, max_size=4))


def _facts(ruleset: Ruleset, unreported: bool) -> st.SearchStrategy[dict[str, Value]]:
    every = {name: values(ruleset, name) for name in sorted({*ruleset.conditions, *ruleset.measures})}
    if unreported:
        return st.fixed_dictionaries({}, optional=every)
    return st.fixed_dictionaries(every)


def _formulas(ruleset: Ruleset) -> list[Formula]:
    own = [formula for rule in ruleset.rules for formula in formulas_of(rule)]
    return own + [c.formula for c in ruleset.constraints if isinstance(c, (Never, Assume))]
