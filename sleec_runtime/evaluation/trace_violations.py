"""The violations of a trace: which rules, constraints and relations it breaks, and when.

A trace is evaluated directly, by recursion over the rules, without compilation or search. docs/times.md defines the
meaning of the rules. The verifier replays each timed witness here before it shows it.

The trigger and the obligation of one name are one event here, which happens or does not. All statements count; for
rules with domains, pass the result of `Ruleset.in_domain`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import combinations, product
from math import ceil, floor
from typing import NamedTuple, Union

from sleec_runtime.errors import WrongType
from sleec_runtime.evaluation.formula_truth import Situation, truth
from sleec_runtime.evaluation.hedge_chain import Decision, decide, decide_chain
from sleec_runtime.evaluation.instant_formulas import conjunction, instant_formula, occurrence
from sleec_runtime.evaluation.trace import Instant, Trace, Untimed
from sleec_runtime.model import (
    NUMBER,
    RELATIONS,
    Assume,
    Atom,
    Claim,
    Clause,
    Constraint,
    Context,
    EventRelation,
    Exclusive,
    Formula,
    Lasting,
    Length,
    Never,
    Obligation,
    Or,
    Rational,
    Relation,
    Rule,
    Ruleset,
    Truth,
    exact,
    formulas_of,
    leaves,
)

Requirement = Union[Rule, Constraint, Relation]
"""A statement that a trace can break: a rule, a constraint or a relation."""

_NEVER = Truth(False)


class Violation(NamedTuple):
    """A statement that a trace breaks, and the time of its instant: that of the trigger of a rule, or of the event of
    a relation."""

    statement: Requirement
    time: int


def violations(ruleset: Ruleset, trace: Trace, untimed: Untimed = "at") -> tuple[Violation, ...]:
    """The violations of `trace`, by time and then in text order.

    Raises WrongType for a value that does not fit its condition or measure.
    """
    return tuple(_TraceEvaluation(ruleset, trace.instants, untimed).violations())


def violations_so_far(
    ruleset: Ruleset, history: Trace, untimed: Untimed = "at", apart: Rule | None = None
) -> tuple[Violation, ...]:
    """The violations of `history` that no continuation can avoid. Its last instant is now, when more events may occur.

    A statement is violated at an instant if no further events of now and no later instants satisfy it there. If
    a guard or hedge names an event, every case of further events of now is evaluated. Statements are evaluated
    separately, so that a contradiction between two of them is not a violation. The responses of the rule `apart` at now
    are evaluated separately, too. Raises WrongType as `violations`.
    """
    return tuple(_TraceEvaluation(ruleset, history.instants, untimed, goes_on=True, apart=apart).violations())


def claim_holds(claim: Claim, ruleset: Ruleset, trace: Trace, untimed: Untimed = "at") -> bool:
    """Whether the concern or purpose `claim` of `ruleset` occurs in `trace`, which may break rules.

    Its second claim (``meanwhile``) may occur at any instant, as in the published tools. Raises WrongType as
    `violations`.
    """
    return _TraceEvaluation(ruleset, trace.instants, untimed).claim(claim)


def ways_to_keep(rule: Rule, instant: Instant, ruleset: Ruleset, untimed: Untimed = "at") -> Iterator[tuple[Due, ...]]:
    """Each way to keep `rule` at one instant: what must occur, and what must not. An instant at which the rule asks for
    nothing has one way, without requirements. Raises WrongType as `violations`."""
    decision = decide(rule, Context(instant.events, instant.conditions), ruleset.reading, ruleset.measures)
    evaluation = _TraceEvaluation(ruleset, (instant,), untimed)
    yield from evaluation._ways(() if decision is None else decision.obligations, instant.time, instant)


def holds_at(formula: Formula, instant: Instant, ruleset: Ruleset) -> bool:
    """Whether `formula` is true at an instant, where an obligation is the event of its name. Raises WrongType as
    `violations`."""
    done = {a.name: a.name in instant.events for a in leaves(formula) if isinstance(a, Atom)}
    return bool(truth(formula, Situation(Context(instant.events, instant.conditions), ruleset.measures, obliged=done)))


class Due(NamedTuple):
    """An event that must occur, or must not occur, from `first` to `last`, or from `first` on if `last` is None."""

    event: str
    negated: bool
    first: Rational
    last: Rational | None

    def covers(self, time: Rational) -> bool:
        return self.first <= time and (self.last is None or time <= self.last)


@dataclass(frozen=True, slots=True)
class _TraceEvaluation:
    """The evaluation of some instants. `goes_on`: the last one is now, and anything may follow. `apart` is a rule whose
    responses of now are evaluated separately."""

    ruleset: Ruleset
    instants: tuple[Instant, ...]
    untimed: Untimed
    goes_on: bool = False
    apart: Rule | None = None

    def violations(self) -> Iterator[Violation]:
        statements = [s for s in self.ruleset.statements if isinstance(s, (Rule, Exclusive, Never, Assume, *RELATIONS))]
        for index, instant in enumerate(self.instants):
            for statement in statements:
                kept = (
                    self._rule(statement, instant) if isinstance(statement, Rule) else self._relation(statement, index)
                )
                if not kept:
                    yield Violation(statement, instant.time)

    def claim(self, claim: Claim) -> bool:
        found = any(
            claim.event in instant.events
            and (claim.condition is None or self._holds(claim.condition, instant))
            and all(self._kept(self._active(response, instant), instant) for response in claim.responses)
            for instant in self.instants
        )
        return found and (claim.meanwhile is None or self.claim(claim.meanwhile))

    # Rules ----------------------------------------------------------------------------------------------------

    def _rule(self, rule: Rule, instant: Instant) -> bool:
        if not self.goes_on or instant is not self.instants[-1]:
            return self._keeps(rule, instant)
        # A condition that names an event may depend on further events of now: each case is evaluated.
        named = frozenset().union(*map(_events_in, formulas_of(rule)))
        return any(
            replace(self, instants=(*self.instants[:-1], grown))._keeps(rule, grown, named - grown.events)
            for grown in _grown(instant, named)
        )

    def _keeps(self, rule: Rule, instant: Instant, absent: frozenset[str] = frozenset()) -> bool:
        """Whether a rule is kept at an instant, or can still be kept if the events `absent` do not occur there."""
        context = Context(instant.events, instant.conditions)
        decision = decide(rule, context, self.ruleset.reading, self.ruleset.measures)
        if decision is not None and rule is self.apart and instant is self.instants[-1]:
            return all(self._may_be_kept(obligation, instant.time, instant) for obligation in decision.obligations)
        return decision is None or self._kept(decision.obligations, instant, absent)

    def _may_be_kept(self, obligation: Obligation, due: Rational, instant: Instant) -> bool:
        """Whether an obligation, or each obligation of an alternative, can still be done by itself."""
        own = self._own(obligation, due, instant)
        return self._can_be_done((own,)) or any(
            all(self._may_be_kept(other, since, instant) for other in self._active(clause, instant))
            for clause, since in _in_place(obligation, due, own)
        )

    def _active(self, clause: Clause, instant: Instant) -> tuple[Obligation, ...]:
        """The obligations of the active clause of an alternative, decided as the chain of a rule."""
        situation = Situation(Context(instant.events, instant.conditions), self.ruleset.measures)
        decision = decide_chain(clause, situation, self.ruleset.reading)
        assert isinstance(decision, Decision), "in the closed world, every formula has a value"
        return decision.obligations

    def _kept(
        self, obligations: tuple[Obligation, ...], instant: Instant, absent: frozenset[str] = frozenset()
    ) -> bool:
        """Whether `obligations`, due at `instant`, are done, or can still be done if the events `absent` do not occur
        there."""
        if self.goes_on:
            # Together, because one obligation may require what another forbids.
            never = [Due(event, True, instant.time, instant.time) for event in absent]
            return any(self._can_be_done((*way, *never)) for way in self._ways(obligations, instant.time, instant))
        return all(
            any(all(self._occurs(due) != due.negated for due in way) for way in self._ways_of(o, instant.time, instant))
            for o in obligations
        )

    def _ways(self, obligations: tuple[Obligation, ...], due: Rational, instant: Instant) -> Iterator[tuple[Due, ...]]:
        """Each way to fulfil these obligations, which are due from the time `due` on. `instant` is that of the trigger,
        whose measures decide hedges and lengths."""
        for ways in product(*(self._ways_of(obligation, due, instant) for obligation in obligations)):
            yield tuple(one for way in ways for one in way)

    def _ways_of(self, obligation: Obligation, due: Rational, instant: Instant) -> Iterator[tuple[Due, ...]]:
        own = self._own(obligation, due, instant)
        yield (own,)
        for clause, since in _in_place(obligation, due, own):
            yield from self._ways(self._active(clause, instant), since, instant)

    def _own(self, obligation: Obligation, due: Rational, instant: Instant) -> Due:
        """The requirement of an obligation itself, without its alternatives."""
        window = None if obligation.timing is None else obligation.timing.window
        last: Rational | None
        if window is None:
            first, last = due, due if self.untimed == "at" else None
        else:
            first = due + (0 if window.start is None else _seconds(window.start, instant))
            last = None if window.end is None else due + _seconds(window.end, instant)
        return Due(obligation.name, obligation.negated, first, last)

    def _occurs(self, due: Due) -> bool:
        return any(due.event in instant.events and due.covers(instant.time) for instant in self.instants)

    def _can_be_done(self, way: tuple[Due, ...]) -> bool:
        return all(not self._occurs(due) if due.negated else self._occurs(due) or self._room(due, way) for due in way)

    def _room(self, due: Due, way: tuple[Due, ...]) -> bool:
        """Whether there is a time from now on at which `way` requires the event and does not forbid it."""
        forbidden = [other for other in way if other.negated and other.event == due.event]
        # The earliest time of all, or the first time after a prohibition.
        earliest = ceil(max(due.first, self.instants[-1].time))
        after = [floor(other.last) + 1 for other in forbidden if other.last is not None]
        return any(
            time >= earliest and due.covers(time) and not any(other.covers(time) for other in forbidden)
            for time in (earliest, *after)
        )

    # Relations and constraints --------------------------------------------------------------------------------

    def _relation(self, statement: Constraint | Relation, index: int) -> bool:
        instant = self.instants[index]
        if isinstance(statement, Lasting):
            return self._lasting(statement, index)
        if isinstance(statement, EventRelation) and statement.relation == "happenBefore":
            before = self.instants[:index]
            return statement.right not in instant.events or any(statement.left in i.events for i in before)
        return self._can_hold(instant_formula(statement), instant)

    def _lasting(self, relation: Lasting, index: int) -> bool:
        begin = self.instants[index]
        if relation.event not in begin.events or not (
            relation.condition is None or self._holds(relation.condition, begin)
        ):
            return True
        over = None if relation.duration is None else begin.time + _seconds(relation.duration, begin)
        end: Formula = _NEVER
        if relation.end is not None:
            end = conjunction(occurrence(relation.end), relation.end_condition)
        for instant in self.instants[index:]:
            if (over is not None and instant.time >= over) or self._holds(end, instant):
                return True
            if not self._can_hold(Or((relation.formula, end)), instant):
                return False
        return True

    def _can_hold(self, formula: Formula, instant: Instant) -> bool:
        """Whether `formula` holds at `instant`; at now, with any further events."""
        if not self.goes_on or instant is not self.instants[-1]:
            return self._holds(formula, instant)
        return any(self._holds(formula, grown) for grown in _grown(instant, _events_in(formula)))

    def _holds(self, formula: Formula, instant: Instant) -> bool:
        return holds_at(formula, instant, self.ruleset)


def _events_in(formula: Formula) -> frozenset[str]:
    return frozenset(leaf.name for leaf in leaves(formula) if isinstance(leaf, Atom) and leaf.kind != "condition")


def _grown(instant: Instant, events: frozenset[str]) -> Iterator[Instant]:
    """The instant with any further ones of these events."""
    further = sorted(events - instant.events)
    for size in range(len(further) + 1):
        for more in combinations(further, size):
            yield Instant(instant.time, instant.events.union(more), instant.conditions)


def _in_place(obligation: Obligation, due: Rational, own: Due) -> Iterator[tuple[Clause, Rational]]:
    """The alternatives to an obligation, each with the time from which it is due."""
    timing = obligation.timing
    if timing is None:
        return
    if timing.otherwise is not None:
        yield timing.otherwise, due if timing.window is None or own.last is None else own.last
    if timing.instead is not None:
        yield timing.instead, due


def _seconds(length: Length, instant: Instant) -> Rational:
    """A length of time in seconds, with the values of its measures at `instant`, that of the trigger.

    Raises WrongType if a measure has no number as its value there.
    """
    values = {}
    for name in length.measures:
        value = instant.conditions.get(name)
        number = exact(value)
        if number is None:
            hint = "give it a value at every instant at which a rule that asks for it is triggered"
            raise WrongType(name, value, f"the length of a window, {NUMBER}", hint)
        values[name] = number
    return length.seconds_where(values)
