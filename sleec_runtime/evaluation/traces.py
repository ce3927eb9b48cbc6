"""What happened, instant by instant, and which rules it breaks.

A trace is evaluated as it stands, by recursion over the rules (docs/dsl.md says what they mean): nothing is compiled
and nothing is searched. Every timed witness of the verifier is replayed here before it is shown.

Here the trigger and the obligation of one name are one event: it happens, or it does not. All statements count; of
rules with domains, give those of `Ruleset.in_domain`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import combinations, pairwise, product
from math import ceil, floor
from typing import Literal, NamedTuple, Union

from sleec_runtime.errors import WrongType
from sleec_runtime.evaluation.evaluation import Decision, Situation, decide, truth, walk
from sleec_runtime.model import (
    NUMBER,
    RELATIONS,
    And,
    Assume,
    Atom,
    Claim,
    Clause,
    Constraint,
    Context,
    Effect,
    EventRelation,
    Exclusive,
    Formula,
    Lasting,
    Length,
    MeasureRelation,
    Never,
    Not,
    Obligation,
    Or,
    Rational,
    Relation,
    Rule,
    Ruleset,
    Truth,
    Value,
    exact,
    formulas_of,
    leaves,
)

Untimed = Literal["at", "eventually"]
"""When an event without a window is due: at the very instant of the trigger, or at some instant from then on."""

Lawlike = Union[Rule, Constraint, Relation]
"""What a trace may break: of the statements of a ruleset, all but definitions, concerns and purposes."""

_NEVER = Truth(False)


# Traces ---------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Instant:
    """A time in seconds, what happens then, and what the conditions and measures are worth.

    A condition without a value is false, and so is a comparison with a measure that has none.
    """

    time: int
    events: frozenset[str] = frozenset()
    conditions: Mapping[str, Value] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Trace:
    """Instants, the earliest first. Between them, and after the last, nothing happens and nothing is looked at.

    Raises WrongType for a time that is no whole number from 0 on, or that is not later than the one before it.
    """

    instants: tuple[Instant, ...]

    def __post_init__(self) -> None:
        for instant in self.instants:
            if type(instant.time) is not int or instant.time < 0:
                raise WrongType("the time of an instant", instant.time, "a whole number of seconds, from 0 on")
        for earlier, later in pairwise(self.instants):
            if later.time <= earlier.time:
                raise WrongType(
                    "the time of an instant",
                    later.time,
                    f"later than that of the instant before it, {earlier.time}",
                    "give the instants in order, and each time once",
                )


class Broken(NamedTuple):
    """A statement that a trace breaks, and the time of the instant that it speaks of: that of the trigger of a rule, of
    the event of a relation."""

    statement: Lawlike
    time: int


def broken(ruleset: Ruleset, trace: Trace, untimed: Untimed = "at") -> tuple[Broken, ...]:
    """All that `trace` breaks, by time and then in the order of the text; nothing, if it is a trace of the rules.

    Raises WrongType for a value that does not fit its condition or measure.
    """
    return tuple(_Replay(ruleset, trace.instants, untimed).broken())


def broken_so_far(
    ruleset: Ruleset, history: Trace, untimed: Untimed = "at", apart: Rule | None = None
) -> tuple[Broken, ...]:
    """All that `history` breaks whatever comes: the last of its instants is now, when more may still happen.

    A statement is broken, at an instant, if no further events of now and no later instants satisfy it there; a guard or
    hedge that names an event is decided by the events that the history has. Each is
    looked at by itself: that two of them cannot be satisfied together does not show here. Of the rule `apart`, each
    response of now is, too: that its own responses contradict one another does not show either. Raises WrongType as
    `broken`.
    """
    return tuple(_Replay(ruleset, history.instants, untimed, goes_on=True, apart=apart).broken())


def claim_holds(claim: Claim, ruleset: Ruleset, trace: Trace, untimed: Untimed = "at") -> bool:
    """Whether `trace` brings about what a concern or purpose of `ruleset` speaks of.

    Its second claim (``meanwhile``) is looked for anywhere in the trace, as in the published tools. Whether the trace
    is one of the rules is not asked. Raises WrongType as `broken`.
    """
    return _Replay(ruleset, trace.instants, untimed).claim(claim)


# Replaying ------------------------------------------------------------------------------------------------


class _Due(NamedTuple):
    """An event that is to occur, or not to occur, from `first` to `last`; without a `last`, from `first` on."""

    event: str
    negated: bool
    first: Rational
    last: Rational | None

    def covers(self, time: Rational) -> bool:
        return self.first <= time and (self.last is None or time <= self.last)


@dataclass(frozen=True, slots=True)
class _Replay:
    """Some instants, with all that is needed to look at them. `goes_on`: the last is now, and anything may follow.
    `apart` is a rule whose responses of now are looked at one by one."""

    ruleset: Ruleset
    instants: tuple[Instant, ...]
    untimed: Untimed
    goes_on: bool = False
    apart: Rule | None = None

    def broken(self) -> Iterator[Broken]:
        laws = [s for s in self.ruleset.statements if isinstance(s, (Rule, Exclusive, Never, Assume, *RELATIONS))]
        for index, instant in enumerate(self.instants):
            for law in laws:
                if not (self._rule(law, instant) if isinstance(law, Rule) else self._relation(law, index)):
                    yield Broken(law, instant.time)

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
        # What else occurs now can decide a condition that names an event: each case is looked at.
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
        """Whether an obligation, or each of what stands in its place, can still be done, by itself."""
        own = self._own(obligation, due, instant)
        return self._can_be_done((own,)) or any(
            all(self._may_be_kept(other, since, instant) for other in self._active(clause, instant))
            for clause, since in _in_place(obligation, due, own)
        )

    def _active(self, clause: Clause, instant: Instant) -> tuple[Obligation, ...]:
        """What a chain of its own obliges, such as one behind `otherwise`: as a rule with nothing but that chain."""
        situation = Situation(Context(instant.events, instant.conditions), self.ruleset.measures)
        decision = walk(Rule("", "", None, clause, ()), situation, self.ruleset.reading)
        assert isinstance(decision, Decision), "without a guard, and in the closed world, a clause always decides"
        return decision.obligations

    def _kept(
        self, obligations: tuple[Obligation, ...], instant: Instant, absent: frozenset[str] = frozenset()
    ) -> bool:
        """Whether all of what is due at `instant` is done, or can still be done if the events `absent` do not occur
        there."""
        if self.goes_on:
            # All at once: what one obligation asks for may be what another forbids.
            never = [_Due(event, True, instant.time, instant.time) for event in absent]
            return any(self._can_be_done((*way, *never)) for way in self._ways(obligations, instant.time, instant))
        return all(
            any(all(self._occurs(due) != due.negated for due in way) for way in self._ways_of(o, instant.time, instant))
            for o in obligations
        )

    def _ways(self, obligations: tuple[Obligation, ...], due: Rational, instant: Instant) -> Iterator[tuple[_Due, ...]]:
        """Each way to keep all of these obligations, which are due from the time `due` on; `instant` is that of the
        trigger, whose measures decide hedges and lengths."""
        for ways in product(*(self._ways_of(obligation, due, instant) for obligation in obligations)):
            yield tuple(one for way in ways for one in way)

    def _ways_of(self, obligation: Obligation, due: Rational, instant: Instant) -> Iterator[tuple[_Due, ...]]:
        own = self._own(obligation, due, instant)
        yield (own,)
        for clause, since in _in_place(obligation, due, own):
            yield from self._ways(self._active(clause, instant), since, instant)

    def _own(self, obligation: Obligation, due: Rational, instant: Instant) -> _Due:
        """What an obligation asks for itself, without what may be done in its place."""
        window = None if obligation.timing is None else obligation.timing.window
        last: Rational | None
        if window is None:
            first, last = due, due if self.untimed == "at" else None
        else:
            first = due + (0 if window.start is None else _seconds(window.start, instant))
            last = None if window.end is None else due + _seconds(window.end, instant)
        return _Due(obligation.name, obligation.negated, first, last)

    def _occurs(self, due: _Due) -> bool:
        return any(due.event in instant.events and due.covers(instant.time) for instant in self.instants)

    def _can_be_done(self, way: tuple[_Due, ...]) -> bool:
        return all(not self._occurs(due) if due.negated else self._occurs(due) or self._room(due, way) for due in way)

    def _room(self, due: _Due, way: tuple[_Due, ...]) -> bool:
        """Whether there is a time, from now on, for an event that `way` asks for and does not forbid then."""
        forbidden = [other for other in way if other.negated and other.event == due.event]
        # The earliest time of all, or else the first after a prohibition.
        earliest = ceil(max(due.first, self.instants[-1].time))
        after = [floor(other.last) + 1 for other in forbidden if other.last is not None]
        return any(
            time >= earliest and due.covers(time) and not any(other.covers(time) for other in forbidden)
            for time in (earliest, *after)
        )

    # Relations and constraints --------------------------------------------------------------------------------

    def _relation(self, law: Constraint | Relation, index: int) -> bool:
        instant = self.instants[index]
        if isinstance(law, Lasting):
            return self._lasting(law, index)
        if isinstance(law, EventRelation) and law.relation == "happenBefore":
            return law.right not in instant.events or any(law.left in i.events for i in self.instants[:index])
        return self._can_hold(_at_every_instant(law), instant)

    def _lasting(self, law: Lasting, index: int) -> bool:
        begin = self.instants[index]
        if law.event not in begin.events or not (law.condition is None or self._holds(law.condition, begin)):
            return True
        over = None if law.duration is None else begin.time + _seconds(law.duration, begin)
        end: Formula = _NEVER
        if law.end is not None:
            end = _both(_occurrence(law.end), law.end_condition)
        for instant in self.instants[index:]:
            if (over is not None and instant.time >= over) or self._holds(end, instant):
                return True
            if not self._can_hold(Or((law.formula, end)), instant):
                return False
        return True

    def _can_hold(self, formula: Formula, instant: Instant) -> bool:
        """Whether `formula` holds at `instant`; at now, with whatever else happens then."""
        if not self.goes_on or instant is not self.instants[-1]:
            return self._holds(formula, instant)
        return any(self._holds(formula, grown) for grown in _grown(instant, _events_in(formula)))

    def _holds(self, formula: Formula, instant: Instant) -> bool:
        context = Context(instant.events, instant.conditions)
        # To have been obliged is nothing here: an obligation is the event.
        done = {a.name: a.name in instant.events for a in leaves(formula) if isinstance(a, Atom)}
        return bool(truth(formula, Situation(context, self.ruleset.measures, obliged=done)))


def _events_in(formula: Formula) -> frozenset[str]:
    return frozenset(leaf.name for leaf in leaves(formula) if isinstance(leaf, Atom) and leaf.kind != "condition")


def _grown(instant: Instant, events: frozenset[str]) -> Iterator[Instant]:
    """The instant with any of these events occurring, too."""
    further = sorted(events - instant.events)
    for size in range(len(further) + 1):
        for more in combinations(further, size):
            yield Instant(instant.time, instant.events.union(more), instant.conditions)


def _in_place(obligation: Obligation, due: Rational, own: _Due) -> Iterator[tuple[Clause, Rational]]:
    """The responses in place of an obligation, each with the time from which it is due."""
    timing = obligation.timing
    if timing is None:
        return
    if timing.otherwise is not None:
        yield timing.otherwise, due if timing.window is None or own.last is None else own.last
    if timing.instead is not None:
        yield timing.instead, due


def _seconds(length: Length, instant: Instant) -> Rational:
    """A length of time in seconds; where measures say how long, by their values at `instant`, that of the trigger.

    Raises WrongType if one of them has no value there that is a number.
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


