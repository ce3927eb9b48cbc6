"""Which policies (`sleec_verify.timed.policy`) rules and laws allow, and which histories they suit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set
from functools import cached_property

from sleec_runtime.model import Assume, Never, Rule
from sleec_runtime.model_time import Effect, EventRelation, Lasting
from sleec_verify.solver import MiniSat, Undecided
from sleec_verify.timed.instant import Formula, Instant
from sleec_verify.timed.laws import clauses_at
from sleec_verify.timed.needs import Decided
from sleec_verify.timed.policy import Policy, Style, ruled_out
from sleec_verify.timed.program import Law, Program, comes_back, events_of, excluding, law_name, responses_of, together
from sleec_verify.timed.responses import Demand, Every, Occurs, certain, last_second, occurrences, ways_of
from sleec_verify.timed.unfolding import Unfolding
from sleec_verify.timed.unseen import Unseen


class Policies:
    """The closed policies of some `rules` and the laws of some `events`, without those that are `impossible`."""

    def __init__(
        self, program: Program, rules: Mapping[str, Rule], events: set[str], impossible: frozenset[str] = frozenset()
    ) -> None:
        self._program = program
        self._rules = rules
        self._laws = program.laws_among(events)
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
        self._over = {law_name(law): self._formula.fresh() for law in self._laws if isinstance(law, Lasting)}
        # What decides at an instant to come that an event is called for.
        self._brings: dict[str, list[int]] = {event: [] for event in names}
        self._waiting = {event: self._formula.fresh() for event in names}
        self._no_more = {event: self._formula.fresh() for event in names}
        for instant in self._instants:
            self._close(instant)
        self._next: dict[str, int] = {}
        self._first: dict[str, int] = {}
        self._last: dict[str, int] = {}
        self._causes: dict[str, list[int]] = {}
        for event in names:
            self._times_of(event)

    def suiting(
        self, inner: Unfolding, now: int, unseen: Mapping[Unseen, bool], style: Style = "plain"
    ) -> Policy | None:
        """A closed policy by which all is met that the instants up to `now` of a trace leave to be done; None if there
        is none. One that suits every history, if there is such a one; else one of a `style`."""
        left, plain = self._left(inner, now, unseen), self._plain
        for assumed in ([self._suits_all, plain, left], [plain, left], [left]):
            found = self._solve(assumed)
            if found is not None and self._ends(found.events):
                if self._suits_all in assumed:
                    return found
                if style == "patient":
                    return self._waiting_more(found, left)
                return self._doing_more(found, assumed) if style == "busy" else found
        return None

    def faults(self, policy: Policy) -> int:
        """How many instants before now are enough to show that a policy does not suit a history: the one that triggered
        a response, and where times depend on the history, one that stands in its way for each event that may be due by
        it."""
        may_come = self._program.brought.may_come

        def may_be_due(event: str) -> bool:
            return any(may_come(awaited, event) for awaited in policy.awaited)

        def most(demand: Demand) -> int:
            if isinstance(demand, int):
                return 0
            if isinstance(demand, Occurs):
                return int(may_be_due(demand.event))
            parts = [0, *map(most, demand.parts)]
            return max(parts) if isinstance(demand, Every) else sum(parts)

        demanded = (most(demand) for rule in self._rules.values() for demand in self._program.demands(rule))
        # Where a law speaks of several events, each may be due now by an instant of its own.
        together = (sum(map(may_be_due, events_of(law))) for law in self._laws)
        return max(1 + max(demanded, default=0), *together, 1)

    def last_chances(self, policy: Policy, inner: Unfolding, now: int, unseen: Mapping[Unseen, bool]) -> frozenset[str]:
        """The events that a policy does now, as it is the last time at which that can be done."""
        times, _ = inner.schedule()
        before = {number: inner.happening(number) for number in inner.used() if number < now}
        return frozenset(
            what.event
            for one in self._decided(inner, now)
            for what in certain(one.due)
            if one.at < now
            and what.event in policy.awaited
            and not what.negated
            and what.end == times[now] - times[one.at]
            and not _occurred(one.at, what, before, times, unseen)
        )

    def _decided(self, inner: Unfolding, now: int) -> list[Decided]:
        """What the rules demand of the instants up to `now` of a trace."""
        return [
            one for one in inner.decided if one.at <= now and one.rule.label in self._rules and inner.true(one.guard)
        ]

    @cached_property
    def _called(self) -> frozenset[str]:
        """The events that any rule calls for."""
        windows = (what for rule in self._rules.values() for what in self._program.windows(rule))
        return frozenset(what.event for what in windows if not what.negated)

    def _doing_more(self, policy: Policy, assumed: list[int]) -> Policy:
        """A policy that suits the same history, by which more is done if it is called for, so that it suits others."""
        assumed = [*assumed, *(self._soon[event] for event in policy.soon)]
        for event in sorted(self._called - policy.events):
            found = self._solve([*assumed, self._soon[event]])
            if found is not None and policy.soon <= found.soon and self._ends(found.events):
                assumed.append(self._soon[event])
                policy = found
        return policy

    def _waiting_more(self, policy: Policy, left: int) -> Policy:
        """A policy that suits the same history, by which all is done that can wait, so that it suits many others."""
        assumed = [left]
        for event in sorted(self._called - policy.next):
            found = self._solve([*assumed, self._waiting[event]])
            if found is not None and self._ends(found.events):
                assumed.append(self._waiting[event])
                policy = found
        return policy

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
        found = self._solve(
            [self._instants[1].event(event), self._unprepared(frozenset()), *for_ever, *self._none_over]
        )
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
                soon, done = self._true_of(self._soon), self._true_of(self._done)
                kinds = (self._next, self._first, self._last, self._waiting, self._over)
                return Policy(soon, done - soon, *map(self._true_of, kinds))
            clauses += refused

    def _true_of(self, literals: Mapping[str, int]) -> frozenset[str]:
        return frozenset(event for event, literal in literals.items() if self._solver.holds(literal))

    def _ends(self, policy: frozenset[str]) -> bool:
        """Whether what the events of the policy found last call for, by rules and laws, never comes back to them."""
        caused = [event for event, causes in self._causes.items() if any(map(self._solver.holds, causes))]
        if self._program.is_acyclic and not caused:
            return True
        # What a measure causes comes with all that is done where it holds.
        at_once = [(event, other) for event in policy for other in caused]
        later: list[tuple[str, str]] = []
        for rule in self._rules.values():
            for what in self._program.windows(rule):
                if not what.negated and {rule.trigger, what.event} <= policy:
                    (at_once if what.start == what.end == 0 else later).append((rule.trigger, what.event))
        for law in self._laws:
            at_once += together(law)
        return not comes_back(later, [pair for pair in at_once if policy.issuperset(pair)])

    # What a policy has to keep of itself ----------------------------------------------------------------------

    def _close(self, instant: Instant) -> None:
        """Only policies that meet what an instant to come calls for, whichever of its events occur there."""
        reading = self._program.ruleset.reading
        clauses = self._formula.clauses
        for rule in self._rules.values():
            for clause, guard in zip(rule.clauses(), instant.guards(rule, reading)):
                if clause.obligations:
                    due = self._program.responses.of(clause.obligations, lambda c: instant.chain(c, reading))
                    clauses.append([-guard, self._met(instant, due, rule.trigger)])
                    for event in {what.event for what in occurrences(due) if not what.negated}:
                        self._brings[event].append(guard)
        for law in self._laws:
            if isinstance(law, Lasting):
                over = self._over[law_name(law)]
                clauses += [instant.literal(law.formula), over], [-over, -self._done[law.event]]
            elif instant is self._instants[0]:
                clauses += self._apart(law)
            else:
                clauses += _kept(instant, law)

    def _apart(self, law: Law) -> Iterator[list[int]]:
        """As `_kept`, of what is done soon: of two events that exclude each other, one may wait for the other."""
        pairs = list(excluding(law))
        if not pairs:
            yield from _kept(self._instants[0], law)
        for left, right in pairs:
            waits = (self._waits_for(one, other) for one, other in ((left, right), (right, left)) if left != right)
            yield [-self._soon[left], -self._soon[right], *waits]

    def _waits_for(self, event: str, other: str) -> int:
        """A literal that implies that a policy does one event after all that the history calls for of another one, for
        which nothing else calls."""
        return self._formula.every([self._waiting[event], self._no_more[other]])

    def _times_of(self, event: str) -> None:
        """Literals that imply that a policy does an event, if at all, in the next second; at the first second that the
        history allows, or the last; after all that the history forbids for some time."""
        opening = 0
        endless = False
        tied: set[str] = set()
        for rule in self._rules.values():
            for what in self._program.windows(rule):
                if what.event == event and not what.negated:
                    opening = max(opening, what.start or 0)
                    endless = endless or what.end is None
        causes = self._causes[event] = []
        for law in self._laws:
            if isinstance(law, Effect) and law.relation == "causation" and law.event == event:
                causes += (instant.literal(law.formula) for instant in self._instants)
            tied.update(*({*pair} - {event} for pair in together(law) if event in pair))
        every, late = self._formula.every, self._instants[1].event(event)
        known = [self._soon[event], -late, *(-self._done[other] for other in sorted(tied)), *(-one for one in causes)]
        # Only the history calls for it.
        not_brought = [*known, *(-guard for guard in self._brings[event])]
        never = -self._true
        self._next[event] = never if opening > 1 else every(not_brought)
        self._first[event] = never if opening <= 1 else every(not_brought)
        others = [-self._next[event], -self._first[event]]
        self._last[event] = never if endless else every([*not_brought, *others])
        self._formula.clauses += ([-self._waiting[event], one] for one in (*known, *others[1:], -self._last[event]))
        self._formula.clauses += ([-self._no_more[event], one] for one in ([never] if endless else not_brought))

    def _met(self, instant: Instant, demand: Demand, trigger: str) -> int:
        """A literal that implies that a policy meets a demand that an event has at an instant to come."""
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
            met = self._formula.every([-self._does(demand), -here])
            if instant is not self._instants[0] or trigger == demand.event:
                return met
            # What waits comes after all that the history calls for of what it forbids.
            return self._formula.any_of([met, self._waits_for(trigger, demand.event)])
        parts = [self._met(instant, part, trigger) for part in demand.parts]
        return self._joined(parts, isinstance(demand, Every))

    @cached_property
    def _rules_out(self) -> dict[str, set[str]]:
        """The events that an event may rule out, when it occurs or later on."""
        return ruled_out(self._program, self._rules.values(), self._laws)

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
        left_out = {key.what for key, came in unseen.items() if came and key == Unseen.before(now, key.what)}
        found = [self._unprepared(left_out.union(*happening.values()))]
        decided = self._decided(inner, now)

        def occurred(at: int, what: Occurs) -> bool:
            return _occurred(at, what, happening, times, unseen)

        # In seconds after now.
        first: dict[str, set[int]] = {}
        last: dict[str, set[int]] = {}
        over: dict[str, int] = {}
        for at, what in ((one.at, what) for one in decided for what in occurrences(one.due)):
            since = times[now] - times[at]
            if what.negated and what.end is not None:
                over[what.event] = max(over.get(what.event, 0), what.end - since)
            elif not what.negated and not occurred(at, what) and _has_time(what, since):
                first.setdefault(what.event, set()).add(max(1, (what.start or 0) - since))
                if what.end is not None:
                    last.setdefault(what.event, set()).add(what.end - since)

        def in_time(event: str, end: int) -> int:
            """A literal that implies that what an event waits for is over before so many seconds after now."""
            if over.get(event, 0) >= end:
                return -self._true
            called = (other for other in sorted(self._rules_out[event]) if max(last.get(other, {0})) >= end)
            return self._formula.every([self._true, *(-self._soon[other] for other in called)])

        def left(at: int, demand: Demand) -> int:
            if isinstance(demand, int):
                return self._true if inner.true(demand) else -self._true
            if isinstance(demand, Occurs):
                if occurred(at, demand):
                    return -self._true if demand.negated else self._true
                since = times[now] - times[at]
                kept = self._from_now_on(demand, since)
                event, end = demand.event, demand.end
                if not demand.negated:
                    if end is None:
                        return kept
                    soon_enough = self._joined([-self._waiting[event], in_time(event, end - since)], every=False)
                    return self._joined([kept, soon_enough], every=True)
                ways = [kept] if end is None else [kept, self._waiting[event]]
                for at_times, literals in ((first, self._first), (last, self._last)):
                    if not any(demand.covers(since + seconds) for seconds in at_times.get(event, ())):
                        ways.append(literals[event])
                return self._joined(ways, every=False)
            return self._joined([left(at, part) for part in demand.parts], isinstance(demand, Every))

        for rule in self._rules.values():
            for what in self._program.windows(rule):
                if not what.negated and what.end is not None:
                    # It may come to be called for in the next second.
                    soon_enough = in_time(what.event, what.end + 1)
                    ways = [-self._waiting[what.event], -self._done[rule.trigger], soon_enough]
                    found.append(self._joined(ways, every=False))

        for one in decided:
            found.append(left(one.at, one.due))
        found += [-over for name, over in self._over.items() if self._lasts(name, times, now, happening, unseen)]
        return self._joined(found, every=True)

    def _lasts(
        self,
        name: str,
        times: Mapping[int, int],
        now: int,
        happening: Mapping[int, Set[str]],
        unseen: Mapping[Unseen, bool],
    ) -> bool:
        """Whether a law may be in force after now, whatever the measures were."""
        law = self._program.law_named[name]
        assert isinstance(law, Lasting)
        ended = {number for number, events in happening.items() if law.end in events and law.end_condition is None}
        return any(
            law.event in events
            and (law.duration is None or times[now] - times[number] < last_second(law.duration))
            and not any(times[end] >= times[number] for end in ended)
            and not unseen.get(Unseen(number, name), False)
            for number, events in happening.items()
        )

    def _from_now_on(self, what: Occurs, since: int) -> int:
        """What a policy makes of a response, triggered so many seconds ago, that has not occurred up to now."""
        has_time = _has_time(what, since)
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
    def _plain(self) -> int:
        """A literal that implies that a policy waits for nothing."""
        kinds = (*self._first.values(), *self._last.values(), *self._waiting.values())
        return self._joined([-literal for literal in kinds], every=True)

    @cached_property
    def _none_over(self) -> list[int]:
        """Literals for a policy that keeps all laws, whichever of them are in force."""
        return [-over for over in self._over.values()]

    @cached_property
    def _suits_all(self) -> int:
        """A literal that implies that a policy suits every history."""
        found = [self._unprepared(frozenset()), *self._none_over]
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


def _occurred(
    at: int,
    what: Occurs,
    happening: Mapping[int, Set[str]],
    times: Mapping[int, int],
    unseen: Mapping[Unseen, bool],
) -> bool:
    """Whether an event occurred in a window around an instant, at those that are `happening` or `unseen`."""
    return unseen.get(Unseen(at, what.event, what.start, what.end), False) or any(
        what.event in events and what.covers(times[number] - times[at]) for number, events in happening.items()
    )


def _has_time(what: Occurs, since: int) -> bool:
    """Whether there is time left after now in a window around so many seconds ago."""
    return what.end is None or what.end > max(since, (what.start or 0) - 1)


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
    if isinstance(law, (Assume, Never)):
        # Not all events of the policy need occur at once.
        yield from ([-instant.event(event)] for event in events_of(law))
    yield from clauses_at(instant, law)
