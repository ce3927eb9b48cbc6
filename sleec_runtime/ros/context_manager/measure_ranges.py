"""The ranges that rules declare for measures: constraints on one measure, such as ``ASSUME age >= 0``."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from sleec_runtime.evaluation.formula_truth import holds
from sleec_runtime.model import Assume, Context, Formula, MeasureRelation, Ruleset, names_of
from sleec_runtime.ros.message import Conditions
from sleec_runtime.ros.problems import OutOfRange
from sleec_runtime.support.messages import represent


def measure_ranges(ruleset: Ruleset) -> Mapping[str, list[Formula]]:
    """The constraints on each measure alone: ``ASSUME``, and ``measure invariant`` of the DSL."""
    found: dict[str, list[Formula]] = {}
    for formula in _invariants(ruleset):
        names = set(names_of(formula))
        if len(names) == 1 and names <= ruleset.measures.keys():
            found.setdefault(names.pop(), []).append(formula)
    return found


def refuse_out_of_range(ranges: Mapping[str, list[Formula]], conditions: Conditions, ruleset: Ruleset) -> None:
    """Raises OutOfRange for a value outside its range, and WrongType for a value of another type."""
    for name, value in conditions.items():
        if value is None:
            continue
        context = Context(frozenset(), {name: value})
        for formula in ranges.get(name, ()):
            if not holds(formula, context, ruleset.measures):
                from sleec_runtime.language.common.formula_printer import print_formula

                shown = represent(value) if isinstance(value, str) else value
                raise OutOfRange(f"{name} is {shown}, outside its range: {print_formula(formula)}", "check the sensor")


def _invariants(ruleset: Ruleset) -> Iterable[Formula]:
    for statement in ruleset.statements:
        if isinstance(statement, Assume):
            yield statement.formula
        elif isinstance(statement, MeasureRelation) and statement.relation == "invariant":
            yield statement.left
