"""The names and rules of a text, for switches, sliders and cards."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import ceil, floor

from sleec_runtime.language import print_formula
from sleec_runtime.model import (
    Assume,
    Calculation,
    Comparison,
    Formula,
    Measure,
    Never,
    Number,
    Rational,
    Rule,
    Ruleset,
    Value,
    formulas_of,
    leaves,
    measures_of,
)
from sleec_verify.results.json_values import Json, values_json

_MARGIN = 10
"""How far a slider goes beyond the numbers that the rules compare with."""

_MOST_EXACT = 2**53 - 1
"""The greatest number up to which JavaScript represents each integer."""


def names_json(ruleset: Ruleset) -> dict[str, Json]:
    """The triggers, conditions, measures and obligations, in alphabetical order."""
    numbers = _compared_numbers(ruleset)
    conditions: list[Json] = [{"name": name, "kind": "boolean"} for name in sorted(ruleset.conditions)]
    conditions += [_measure(ruleset.measures[name], numbers.get(name, [])) for name in sorted(ruleset.measures)]
    return {
        "triggers": [*sorted(ruleset.triggers)],
        "conditions": conditions,
        "obligations": [*sorted(ruleset.obligations)],
    }


def _measure(measure: Measure, numbers: list[Rational]) -> Json:
    if measure.kind == "scale":
        return {"name": measure.name, "kind": "scale", "values": list(measure.values)}
    least, most = min(numbers, default=0), max(numbers, default=0)
    return {
        "name": measure.name,
        "kind": "number",
        "whole": measure.kind == "integer",
        "values": list(values_json({str(number): number for number in sorted(set(numbers))}).values()),
        "minimum": min(floor(least) - _MARGIN, 0) if least < 0 else 0,
        "maximum": max(ceil(most) + _MARGIN, 2 * ceil(most)),
    }


def values_of_page(values: Mapping[str, Value]) -> dict[str, Json]:
    """Values of conditions and measures. A number that JavaScript cannot represent exactly is a text."""
    shown = values_json(values)
    return {name: str(one) if isinstance(one, int) and abs(one) > _MOST_EXACT else one for name, one in shown.items()}


def _compared_numbers(ruleset: Ruleset) -> dict[str, list[Rational]]:
    """The numbers with which the rules compare each measure."""
    found: dict[str, list[Rational]] = {}
    for formula in _formulas(ruleset):
        for leaf in leaves(formula):
            if isinstance(leaf, Comparison) and not isinstance(leaf.left, Calculation):
                sides = (leaf.left, leaf.right)
                numbers = [side.value for side in sides if isinstance(side, Number)]
                for name in measures_of(leaf):
                    found.setdefault(name, []).extend(numbers)
    return found


def _formulas(ruleset: Ruleset) -> Iterator[Formula]:
    for rule in ruleset.rules:
        yield from formulas_of(rule)
    yield from (one.formula for one in ruleset.constraints if isinstance(one, (Assume, Never)))


def rule_json(rule: Rule) -> dict[str, Json]:
    """A rule with the conditions of its clauses."""
    return {
        "label": rule.label,
        "trigger": rule.trigger,
        "guard": None if rule.guard is None else print_formula(rule.guard),
        "clauses": [
            {"number": number, "condition": None if clause.condition is None else print_formula(clause.condition)}
            for number, clause in enumerate(rule.clauses())
        ],
    }
