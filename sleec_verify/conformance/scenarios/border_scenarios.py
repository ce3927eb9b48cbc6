"""Scenarios of two steps: a rule is triggered, and something happens at the borders of its windows."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import islice, product

from sleec_runtime.model import Rule, Ruleset, Value, formulas_of
from sleec_verify.conformance.regions import givens
from sleec_verify.conformance.scenarios.random_scenarios import (
    Environment,
    components,
    horizon_of,
    window_measures,
)
from sleec_verify.conformance.scenarios.requirement import Requirements
from sleec_verify.conformance.scenarios.scenario import Completion, Scenario, Step

_MOST_CONTEXTS = 200
_MOST_SCENARIOS = 200
"""The maximal numbers for a rule: the rest is left to random scenarios."""

_LENGTH, _OTHER_LENGTHS = 5, (2, 10)
"""The values of measures that give the length of a window: at the first step, and at the second one."""


def scenarios_of_each_rule(ruleset: Ruleset) -> Iterator[Scenario]:
    """Each rule in each context that it distinguishes. Then, for each clause, a second step just before, at and just
    after each border of its windows: each trigger of a related rule, and each of some other contexts. Obligations are
    completed at once, or never."""
    end = horizon_of(ruleset)
    # A completion is that of one execution, and a rule may lead to several of one name.
    never = tuple(Completion(name, 0, None) for name in sorted(ruleset.obligations)) * 3
    requirements, environment = Requirements(ruleset), Environment(ruleset)
    for group in components(ruleset):
        triggers = sorted({rule.trigger for rule in group})
        for rule in group:
            found = list(islice(_contexts(rule, ruleset, environment), _MOST_CONTEXTS))
            for step in found:
                for completions in ((), never):
                    yield Scenario(f"rule {rule.label}", (step,), end, completions)
            both = (
                Scenario(f"rule {rule.label}, at a border", (first, second), second.at + end, completions)
                for first, second in _pairs(rule, ruleset, found, requirements, triggers)
                for completions in (never, ())
                if environment.allows((first, second))
            )
            yield from islice(both, _MOST_SCENARIOS)


def _contexts(rule: Rule, ruleset: Ruleset, environment: Environment) -> Iterator[Step]:
    """The triggers of a rule in each context that it distinguishes."""
    lengths = dict.fromkeys(sorted(window_measures(ruleset)), _LENGTH)
    regions = givens([*formulas_of(rule), *environment.formulas()], ruleset.measures)
    for drawn in product(*(one.values for one in regions)):
        values = {one.name: value for one, value in zip(regions, drawn) if not one.event and value is not None}
        events = {one.name for one, value in zip(regions, drawn) if one.event and value}
        step = Step(0, tuple(sorted({rule.trigger, *events})), {**lengths, **values})
        if environment.allows((step,)):
            yield step


def _pairs(
    rule: Rule, ruleset: Ruleset, contexts: list[Step], requirements: Requirements, triggers: list[str]
) -> Iterator[tuple[Step, Step]]:
    lengths = sorted(window_measures(replace(ruleset, statements=(rule,))))
    of_clause: dict[object, Step] = {}
    for step in contexts:
        of_clause.setdefault(_windows(rule, step, requirements), step)
    chosen = {windows: step for windows, step in of_clause.items() if windows}
    for windows, first in chosen.items():
        assert isinstance(windows, tuple)
        borders = {near for _, start, end in windows for one in (start, end) for near in (one - 1, one, one + 1)}
        others = [step.given for step in of_clause.values() if step is not first][:2]
        others += [{**first.given, **dict.fromkeys(lengths, length)} for length in _OTHER_LENGTHS if lengths]
        for at in sorted(time for time in borders if time > 0):
            for given in (None, *others):
                # Values that stay, and values of which none stays.
                changes = {} if given is None else _changed(first.given, given)
                for when in ((), *((name,) for name in triggers)):
                    if changes or when:
                        yield first, Step(at, when, changes)


def _windows(rule: Rule, step: Step, requirements: Requirements) -> tuple[tuple[str, int, int], ...]:
    """The windows of what a rule requires at a step, with the names."""
    values = {name: value for name, value in step.given.items() if value is not None}
    return tuple(
        (str(one.obligation), one.start, one.start if one.end is None else one.end)
        for decided, _, responses in requirements.decided((rule.trigger,), frozenset(step.when), values)
        for one in responses
        if decided is rule and one.start is not None
    )


def _changed(before: Mapping[str, Value | None], after: Mapping[str, Value | None]) -> dict[str, Value | None]:
    changes: dict[str, Value | None] = {name: None for name in before if name not in after}
    changes.update((name, value) for name, value in after.items() if name not in before or before[name] != value)
    return changes
