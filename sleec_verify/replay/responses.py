"""Responses: whether the rules of a conflict have a complying response in its situation, by the runtime's evaluator.

It uses the model and the evaluator of traces, and neither the encoding nor the solver. The method is a tableau: a
partial response grows by what it must contain until nothing is missing.

- A triggering of a rule by the situation or by the response is met in one of its ways (`ways_to_keep`).
- An event that a way requires occurs at one of the times of its window.
- A formula that a relation or constraint requires, and that is false at an instant, needs a further event there.
- At each later instant, conditions and measures have any values that the rules and relations distinguish.

Every complying response contains one that grows so: leaving out an event that nothing requires breaks nothing, because
no condition of the rules considered names it (otherwise, the question is left open).

**Times.** The choices above leave a system of difference constraints over the instants of the response: each weight is
a length of a window or the age of an instant of the history, or one more, because times are whole numbers and what
comes after a window is later than its end. Such a system has a least solution (Bellman 1958), in which each time is now
plus the weights along a simple path. So with `n` instants and the greatest common divisor `g` of the lengths and ages,
it suffices to try the times ``now + m * g + k`` with ``0 <= k <= n``, and, for a window without an end, none that is
later than `n` times the longest length plus one. If responses can have more than MOST_INSTANTS instants, and times are
left out, a search that finds nothing is open.

Left open are also: relations ``when … until`` and ``when … for`` that a response breaks, conditions that name an event
which the response can contain, comparisons of two measures, windows at later instants with a length that a measure
gives, and a search with more than MOST_STEPS steps.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import islice, pairwise, product
from math import ceil, floor, gcd, inf
from typing import NamedTuple

from sleec_runtime.errors import WrongType
from sleec_runtime.evaluation.instant_formulas import instant_formula
from sleec_runtime.evaluation.trace import Instant, Trace, Untimed
from sleec_runtime.evaluation.trace_violations import Due, holds_at, violations, ways_to_keep
from sleec_runtime.model import (
    RELATIONS,
    Assume,
    Atom,
    Comparison,
    Constraint,
    Declaration,
    EventRelation,
    Exclusive,
    Formula,
    Lasting,
    Length,
    MeasureRef,
    Never,
    Number,
    Rational,
    Relation,
    Rule,
    Ruleset,
    Value,
    formulas_of,
    leaves,
    literals,
    names_of,
)

MOST_STEPS = 4_000
"""The number of partial responses that one question looks at."""

MOST_INSTANTS = 8
"""The number of instants of a response up to which the times left out are known not to matter."""

MOST_EVENTS = 40
"""The number of events that a response adds, which bounds the depth of the search."""

MOST_CHOICES = 64
"""The number of valuations of an instant, and of ways to keep a rule."""


class Open(Exception):
    """The question is outside of what the search decides."""


class Responses:
    """The responses in one situation: a history, and the inputs of now with the values that are known."""

    def __init__(self, ruleset: Ruleset, situation: Trace, untimed: Untimed = "at", most: int = MOST_STEPS) -> None:
        """The last instant of `situation` is now, with its inputs. What it does not give a value may have any."""
        self._ruleset = ruleset
        self._situation = situation
        self._untimed: Untimed = untimed
        self._most = most

    @cached_property
    def mere_inputs(self) -> frozenset[str]:
        """The events that no response of now can contain."""
        declared = {
            name
            for one in self._ruleset.statements
            if isinstance(one, Declaration) and one.agent == "environment"
            for name in one.names
        }
        acts = {o.name for rule in self._ruleset.rules for clause in rule.clauses() for o in literals(clause)}
        named = {event for rule in self._ruleset.rules for event in _events_in(formulas_of(rule))}
        inputs = declared | named | {rule.trigger for rule in self._ruleset.rules}
        return frozenset(inputs - (acts - declared))

    def complying(self, labels: Collection[str]) -> Trace | None:
        """A trace in which a response complies with these rules; None if there is no such response.

        The evaluator confirms a response. Raises Open if the question is not decided.
        """
        rules = [rule for rule in self._ruleset.rules if rule.label in labels]
        search = _Search(self._ruleset, self._situation, self._untimed, rules, self.mere_inputs, self._most)
        try:
            found = search.run()
        except WrongType as error:
            raise Open(str(error)) from None
        if found is None and search.left_out:
            raise Open(search.left_out)
        return found

    def confirm(self, labels: Collection[str]) -> bool:
        """Whether rules are in conflict in the situation: no response complies with all of them, and one does with all
        but each. Raises Open if this is not decided."""
        if self.complying(labels) is not None:
            return False
        return all(self.complying([one for one in labels if one != label]) is not None for label in labels)


class _Partial(NamedTuple):
    """A partial response: the events and values of its instants, the triggerings to look at, and what is due."""

    events: Mapping[int, frozenset[str]]
    values: Mapping[int, Mapping[str, Value]]
    open: tuple[tuple[Rule, Instant], ...]
    due: tuple[Due, ...]


@dataclass
class _Search:
    ruleset: Ruleset
    situation: Trace
    untimed: Untimed
    rules: Sequence[Rule]
    mere_inputs: frozenset[str]
    most: int
    left_out: str = ""
    """Why a search that finds nothing does not decide."""
    steps: int = field(default=0, init=False)

    # The question ---------------------------------------------------------------------------------------------

    @cached_property
    def now(self) -> Instant:
        return self.situation.instants[-1]

    @cached_property
    def history(self) -> tuple[Instant, ...]:
        return self.situation.instants[:-1]

    @cached_property
    def by_trigger(self) -> Mapping[str, Sequence[Rule]]:
        found: dict[str, list[Rule]] = {}
        for rule in self.rules:
            found.setdefault(rule.trigger, []).append(rule)
        return found

    @cached_property
    def relations(self) -> list[Constraint | Relation]:
        """The relations and constraints that names connect with the rules."""
        names = {name for rule in self.rules for name in _names_of_rule(rule)}
        names |= {*self.now.events, *self.now.conditions}
        rest = [s for s in self.ruleset.statements if isinstance(s, (Exclusive, Never, Assume, *RELATIONS))]
        found: list[Constraint | Relation] = []
        grew = True
        while grew:
            joined = [s for s in rest if not names.isdisjoint(_names_of_relation(s))]
            rest = [s for s in rest if s not in joined]
            names.update(name for s in joined for name in _names_of_relation(s))
            found += joined
            grew = bool(joined)
        return found

    @cached_property
    def formulas(self) -> list[tuple[Formula, frozenset[str]]]:
        """What must be true at each instant, with the events that it names."""
        found = [
            instant_formula(s)
            for s in self.relations
            if not isinstance(s, Lasting) and not (isinstance(s, EventRelation) and s.relation == "happenBefore")
        ]
        return [(formula, _events_in([formula])) for formula in found]

    @cached_property
    def earlier(self) -> list[EventRelation]:
        return [s for s in self.relations if isinstance(s, EventRelation) and s.relation == "happenBefore"]

    @cached_property
    def addable(self) -> frozenset[str]:
        """The events that a response can contain."""
        acts = {o.name for rule in self.rules for clause in rule.clauses() for o in literals(clause) if not o.negated}
        return frozenset(acts).union(*(named for _, named in self.formulas), (s.left for s in self.earlier))

    @cached_property
    def choices(self) -> list[tuple[str, Sequence[Value]]]:
        """The conditions and measures that rules which a response triggers, and relations, distinguish."""
        formulas = [f for rule in self.rules if rule.trigger in self.addable for f in formulas_of(rule)]
        formulas += [f for f, _ in self.formulas]
        formulas += [f for s in self.relations if isinstance(s, Lasting) for f in _formulas_of_lasting(s)]
        return list(_values(formulas, self.ruleset).items())

    @cached_property
    def lengths(self) -> list[int]:
        """The lengths of the windows and the ages of the instants of the history; 1 if one is unknown or not whole."""
        found = [self.now.time - instant.time for instant in self.history]
        for length in self.stated_lengths:
            found += [1, 1] if length is None else [floor(length), ceil(length)]
        return found

    @cached_property
    def stated_lengths(self) -> list[Rational | None]:
        """The lengths of the windows in seconds; None for each that a measure gives."""
        return [length.seconds for rule in self.rules for length in _lengths_of(rule)]

    @cached_property
    def instants(self) -> float:
        """A bound on the number of instants of a response, now included."""
        if self.earlier or any(self.by_trigger.get(event) for _, named in self.formulas for event in named):
            return inf
        first = [rule for instant in (*self.history, self.now) for e in instant.events for rule in self._of(e)]
        return 1 + sum(self._acts_after(rule, frozenset()) for rule in first)

    def _acts_after(self, rule: Rule, above: frozenset[str]) -> float:
        if rule.label in above:
            return inf
        required = [o.name for clause in rule.clauses() for o in literals(clause) if not o.negated]
        return len(required) + sum(
            self._acts_after(other, above | {rule.label}) for event in required for other in self._of(event)
        )

    def _of(self, event: str) -> Sequence[Rule]:
        return self.by_trigger.get(event, ())

    # The search -----------------------------------------------------------------------------------------------

    def run(self) -> Trace | None:
        before = tuple(
            (rule, instant) for instant in self.history for event in sorted(instant.events) for rule in self._of(event)
        )
        for values in self._valuations(self.now.conditions):
            instant = replace(self.now, conditions=values)
            triggered = tuple((rule, instant) for event in sorted(instant.events) for rule in self._of(event))
            start = _Partial({instant.time: instant.events}, {instant.time: values}, (*before, *triggered), ())
            found = self._grow(start) if self._is_possible(start) else None
            if found is not None:
                return found
        return None

    def _count(self) -> None:
        self.steps += 1
        if self.steps > self.most:
            raise Open(f"more than {self.most} steps")

    def _valuations(self, given: Mapping[str, Value]) -> Iterator[Mapping[str, Value]]:
        free = [(name, values) for name, values in self.choices if name not in given]
        number = 1
        for _, values in free:
            number *= len(values)
        if number > MOST_CHOICES:
            raise Open("too many conditions and measures")
        for chosen in product(*(values for _, values in free)):
            yield {**given, **{name: value for (name, _), value in zip(free, chosen)}}

    def _grow(self, partial: _Partial) -> Trace | None:
        """A complying response that contains a partial one; None if there is none."""
        self._count()
        for following in self._steps(partial):
            if following is None:
                return self._checked(partial)
            if self._is_possible(following):
                found = self._grow(following)
                if found is not None:
                    return found
        return None

    def _steps(self, partial: _Partial) -> Iterator[_Partial | None]:
        """The ways in which a partial response must grow; None if nothing is missing."""
        if partial.open:
            (rule, instant), *rest = partial.open
            now = self._instant(partial, instant.time) if instant.time >= self.now.time else instant
            for way in self._ways(rule, now):
                yield partial._replace(open=tuple(rest), due=(*partial.due, *way))
            return
        unmet = [due for due in partial.due if not due.negated and not self._occurs(partial, due)]
        if unmet:
            due = min(unmet, key=lambda one: inf if one.last is None else one.last - max(one.first, self.now.time))
            for time in self._times(partial, due):
                yield from self._with(partial, due.event, time)
            return
        for time in sorted(partial.events):
            instant = self._instant(partial, time)
            for formula, named in self.formulas:
                if not holds_at(formula, instant, self.ruleset):
                    for event in sorted(self._missing(named, instant)):
                        yield from self._with(partial, event, time)
                    return
            for one in self.earlier:
                if time == self.now.time and one.right in self.now.events:
                    # A witness shows only what matters of the past.
                    continue
                earlier = [*self.history, *(Instant(t, partial.events[t]) for t in partial.events if t < time)]
                if one.right in instant.events and not any(one.left in before.events for before in earlier):
                    yield partial._replace(due=(*partial.due, Due(one.left, False, self.now.time, time - 1)))
                    return
        yield None

    def _ways(self, rule: Rule, instant: Instant) -> Sequence[tuple[Due, ...]]:
        named = _events_in(formulas_of(rule))
        if instant.time >= self.now.time and self._missing(named, instant):
            raise Open("a condition names an event")
        if instant.time > self.now.time and any(length.measures for length in _lengths_of(rule)):
            raise Open("a measure gives the length of a window")
        found = list(islice(ways_to_keep(rule, instant, self.ruleset, self.untimed), MOST_CHOICES + 1))
        if len(found) > MOST_CHOICES:
            raise Open("too many alternatives")
        return found

    def _missing(self, named: frozenset[str], instant: Instant) -> frozenset[str]:
        """Those of some events that can still be added to an instant."""
        return named - instant.events - (self.mere_inputs if instant.time == self.now.time else frozenset())

    def _with(self, partial: _Partial, event: str, time: int) -> Iterator[_Partial]:
        """A partial response with one more event."""
        if sum(map(len, partial.events.values())) - len(self.now.events) >= MOST_EVENTS:
            raise Open("too many events")
        events = {**partial.events, time: partial.events.get(time, frozenset()) | {event}}
        known = partial.values.get(time)
        for values in self._valuations({}) if known is None else [known]:
            triggered = ((rule, Instant(time, events[time], values)) for rule in self._of(event))
            yield partial._replace(
                events=events, values={**partial.values, time: values}, open=(*partial.open, *triggered)
            )

    def _instant(self, partial: _Partial, time: int) -> Instant:
        return Instant(time, partial.events[time], partial.values[time])

    def _occurs(self, partial: _Partial, due: Due) -> bool:
        return any(due.event in events and due.covers(time) for time, events in partial.events.items()) or any(
            due.event in instant.events and due.covers(instant.time) for instant in self.history
        )

    def _times(self, partial: _Partial, due: Due) -> Iterator[int]:
        """The times at which a required event may occur."""
        now = self.now.time
        lengths = self.lengths
        most = min(self.instants, MOST_INSTANTS)
        first = max(ceil(due.first), now)
        if due.last is None:
            last = max(first, now) + int(most + 1) * (max(lengths, default=0) + 1)
            if self.instants > MOST_INSTANTS or None in self.stated_lengths:
                self.left_out = "a window without an end"
        else:
            last = floor(due.last)
        grid = gcd(*lengths) or 1
        forbidden = [one for one in partial.due if one.negated and one.event == due.event]
        time = first
        while time <= last:
            blocking = next((one for one in forbidden if one.covers(time)), None)
            if blocking is not None:
                if blocking.last is None:
                    return
                time = floor(blocking.last) + 1
                continue
            rest = (time - now) % grid
            if rest > most:
                if self.instants > MOST_INSTANTS:
                    self.left_out = "a response of many instants"
                time += grid - rest
                continue
            self._count()
            if time > now or due.event not in self.mere_inputs or due.event in self.now.events:
                yield time
            time += 1

    def _is_possible(self, partial: _Partial) -> bool:
        """Whether nothing forbidden occurs, and further events can make the formulas of all instants true."""
        if any(due.negated and self._occurs(partial, due) for due in partial.due):
            return False
        instants = [self._instant(partial, time) for time in partial.events]
        return all(
            self._missing(named, instant) or holds_at(formula, instant, self.ruleset)
            for formula, named in self.formulas
            for instant in instants
        )

    def _checked(self, partial: _Partial) -> Trace | None:
        """The trace of a response, if the evaluator finds no violation."""
        trace = Trace((*self.history, *(self._instant(partial, time) for time in sorted(partial.events))))
        about = replace(
            self.ruleset,
            statements=(*self.relations, *self.rules),
            inferred=tuple(self.ruleset.measures.values()),
        )
        for one in violations(about, trace, self.untimed):
            if one.statement in self.earlier:
                continue
            # The values of the past are not all given.
            if one.time >= self.now.time or isinstance(one.statement, (Rule, Lasting)):
                self.left_out = f"a response breaks {type(one.statement).__name__}"
                return None
        return trace


# Names and values -----------------------------------------------------------------------------------------------


def _events_in(formulas: Iterable[Formula]) -> frozenset[str]:
    return frozenset(
        leaf.name for f in formulas for leaf in leaves(f) if isinstance(leaf, Atom) and leaf.kind != "condition"
    )


def _names_of_rule(rule: Rule) -> Iterator[str]:
    yield rule.trigger
    for clause in rule.clauses():
        yield from (o.name for o in literals(clause))
    for formula in formulas_of(rule):
        yield from names_of(formula)


def _formulas_of_lasting(relation: Lasting) -> Iterator[Formula]:
    yield from (f for f in (relation.condition, relation.formula, relation.end_condition) if f is not None)


def _names_of_relation(relation: Constraint | Relation) -> set[str]:
    if isinstance(relation, Lasting):
        named = {name for f in _formulas_of_lasting(relation) for name in names_of(f)}
        return named | {relation.event} | ({relation.end} if relation.end is not None else set())
    if isinstance(relation, EventRelation):
        return {relation.left, relation.right}
    return set(names_of(instant_formula(relation)))


def _lengths_of(rule: Rule) -> Iterator[Length]:
    for clause in rule.clauses():
        for one in literals(clause):
            window = None if one.timing is None else one.timing.window
            if window is not None:
                yield from (length for length in (window.start, window.end) if length is not None)


def _values(formulas: Iterable[Formula], ruleset: Ruleset) -> dict[str, Sequence[Value]]:
    """For each name that formulas mention, values that stand for all: between and beside the numbers it is compared
    with, one each. Raises Open if a formula compares two measures or calculates."""
    found: dict[str, Sequence[Value]] = {}
    numbers: dict[str, set[Rational]] = {}
    for formula in formulas:
        for leaf in leaves(formula):
            if isinstance(leaf, Atom) and leaf.kind == "condition":
                found[leaf.name] = (False, True)
            elif isinstance(leaf, Comparison):
                sides = (leaf.left, leaf.right)
                measures = [side.name for side in sides if isinstance(side, MeasureRef)]
                constants = [side.value for side in sides if isinstance(side, Number)]
                if len(measures) != 1:
                    raise Open("a formula compares two measures")
                values = ruleset.measures[measures[0]].values
                if values:
                    found[measures[0]] = values
                elif constants:
                    numbers.setdefault(measures[0], set()).update(constants)
                else:
                    raise Open("a formula calculates")
    from fractions import Fraction

    for name, compared in numbers.items():
        ordered = sorted(compared)
        if ruleset.measures[name].kind == "integer":
            near = {
                whole for value in ordered for whole in (ceil(value) - 1, floor(value), ceil(value), floor(value) + 1)
            }
            found[name] = tuple(sorted(near))
        else:
            between = [Fraction(a + b) / 2 for a, b in pairwise(ordered)]
            found[name] = (ordered[0] - 1, *ordered, *between, ordered[-1] + 1)
    return found
