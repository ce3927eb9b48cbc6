"""What the rules require in a trace, and which statements the trace breaks: by windows and clauses, without the
evaluator of the runtime."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple, Union

from sleec_runtime.errors import WrongType
from sleec_runtime.model import (
    NUMBER,
    RELATIONS,
    Assume,
    Context,
    EventRelation,
    Exclusive,
    Formula,
    Lasting,
    Length,
    Never,
    Rational,
    Rule,
    Ruleset,
    exact,
    obligation_text,
)
from sleec_verify.conformance.scenarios.compiled_rules import CompiledRules
from sleec_verify.conformance.scenarios.requirement import Requirements
from sleec_verify.encoding.relations import Relation, formula_at_one_instant
from sleec_verify.encoding.response_windows import WindowedResponse
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.results.timeline import Due
from sleec_verify.traces.trace import TraceInstant


class Broken(NamedTuple):
    """A statement that a trace breaks, and the time: that of the trigger of a rule, or of the instant."""

    statement: Union[Rule, Relation]
    time: int


class Lawfulness:
    """The statements of `ruleset`, all of which count, in complete traces. Nothing happens after their last instant."""

    def __init__(self, ruleset: Ruleset, untimed: Untimed = "at", requirements: Requirements | None = None) -> None:
        self._requirements = Requirements(ruleset, untimed) if requirements is None else requirements
        self._compiled = CompiledRules(ruleset)
        self._position = {id(statement): number for number, statement in enumerate(ruleset.statements)}
        self._relations = [s for s in ruleset.statements if isinstance(s, (Exclusive, Never, Assume, *RELATIONS))]

    def due(self, trace: Sequence[TraceInstant]) -> tuple[Due, ...]:
        """What the rules require, by time and then in text order. An alternative is due if what it replaces is not met.
        Raises WrongType for a measure without a number that gives the length of a window."""
        found = (one for instant in trace for one in self._due(instant, trace))
        return tuple(sorted(dict.fromkeys(found), key=lambda one: one.start))

    def broken(self, trace: Sequence[TraceInstant]) -> tuple[Broken, ...]:
        """The statements that a trace breaks, by time and then in text order. Raises WrongType as `due`."""
        found = [*self._broken_rules(trace), *self.broken_relations(trace)]
        return tuple(sorted(found, key=lambda one: (one.time, self._position[id(one.statement)])))

    def _broken_rules(self, trace: Sequence[TraceInstant]) -> Iterator[Broken]:
        for instant in trace:
            for rule, _, responses in self._decided(instant):
                if not all(_is_kept(one, responses, instant.time, trace) for one in responses if one.instead is None):
                    yield Broken(rule, instant.time)

    def broken_relations(self, trace: Sequence[TraceInstant]) -> Iterator[Broken]:
        """The constraints and relations that a trace breaks."""
        for number, instant in enumerate(trace):
            for relation in self._relations:
                if not self._is_kept_at(relation, trace, number):
                    yield Broken(relation, instant.time)

    # Rules ----------------------------------------------------------------------------------------------------

    def _decided(self, instant: TraceInstant) -> Iterator[tuple[Rule, int, tuple[WindowedResponse, ...]]]:
        for rule, clause, responses in self._requirements.decided(instant.events, instant.events, instant.conditions):
            for one in responses:
                timing = one.obligation.timing
                if one.unknown is not None and timing is not None and timing.window is not None:
                    for length in (timing.window.start, timing.window.end):
                        if length is not None:
                            _seconds(length, instant)
            yield rule, clause, responses

    def _due(self, instant: TraceInstant, trace: Sequence[TraceInstant]) -> Iterator[Due]:
        for rule, clause, responses in self._decided(instant):
            for one in responses:
                if any(_is_met(other, instant.time, trace) for other in _replaced(one)):
                    continue
                assert one.start is not None, "every length is known"
                yield Due(
                    rule.label,
                    clause,
                    obligation_text(one.obligation),
                    one.obligation.name,
                    one.obligation.negated,
                    instant.time + one.start,
                    None if one.end is None else instant.time + one.end,
                    None if one.instead is None else str(one.instead.obligation),
                    one.overdue,
                )

    # Relations and constraints --------------------------------------------------------------------------------

    def _is_kept_at(self, relation: Relation, trace: Sequence[TraceInstant], number: int) -> bool:
        instant = trace[number]
        if isinstance(relation, Lasting):
            return self._lasts(relation, trace[number:])
        if isinstance(relation, EventRelation) and relation.relation == "happenBefore":
            before = any(relation.left in earlier.events for earlier in trace[:number])
            return before or relation.right not in instant.events
        return self._holds(formula_at_one_instant(relation), instant)

    def _lasts(self, relation: Lasting, rest: Sequence[TraceInstant]) -> bool:
        begin = rest[0]
        if not self._happens(relation.event, relation.condition, begin):
            return True
        over = None if relation.duration is None else begin.time + _seconds(relation.duration, begin)
        for instant in rest:
            if over is not None and instant.time >= over:
                return True
            if relation.end is not None and self._happens(relation.end, relation.end_condition, instant):
                return True
            if not self._holds(relation.formula, instant):
                return False
        return True

    def _happens(self, event: str, condition: Formula | None, instant: TraceInstant) -> bool:
        return event in instant.events and (condition is None or self._holds(condition, instant))

    def _holds(self, formula: Formula, instant: TraceInstant) -> bool:
        return self._compiled.holds(formula, Context(instant.events, instant.conditions))


_NEEDS_VALUE = "give it a value at every instant at which a rule that asks for it is triggered"


def _replaced(one: WindowedResponse) -> Iterator[WindowedResponse]:
    while one.instead is not None:
        one = one.instead
        yield one


def _is_met(one: WindowedResponse, since: int, trace: Iterable[TraceInstant]) -> bool:
    """Whether a response itself is met, without its alternatives."""
    assert one.start is not None, "every length is known"
    start, end = since + one.start, None if one.end is None else since + one.end
    occurs = any(
        start <= instant.time and (end is None or instant.time <= end)
        for instant in trace
        if one.obligation.name in instant.events
    )
    return occurs != one.obligation.negated


def _is_kept(
    one: WindowedResponse, responses: Sequence[WindowedResponse], since: int, trace: Sequence[TraceInstant]
) -> bool:
    """Whether a response, or every response of one of its alternatives, is met."""
    if _is_met(one, since, trace):
        return True
    timing = one.obligation.timing
    if timing is None:
        return False
    for overdue, alternative in ((True, timing.otherwise), (False, timing.instead)):
        group = [other for other in responses if other.instead is one and other.overdue == overdue]
        if alternative is not None and all(_is_kept(other, responses, since, trace) for other in group):
            return True
    return False


def _seconds(length: Length, instant: TraceInstant) -> Rational:
    values = {}
    for name in length.measures:
        number = exact(instant.conditions.get(name))
        if number is None:
            raise WrongType(name, instant.conditions.get(name), f"the length of a window, {NUMBER}", _NEEDS_VALUE)
        values[name] = number
    return length.seconds_where(values)