# What is true at every instant ----------------------------------------------------------------------------


def _at_every_instant(law: Constraint | EventRelation | MeasureRelation | Effect) -> Formula:
    """What `law` says of each instant by itself."""
    if isinstance(law, Exclusive):
        pairs = [_not_both(_occurrence(a), _occurrence(b)) for a, b in combinations(law.names, 2)]
        return And(tuple(pairs))
    if isinstance(law, Never):
        return Not(law.formula)
    if isinstance(law, Assume):
        return law.formula
    if isinstance(law, EventRelation):
        left, right = _occurrence(law.left), _occurrence(law.right)
        if law.relation == "witness":
            return _if(left, right)
        return _iff(left, right) if law.relation == "equal" else _not_both(left, right)
    if isinstance(law, Effect):
        event = _occurrence(law.event)
        if law.relation == "causation":
            return _if(law.formula, event)
        return _if(event, law.formula) if law.relation == "includes" else _not_both(event, law.formula)
    if law.right is None:
        return law.left
    if law.relation == "imply":
        return _if(law.left, law.right)
    # "opposite" is no more than "not both" in the published tools.
    return _iff(law.left, law.right) if law.relation == "iff" else _not_both(law.left, law.right)


def _occurrence(event: str) -> Formula:
    return Atom("trigger", event)


def _both(left: Formula, right: Formula | None) -> Formula:
    return left if right is None else And((left, right))


def _if(left: Formula, right: Formula) -> Formula:
    return Or((Not(left), right))


def _iff(left: Formula, right: Formula) -> Formula:
    return And((_if(left, right), _if(right, left)))


def _not_both(left: Formula, right: Formula) -> Formula:
    return Not(And((left, right)))
