"""Policies: how to go on after now, whatever the history was, as far as it suits the history at all.

A policy does some events *soon*: as soon after now as a response calls for them, a second after now at the earliest.
Others it does *late*, if anything calls for them without end: at an instant of their own, once all that forbids them
for some time only is over. All further ones are not done after now. The measures are the same at all instants at which
soon ones are done, and at all late instants. So:

- what calls for an event that is done soon is met, if there is time left after now; and what calls for one that is done
  late, if there is no end to it;
- what forbids an event that is not done is kept from now on, and so is what forbids, for some time, one done late;
- what an event of the policy calls for, and what laws demand of it, has to be met in this way too: the policy is
  *closed*, which is a question about one instant at which all that is done soon occurs, and one of what is done late.

Where responses do not come back to their own trigger, the trace ends, as it has to.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set
from functools import cached_property
from typing import NamedTuple

from sleec_runtime.model import Assume, Never, Rule
from sleec_runtime.model_time import Effect, EventRelation, Lasting
from sleec_verify.solver import MiniSat, Undecided
from sleec_verify.timed.instant import Formula, Instant
from sleec_verify.timed.laws import clauses_at
from sleec_verify.timed.program import Law, Program, events_of, leads_back, responses_of
from sleec_verify.timed.responses import Demand, Every, Occurs, occurrences, ways_of
from sleec_verify.timed.unfolding import Unfolding, Unseen


class Policy(NamedTuple):
    """The events that are done soon after now, and late. Of those done soon, the ones that are done in the `next`
    second only, as no response calls for them later."""

    soon: frozenset[str] = frozenset()
    late: frozenset[str] = frozenset()
    next: frozenset[str] = frozenset()

    @property
    def events(self) -> frozenset[str]:
        return self.soon | self.late


class Policies:
    """The closed policies of some `rules` and the laws of some `events`, without those that are `impossible`."""

    def __init__(
        self, program: Program, rules: Mapping[str, Rule], events: set[str], impossible: frozenset[str] = frozenset()
    ) -> None:
        self._program = program
        self._rules = rules
        self._laws = [law for law in program.laws if events.issuperset(events_of(law))]
        self._formula = Formula()
        self._true = self._formula.true
        self._solver = MiniSat()
        self._sent = 0
        early, late = (
            Instant(self._formula, program.ruleset.measures, self._true, impossible=impossible) for _ in range(2)
        )
        self._instants = (early, late)
        names = sorted(events)
        self._soon = {event: early.event(event) for event in names}
        self._done = {event: self._formula.fresh() for event in names}
        for event, done in self._done.items():
            # At a late instant, it may also be done because others are.
            self._formula.clauses += ([-self._soon[event], done], [-late.event(event), done])
            self._formula.clauses.append([-done, self._soon[event], late.event(event)])
        self._next = {event: self._only_next(event) for event in names}
        for instant in self._instants:
            self._close(instant)

    def suiting(self, inner: Unfolding, now: int, unseen: Mapping[Unseen, bool]) -> Policy | None:
        """A closed policy by which all is met that the instants up to `now` of a trace leave to be done; None if there
        is none. One that suits every history, if there is such a one."""
        suits_all = self._suits_all
        left = self._left(inner, now, unseen)
        for assumed in ([suits_all, left], [left]):
            found = self._solve(assumed)
            if found is not None and self._ends(found.events):
                return found
        return None

    def has_late(self, event: str) -> bool:
        """Whether there is one that does an event late, and nothing that any rule may forbid without end."""
        for_ever = [
            -done
            for name, done in self._done.items()
            if any(
                what.negated and what.event == name and what.end is None
                for rule in self._program.forbidding.get(name, ())
                for what in self._program.windows(rule)
            )
        ]
        found = self._solve([self._instants[1].event(event), self._unprepared(frozenset()), *for_ever])
        return found is not None and self._ends(found.events)

    def _solve(self, assumed: list[int]) -> Policy | None:
        while True:
            for instant in self._instants:
                instant.settle()
            clauses = self._formula.clauses
            self._solver.add(clauses[self._sent :])
            self._sent = len(clauses)
            answer = self._solver.solve(assumed)
            if answer is None:
                raise Undecided("the solver gave up after its budget of conflicts")
            if not answer:
                return None
            lemmas = [instant.measures.refused(self._solver.holds, False) for instant in self._instants]
            refused = [lemma for lemma in lemmas if lemma is not None]
            if not refused:
                soon = frozenset(event for event, literal in self._soon.items() if self._solver.holds(literal))
                done = frozenset(event for event, literal in self._done.items() if self._solver.holds(literal))
                only = frozenset(event for event, literal in self._next.items() if self._solver.holds(literal))
                return Policy(soon, done - soon, only)
            clauses += refused

    def _ends(self, policy: frozenset[str]) -> bool:
        """Whether what the events of a policy call for never comes back to them."""
        if self._program.is_acyclic:
            return True
        return not leads_back(
            (rule.trigger, what.event)
            for rule in self._rules.values()
            if rule.trigger in policy
            for what in self._program.windows(rule)
            if not what.negated and what.event in policy
        )

    # What a policy has to keep of itself ----------------------------------------------------------------------

    def _close(self, instant: Instant) -> None:
        """Only policies that meet what an instant to come calls for, whichever of its events occur there."""
        reading = self._program.ruleset.reading
        clauses = self._formula.clauses
        for rule in self._rules.values():
            for clause, guard in zip(rule.clauses(), instant.guards(rule, reading)):
                if clause.obligations:
                    due = self._program.responses.of(clause.obligations, lambda c: instant.chain(c, reading))
                    clauses.append([-guard, self._met(instant, due)])
        for law in self._laws:
            clauses += _kept(instant, law)

    def _only_next(self, event: str) -> int:
        """A literal that implies that a policy does an event in the next second, if at all, and not later."""
        bringing = set()
        for rule in self._rules.values():
            for what in self._program.windows(rule):
                if what.event == event and not what.negated:
                    if what.start is not None and what.start > 1:
                        return -self._true
                    bringing.add(rule.trigger)
        for law in self._laws:
            if isinstance(law, Effect) and law.relation == "causation" and law.event == event:
                return -self._true
            if isinstance(law, EventRelation) and law.relation in ("witness", "equal"):
                bringing.update({law.left, law.right} - {event} if event in (law.left, law.right) else ())
        late = self._instants[1].event(event)
        return self._formula.every([self._soon[event], -late, *(-self._done[other] for other in sorted(bringing))])

    def _met(self, instant: Instant, demand: Demand) -> int:
        """A literal that implies that a policy meets a demand of an instant to come."""
        if isinstance(demand, int):
            return demand
        if isinstance(demand, Occurs):
            if demand.is_empty:
                return self._true if demand.negated else -self._true
            here = instant.event(demand.event)
            if demand.start == demand.end == 0:
                return -here if demand.negated else here
            if not demand.negated:
                return self._does(demand)
            # Those done late wait for what is over some time.
            return self._formula.every([-self._does(demand), -here])
        return self._joined([self._met(instant, part) for part in demand.parts], isinstance(demand, Every))

    def _does(self, what: Occurs) -> int:
        """The literal "what calls for this is met, if there is time for it"."""
        return self._done[what.event] if what.end is None else self._soon[what.event]

    def _joined(self, parts: list[int], every: bool) -> int:
        if every:
            return self._formula.every(parts) if parts else self._true
        return self._formula.any_of(parts) if parts else -self._true

    # What a history leaves ------------------------------------------------------------------------------------

    def _left(self, inner: Unfolding, now: int, unseen: Mapping[Unseen, bool]) -> int:
        """A literal that implies that a policy meets all that is left to be done by the instants up to `now`."""
        times, _ = inner.schedule()
        happening = {number: inner.happening(number) for number in inner.used() if number <= now}
        found = [self._unprepared({event for events in happening.values() for event in events})]

        def left(at: int, demand: Demand) -> int:
            if isinstance(demand, int):
                return self._true if inner.true(demand) else -self._true
            if isinstance(demand, Occurs):
                occurred = unseen.get(Unseen(at, demand.event, demand.start, demand.end), False) or any(
                    demand.event in events and demand.covers(times[number] - times[at])
                    for number, events in happening.items()
                )
                if occurred:
                    return -self._true if demand.negated else self._true
                return self._from_now_on(demand, times[now] - times[at])
            return self._joined([left(at, part) for part in demand.parts], isinstance(demand, Every))

        for one in inner.decided:
            if one.at <= now and one.rule.label in self._rules and inner.true(one.guard):
                found.append(left(one.at, one.due))
        return self._joined(found, every=True)

    def _from_now_on(self, what: Occurs, since: int) -> int:
        """What a policy makes of a response, triggered so many seconds ago, that has not occurred up to now."""
        has_time = what.end is None or what.end > max(since, (what.start or 0) - 1)
        if what.negated:
            if not has_time:
                return self._true
            spared = [] if what.covers(since + 1) else [self._next[what.event]]
            return self._joined([-self._does(what), *spared], every=False)
        return self._does(what) if has_time else -self._true

    def _unprepared(self, happened: Set[str]) -> int:
        """A literal that implies that a policy does nothing before which something has to come that has not."""
        return self._joined(
            [
                -self._done[law.right]
                for law in self._laws
                if isinstance(law, EventRelation) and law.relation == "happenBefore" and law.left not in happened
            ],
            every=True,
        )

    @cached_property
    def _suits_all(self) -> int:
        """A literal that implies that a policy suits every history."""
        found = [self._unprepared(frozenset())]
        for rule in self._rules.values():
            for demand in self._program.demands(rule):
                every = list(occurrences(demand))
                ends = {bound for what in every for bound in (what.start, what.end) if bound is not None}
                for since in sorted({0, *(bound - one for bound in ends for one in (0, 1) if bound >= one)}):
                    ways = ways_of(demand)
                    if ways is None:
                        found.append(self._surely(demand, since))
                    else:
                        found += (self._surely_one(way, since) for way in ways)
        return self._joined(found, every=True)

    def _surely_one(self, way: tuple[Occurs, ...], since: int) -> int:
        """As `_surely`, of several responses of which one has to be kept."""
        left = [what for what in way if what.end is None or what.end > since]
        if any(not what.negated for what in left):
            return self._joined([self._surely(what, since) for what in left], every=False)
        # One that is not broken so far is kept for good.
        return self._joined([-self._does(what) for what in left], every=True)

    def _surely(self, demand: Demand, since: int) -> int:
        """A literal that implies that a policy meets a demand of so many seconds ago, whatever has happened since."""
        if isinstance(demand, int):
            return demand
        if isinstance(demand, Occurs):
            if demand.negated and (demand.start is None or demand.start <= since):
                return -self._true
            return self._from_now_on(demand, since)
        return self._joined([self._surely(part, since) for part in demand.parts], isinstance(demand, Every))


def can_come_late(program: Program, event: str) -> bool:
    """Whether an event can be done after all else that a trace has, whatever that is."""
    events = {event}
    for law in program.laws:
        # These may demand something of any instant.
        if isinstance(law, (Lasting, Assume, Never)) or (isinstance(law, Effect) and law.relation == "causation"):
            events.update(events_of(law))
    rules: dict[str, Rule] = {}
    ahead = sorted(events)
    while ahead:
        one = ahead.pop()
        fresh = set(program.bound.get(one, ()))
        for rule in program.by_trigger.get(one, ()):
            rules[rule.label] = rule
            fresh.update(response.name for response in responses_of(rule))
        ahead += fresh - events
        events |= fresh
    return Policies(program, rules, events).has_late(event)


def _kept(instant: Instant, law: Law) -> Iterator[list[int]]:
    """Clauses that imply that a law holds at an instant to come, whichever of its events occur there; but for what has
    to have happened before. What a law causes then occurs at every such instant."""
    if isinstance(law, Lasting):
        yield [instant.literal(law.formula)]
    if isinstance(law, (Assume, Never)):
        # Not all events of the policy need occur at once.
        yield from ([-instant.event(event)] for event in events_of(law))
    yield from clauses_at(instant, law)
