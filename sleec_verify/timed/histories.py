"""The search for a history that cannot be continued, with some number of instants before now.

"There is a history that no continuation mends" alternates quantifiers. The history is searched for among the traces
that keep everything but the rule's demand of now, so the rule matters: without it there is a way to go on. It must also
defeat each of a list of *plans*. A plan is a way to go on that depends on the history as little as possible: events
added now, which bring with them all that is due at once, and instants later, at distances from those of the history.
The list begins with the plan to do only what is due at once. Each history found is tried: if it can be continued, how
is a plan that the next history must defeat as well; if not, it is the conflict.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set
from functools import cached_property
from typing import NamedTuple

from sleec_runtime.model import Rule
from sleec_runtime.model_time import EventRelation
from sleec_verify.solver import Undecided
from sleec_verify.timed.conflict_cone import Cone
from sleec_verify.timed.instant import Fixed
from sleec_verify.timed.plans import Later, Plan, Plans, at_once
from sleec_verify.timed.policies import Policies
from sleec_verify.timed.policy import Style
from sleec_verify.timed.program import Program
from sleec_verify.timed.responses import Demand, Every, Occurs
from sleec_verify.timed.unfolding import MOST, MOST_CLAUSES, PATIENCE, Unfolding
from sleec_verify.timed.unseen import Unseen

MOST_LATER = 24
"""Instants that may be added to a history, for what its instants before now call for."""

MOST_PLANS = 200

MOST_CLAUSES_EACH = 400
"""As many clauses are for each instant of a long history."""

_LONG_SINCE = 10**9
"""The time now, where seconds are tried one by one: there is room for what is before all of them."""


class Tried(NamedTuple):
    """What a search looks through: the histories with a number of instants before now, at any times; or with instants
    at some of the times that are so many `seconds` before now as well, the first first; or, `in_part`, with as many
    instants at most that are part of a history, where all that can have come about at the others may have.

    `from_now`, only plans that are reckoned from now count, and no more of them than these instants are enough for:
    then there is no other history either. Policies are of a `style`."""

    instants: int
    in_part: bool = False
    seconds: Sequence[int] = ()
    from_now: bool = False
    style: Style = "plain"


class Search:
    """The search for a history that `rule`, triggered now, leaves without a way to go on."""

    def __init__(self, program: Program, rule: Rule, cone: Cone, tried: Tried) -> None:
        instants, in_part, seconds, self._from_now, self._style = tried
        self.program = program
        self.cone = cone
        self.rule = rule
        self._instants = instants
        # Seconds that are known are little work each.
        patience = PATIENCE if seconds else 1
        self._times = {instants + n: _LONG_SINCE - ago for n, ago in enumerate((*seconds, 0))} if seconds else {}
        self.outer = Unfolding(
            program,
            impossible=program.impossible(frozenset({rule.label})),
            most=MOST_LATER * patience,
            most_clauses=MOST_CLAUSES * patience,
            in_part=instants + len(seconds) if in_part else 0,
            times=self._times,
        )
        self.true = self.outer.formula.true
        self.add = self.outer.add
        # Histories of fewer instants have been looked at before.
        needed = None if in_part or seconds else self.true
        self.outer.now = self.now = instants + len(seconds)
        self.past = [self.outer.instant(needed) for _ in range(self.now)]
        # Now, the rule need not be kept.
        self.outer.instant(self.true)
        self.outer.spared.add((rule.label, self.now))
        for earlier, later in zip(self.past[:instants], [*self.past[1:], self.now]):
            # Which of them is which makes no difference.
            self.add([self.outer.times.before(earlier, later)])
            if later < instants:
                self.add([-self.outer.instants[earlier].used, self.outer.instants[later].used])
        here = self.outer.instants[self.now]
        self.given = {event: self.outer.formula.fresh() for event in sorted(cone.events)}
        for name, given in self.given.items():
            self.add([-given, here.event(name)])
        self.add([self.given[rule.trigger]])
        self.plans = Plans(self.outer, cone, self.past, self.now, self.given)
        self._before = {
            law.left
            for law in program.laws
            if isinstance(law, EventRelation) and law.relation == "happenBefore" and law.right in cone.events
        }
        clauses = self.plans.deciding(rule)
        self.add([literal for _, literal in clauses])
        for place, ((clause, literal), demands) in enumerate(zip(clauses, program.demands_of_clauses(rule))):
            if clause.obligations:
                self.add([-literal, self._hopeful(self.outer.due(self.now, clause.obligations))])
            # What goes on without the rule's demand of now breaks it, and not only what could be done besides.
            at_stake = tuple(
                one
                for one, demand in zip(clause.obligations, demands)
                if not program.free.is_free_now(demand, rule, place, thorough=False)
            )
            self.add([-literal, self.outer.demand(self.now, self.outer.due(self.now, at_stake, kept=False))])
        self.plans.defeat(Plan(frozenset()))

    @cached_property
    def _policies(self) -> Policies:
        return Policies(self.program, self.cone.rules, self.cone.events, self.program.impossible())

    def _hopeful(self, demand: Demand) -> int:
        """A literal that implies that the events that are given do not break a demand of now."""
        if isinstance(demand, int):
            return demand
        if isinstance(demand, Occurs):
            at_once = (demand.start is None or demand.start <= 0) and (demand.end is None or demand.end >= 0)
            return -self.given[demand.event] if demand.negated and at_once else self.true
        parts = [self._hopeful(part) for part in demand.parts]
        if isinstance(demand, Every):
            return self.outer.formula.every(parts) if parts else self.true
        return self.outer.formula.any_of(parts) if parts else -self.true

    # Histories ------------------------------------------------------------------------------------------------

    def find(self) -> tuple[Fixed, ...] | None:
        """A history that cannot be continued, or None if every one can."""
        plans = {Plan(frozenset())}
        faults = 1
        # What the history leaves to be done later is taken on trust, as most histories can be continued and show how.
        while self.outer.trusting():
            clauses = self.plans.loops()
            if clauses:
                self.outer.formula.clauses += clauses
                continue
            beginning = self._beginning()
            unseen = self._unseen()
            inner = self._going_on(beginning, unseen)
            if inner is None:
                if self._after(beginning, unseen, self.rule).ask():
                    return beginning
                # It was lost before the rule came to it. To look for the instants that matter takes as many questions.
                self.outer.grow(self._lost(beginning, unseen) if self._from_now else None)
                continue
            plan = next((plan for plan in self._ways(inner, len(beginning) - 1, unseen) if plan not in plans), None)
            if self._from_now and plan is not None:
                faults += 1 if plan.policy is None else self._policies.faults(plan.policy)
            if plan is None or len(plans) >= MOST_PLANS or (self._from_now and faults > self._instants):
                raise Undecided(f"no answer after {len(plans)} ways to go on")
            plans.add(plan)
            self.plans.defeat(plan)
        return None

    def _lost(self, beginning: tuple[Fixed, ...], unseen: Mapping[Unseen, bool]) -> set[int]:
        """A minimal set of instants whose demands leave a history without a way to go on, whatever the rule demands."""
        spared = {(self.rule.label, len(beginning) - 1)}
        kept = set()
        for place, instant in enumerate(beginning):
            triggered = (rule for event in instant.events for rule in self.program.by_trigger.get(event, ()))
            demands = {(rule.label, place) for rule in triggered}
            inner = self._after(beginning, unseen)
            inner.spared |= spared | demands
            try:
                goes_on = inner.ask()
            except Undecided:
                goes_on = True
            if goes_on:
                kept.add(self._numbers[place])
            else:
                spared |= demands
        return kept

    def _going_on(self, beginning: tuple[Fixed, ...], unseen: Mapping[Unseen, bool]) -> Unfolding | None:
        """How a history can be continued, if it can: where that is possible, by doing now what has to come before
        something else."""
        place = len(beginning) - 1
        happened = {event for fixed in beginning for event in fixed.events}
        happened |= {event for event in self._before if unseen.get(Unseen.before(place, event))}
        if self._before - happened:
            inner = self._after(beginning, unseen)
            now = inner.instants[place]
            try:
                if inner.ask(*(now.event(event) for event in sorted(self._before - happened))):
                    return inner
            except Undecided:
                pass
        inner = self._after(beginning, unseen)
        return inner if inner.ask() else None

    def _after(
        self, beginning: tuple[Fixed, ...], unseen: Mapping[Unseen, bool], spared: Rule | None = None
    ) -> Unfolding:
        return after(self.program, beginning, spared, unseen if self.outer.left_out.are_some else None)

    def _beginning(self) -> tuple[Fixed, ...]:
        outer = self.outer
        schedule, _ = outer.schedule()
        self._numbers = [number for number in (*self.past, self.now) if outer.true(outer.instants[number].used)]
        found = []
        for number in self._numbers:
            events = outer.happening(number)
            if number == self.now:
                events = frozenset(event for event, literal in self.given.items() if outer.true(literal))
            found.append(Fixed(schedule[number], events, outer.values(number), number != self.now))
        return tuple(found)

    def _unseen(self) -> dict[Unseen, bool]:
        """What came about, in the model, at instants that are left out."""
        place = {number: place for place, number in enumerate(self._numbers)}
        return {
            key._replace(at=place[key.at]): self.outer.true(literal)
            for key, literal in self.outer.left_out.literals.items()
            if key.at in place
        }

    def _ways(self, inner: Unfolding, now: int, unseen: Mapping[Unseen, bool]) -> Iterator[Plan]:
        """How the history just tried can be continued, by as little of it as can be: by a policy, if one suits it."""
        if self._style != "plain":
            self._do_less(inner, now)
        policy = self._policies.suiting(inner, now, unseen, self._style)
        if policy is not None:
            by_policy = self._policies.last_chances(policy, inner, now, unseen)
            yield Plan(self._added(inner, now, by_policy), policy=policy)
        times, waits = inner.schedule()
        later = []
        for number in inner.used():
            if number > now:
                at, wait = (now, times[number] - times[now]) if self._from_now else (number, 0)
                while at > now:
                    at, more = waits[at]
                    wait += more
                values = tuple(sorted(inner.values(number).items()))
                number_before = self._numbers[at]
                if number_before in self._times:
                    # All that are known move together.
                    wait -= self._times[self.now] - self._times[number_before]
                    number_before = self.now
                later.append(Later(number_before, wait, inner.happening(number), values))
        yield Plan(self._added(inner, now), tuple(later))

    def _do_less(self, inner: Unfolding, now: int) -> None:
        """Leave a trace in which less is done now of what could be done later as well, so that fewer plans differ."""
        not_done: list[int] = []
        for event in sorted(self._added(inner, now)):
            event_now = inner.instants[now].event(event)
            if inner.true(event_now) and inner.ask(*not_done, -event_now):
                not_done.append(-event_now)
            else:
                inner.ask(*not_done)

    def _added(self, inner: Unfolding, now: int, by_policy: Set[str] = frozenset()) -> frozenset[str]:
        """The events of now in a trace that are neither given, nor done by a policy, nor due at once by these."""
        forced = {event for event, literal in self.given.items() if self.outer.true(literal)} | by_policy
        due = [
            (one.rule.trigger, event)
            for one in inner.decided
            if one.at == now and one.rule.label in self.cone.rules and inner.true(one.guard)
            for event in at_once(one.due)
        ]
        grew = True
        while grew:
            fresh = {event for trigger, event in due if trigger in forced}
            grew = not fresh <= forced
            forced |= fresh
        return frozenset((inner.happening(now) - forced) & self.given.keys())


def after(
    program: Program,
    history: tuple[Fixed, ...],
    spared: Rule | None = None,
    unseen: Mapping[Unseen, bool] | None = None,
) -> Unfolding:
    """The traces that a history can be continued to. If it is a part of one, what came about at the instants that it
    leaves out is `unseen`."""
    without = frozenset() if spared is None else frozenset({spared.label})
    unfolding = Unfolding(
        program,
        beginning=history,
        impossible=program.impossible(without),
        most=max(MOST, len(history)),
        most_clauses=max(MOST_CLAUSES, MOST_CLAUSES_EACH * len(history)),
        in_part=0 if unseen is None else len(history) - 1,
        unseen=unseen,
    )
    if spared is not None:
        unfolding.spared.add((spared.label, len(history) - 1))
    return unfolding
