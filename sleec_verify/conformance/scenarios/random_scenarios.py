"""A Hypothesis strategy: scenarios of a ruleset, at the times that its windows distinguish."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from hypothesis import strategies as st

from sleec_runtime.model import (
    RELATIONS,
    Assume,
    Clause,
    EventRelation,
    Formula,
    Lasting,
    Length,
    Obligation,
    Rule,
    Ruleset,
    Value,
    formulas_of,
    literals,
    names_of,
)
from sleec_verify.conformance import strategies
from sleec_verify.conformance.scenarios.lawfulness import Lawfulness
from sleec_verify.conformance.scenarios.scenario import Completion, Scenario, Step
from sleec_verify.encoding.relations import events_of, formula_at_one_instant
from sleec_verify.traces.trace import TraceInstant

_LENGTHS = (1, 2, 3, 5, 10)
"""The values of measures that give the length of a window."""

_MOST_STEPS = 6
_MOST_COMPLETIONS = 5


_Drawn = tuple[
    list[tuple[int, list[str], dict[str, Value | None]]], list[tuple[str, int, "int | None"]], dict[str, int]
]


def scenarios(ruleset: Ruleset) -> st.SearchStrategy[Scenario]:
    """Scenarios that the assumptions and the relations of the environment allow. They shrink towards few steps, early
    times and completions at once.

    Most are about a few rules that share names, because what goes wrong in time goes wrong among these.
    """
    horizon, environment = horizon_of(ruleset), Environment(ruleset)
    measured = {name: st.sampled_from(_LENGTHS) for name in sorted(window_measures(ruleset))}
    groups = [rules for rules in components(ruleset) if len(rules) < len(ruleset.rules)]

    def made(drawn: _Drawn) -> Scenario:
        raw, ends, known = drawn
        found: list[Step] = []
        at = 0
        for number, (delay, when, given) in enumerate(raw):
            at += delay if number else 0
            step = Step(at, tuple(sorted(when)), {**known, **given} if number == 0 else given)
            if environment.allows([*found, step]):
                found.append(step)
        times = [step.at for step in found] or [0]
        completed = tuple(
            Completion(name, times[place], None if delay is None else times[place] + delay)
            for name, place, delay in ends
            if place < len(times)
        )
        return Scenario("a random scenario", tuple(found), times[-1] + horizon, completed)

    drawn = [_drawn(ruleset, rules, measured) for rules in (*groups, ruleset.rules)]
    return st.one_of(*drawn).map(made)


def _drawn(
    ruleset: Ruleset, rules: Sequence[Rule], measured: Mapping[str, st.SearchStrategy[int]]
) -> st.SearchStrategy[_Drawn]:
    """Steps, completions, and the measures that give lengths: about some rules."""
    about = replace(ruleset, statements=tuple(rules), inferred=tuple(ruleset.measures.values()))
    lengths = {near for one in _lengths(about) for near in (one - 1, one, one + 1) if near > 0}
    delays = st.sampled_from(sorted({1, *lengths}))
    triggers, obligations = sorted(about.triggers), sorted(about.obligations)
    some = st.lists(st.sampled_from(triggers), max_size=3, unique=True) if triggers else st.just([])
    one = st.sampled_from(triggers).map(lambda name: [name]) if triggers else st.just([])
    formulas = [*(formula for rule in rules for formula in formulas_of(rule)), *Environment(ruleset).formulas()]
    read = sorted(set().union(*map(names_of, formulas)))
    new = {
        name: st.one_of(strategies.values(ruleset, name), st.none())
        for name in read
        if name in ruleset.conditions or name in ruleset.measures
    }
    lasting = {name: values for name, values in new.items() if name not in measured} | {
        name: values for name, values in measured.items() if name in window_measures(about)
    }
    nothing: dict[str, Value | None] = {}
    changes = st.one_of(st.just(nothing), st.fixed_dictionaries({}, optional=lasting))
    steps = st.lists(st.tuples(delays, st.one_of(one, some), changes), min_size=1, max_size=_MOST_STEPS)
    ends = st.tuples(
        st.sampled_from(obligations or [""]), st.integers(0, _MOST_STEPS - 1), st.one_of(st.none(), delays)
    )
    completions = st.lists(ends, max_size=_MOST_COMPLETIONS)
    return st.tuples(steps, completions, st.fixed_dictionaries(dict(measured)))


def components(ruleset: Ruleset) -> list[tuple[Rule, ...]]:
    """The rules in groups that share no event and no condition."""
    groups: list[tuple[set[str], list[Rule]]] = []
    for rule in ruleset.rules:
        names = {rule.trigger, *(name for formula in formulas_of(rule) for name in names_of(formula))}
        names |= {one.name for clause in rule.clauses() for one in literals(clause)}
        joined = [group for group in groups if not names.isdisjoint(group[0])]
        groups = [group for group in groups if names.isdisjoint(group[0])]
        together = sorted([rule, *(one for _, rules in joined for one in rules)], key=ruleset.rules.index)
        groups.append((names.union(*(group[0] for group in joined)), together))
    return [tuple(rules) for _, rules in groups]


def _responses(ruleset: Ruleset) -> Iterator[Obligation]:
    for rule in ruleset.rules:
        for clause in rule.clauses():
            yield from literals(clause)


def _window_lengths(ruleset: Ruleset) -> Iterator[Length]:
    for one in _responses(ruleset):
        window = None if one.timing is None else one.timing.window
        if window is not None:
            yield from (length for length in (window.start, window.end) if length is not None)
    for statement in ruleset.statements:
        if isinstance(statement, Lasting) and statement.duration is not None:
            yield statement.duration


def window_measures(ruleset: Ruleset) -> set[str]:
    """The measures that give the length of a window."""
    return {name for length in _window_lengths(ruleset) for name in length.measures}


def _seconds(length: Length) -> list[int]:
    values = _LENGTHS if length.measures else (0,)
    return [int(length.seconds_where(dict.fromkeys(length.measures, value))) for value in values]


def _lengths(ruleset: Ruleset) -> Iterator[int]:
    for length in _window_lengths(ruleset):
        yield from _seconds(length)


def horizon_of(ruleset: Ruleset) -> int:
    """The time after the last step until every window that a step opens has closed, chains of two responses
    included."""
    longest = (_reach(clause) for rule in ruleset.rules for clause in rule.clauses())
    return 2 * max(longest, default=0) + 2


def _reach(clause: Clause) -> int:
    found = 0
    for one in clause.obligations:
        if one.timing is not None:
            window = one.timing.window
            end = 0 if window is None or window.end is None else max(_seconds(window.end))
            found = max(found, end + max((_reach(other) for other in one.timing.alternatives()), default=0))
    return max([found, *(_reach(hedge) for hedge in clause.hedges)])


class Environment:
    """The assumptions, and the relations that name no obligation."""

    def __init__(self, ruleset: Ruleset) -> None:
        self._statements = tuple(
            s
            for s in ruleset.statements
            if isinstance(s, Assume) or (isinstance(s, RELATIONS) and not ruleset.obligations & set(events_of(s)))
        )
        measures = tuple(ruleset.measures.values())
        self._laws = Lawfulness(replace(ruleset, statements=self._statements, inferred=measures))

    def formulas(self) -> Iterator[Formula]:
        """The formulas about one instant."""
        for one in self._statements:
            if isinstance(one, Lasting):
                yield one.formula
            elif not (isinstance(one, EventRelation) and one.relation == "happenBefore"):
                yield formula_at_one_instant(one)

    def allows(self, steps: Sequence[Step]) -> bool:
        """Whether these steps are allowed."""
        if not self._statements:
            return True
        values: dict[str, Value] = {}
        trace = []
        for step in steps:
            for name, value in step.given.items():
                if value is None:
                    values.pop(name, None)
                else:
                    values[name] = value
            trace.append(TraceInstant(step.at, frozenset(step.when), dict(values)))
        return not self._laws.broken(trace)
