"""Lean ways to go on: what can be done after all that stands in its way.

From any way to go on, a lean one can be had, step by step: what nothing needs is left out; what is called for is done
once, as soon as nothing that may stand in its way is left, for all who have called for it; and of what may be done in
place of something else, only what has to be. So there are times, the same for all histories, after which a lean way to
go on does not have an event any more (`latest`), and after which an event may be added to it with all that follows
(`Lean.blocked`). Each is derived from others; where it comes back to itself, by what is left out alone (`_plainly`).

All times are in seconds after now. Up to some time to come, what can be done after all else is left out as well;
``late`` is asked of all times.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from math import inf
from typing import TYPE_CHECKING, NamedTuple

from sleec_runtime.model import Rule
from sleec_runtime.model_time import Effect, EventRelation
from sleec_verify.solver import Undecided
from sleec_verify.timed.alone import ALONE, Alone, Spacing
from sleec_verify.timed.program import Law, Program, kept_apart, may_call, together
from sleec_verify.timed.responses import Occurs, Part, ways_of

if TYPE_CHECKING:
    from sleec_verify.timed.free import Free
    from sleec_verify.timed.steady import Measured

_DEEPEST = 40
"""Steps from one time to another that it is derived from; what takes more is not known."""

_MOST_LOOKS = 5000
"""Times that are derived for one response; further ones are not known."""

_MOST_READING = 300
"""Events to which it may matter how the measures are; where there are more, it is not looked for when that is."""


class Known(NamedTuple):
    """What is known of all histories and of what comes after, where a rule is asked about, whose trigger is given: the
    events that occur in no trace, and the clauses, by their rules and places, that decide in no trace, or not now.
    Nothing is known where no rule is given."""

    asked: str | None = None
    given: str | None = None
    never: frozenset[str] = frozenset()
    dead: frozenset[tuple[str, int]] = frozenset()
    not_now: frozenset[tuple[str, int]] = frozenset()


class Lean:
    """The lean ways to go on with a program, where none of the events `absent` occurs in the window given with it.

    `standbys` says of rules which of several responses is done wherever it can be, by its place (`Program.parts`). All
    instants later than `since` seconds after now have the measures `steady`, if any are given."""

    def __init__(
        self,
        program: Program,
        known: Known,
        absent: Sequence[Occurs] = (),
        standbys: Mapping[str, int] | None = None,
        steady: Measured | None = None,
        since: float = 0,
    ) -> None:
        self._program = program
        self._asked, self._given, self._never, self._dead, self._not_now = known
        self._steady = None if steady is None else dict(steady.clauses)
        self._since = since
        self._absent = {what.event: what for what in absent if not what.negated}
        self._standbys = standbys or {}
        self.choosing: dict[str, int] = {}
        """The rules with several responses of which it mattered which is done, and how many these are."""
        self._plain: dict[tuple[str, bool], float] = {}
        self._called: dict[tuple[str, bool], float] = {}
        self._blocked: dict[tuple[str, bool, Alone | None], float] = {}
        self._parts: dict[str, list[Part]] = {}
        self._own: dict[str, dict[str, int | None] | None] = {}
        self.spacing = Spacing(program, self)
        self._depth = 0
        self._looks = 0

    @property
    def looked_at(self) -> list[str]:
        """The events that mattered, in the order in which they came up."""
        return [*dict.fromkeys([key[0] for key in self._called] + [key[0] for key in self._blocked])]

    @property
    def _free(self) -> Free:
        return self._program.free

    def can_meet(self, what: Occurs, second: float = 0) -> bool:
        """Whether a response that is called for so many seconds after now can be met: by doing it at its last second,
        or, if it forbids something, as nothing needs that."""
        return second > self._unmet_until(what, second == inf)

    def is_steady(self) -> bool:
        """Whether all that the steady measures ask for can be done, so that the measures may be those."""
        return self.restless_until() <= self._since

    def restless_until(self) -> float:
        """The last second after now at which something that the steady measures ask for may not be done; what is asked
        for with any measures is done anyway."""
        times = [-1.0]
        for label, clause in (self._steady or {}).items():
            rule = self._program.ruleset.by_label[label]
            others = (other for other, _ in enumerate(rule.clauses()) if other != clause)
            if clause is not None and not (rule.guard is None and all(self.is_dead(rule, other) for other in others)):
                times.append(min(self.called_until(rule.trigger, False), self.asks_until(rule, clause)))
        return max(times)

    def decides(self, rule: Rule, clause: int, second: float = inf) -> bool:
        """Whether a clause of a rule may decide at an instant that is added so many seconds after now."""
        if self._steady is None or clause < 0 or not self.has_steady(second):
            return True
        return self._steady.get(rule.label, clause) == clause

    def is_dead(self, rule: Rule, clause: int) -> bool:
        """Whether a clause of a rule decides in no trace."""
        return (rule.label, clause) in self._dead

    def has_come(self, event: str, second: float) -> bool:
        """Whether an event is known to have occurred before so many seconds after now."""
        return event == self._given and second > 0

    def has_steady(self, second: float) -> bool:
        """Whether the measures are the steady ones so many seconds after now."""
        return self._steady is not None and second > self._since

    # When an event is needed ----------------------------------------------------------------------------------

    def latest(self, event: str, late: bool) -> float:
        """The last second after now at which a lean way to go on may have an event; infinity if that is not known."""
        if event in self._never:
            return -inf
        gap = self._absent.get(event)
        is_absent_now = gap is not None and not gap.start
        return max(-1.0 if is_absent_now else 0.0, self.called_until(event, late))

    def called_until(self, event: str, late: bool) -> float:
        """As `latest`, of an event that is done only where something needs it: before now, if nothing does."""
        key = event, late
        known = self._called.get(key)
        if known is None:
            self._called[key] = self._plainly(event, late)
            known = self._called[key] = self.deeper(lambda: self._look_for_latest(event, late, plain=False))
        return known

    def _plainly(self, event: str, late: bool) -> float:
        """As `latest`, if what is called for may be done at any of the times at which it may be."""
        key = event, late
        known = -inf if event in self._never else self._plain.get(key)
        if known is None:
            self._plain[key] = inf
            known = self._plain[key] = self.deeper(lambda: self._look_for_latest(event, late, plain=True))
        return known

    def _look_for_latest(self, event: str, late: bool, plain: bool) -> float:
        program, until = self._program, self._last_of if plain else self._soonest
        # What is given may occur now.
        times = [0.0 if plain else -1.0]
        for rule in program.obliging.get(event, ()):
            for part in self.parts(rule):
                if part.what.event == event and not part.what.negated and not _goes_without(part):
                    times.append(until(rule, part, late))
        for law in program.laws_of_event.get(event, ()):
            if event in may_call(law):
                if not isinstance(law, EventRelation):
                    return inf
                if law.relation == "happenBefore" and event == self._given:
                    continue
                other = law.right if event == law.left else law.left
                if other == event:
                    continue
                needed = self._plainly(other, late) if plain else self.latest(other, late)
                if law.relation == "happenBefore":
                    needed -= 1
                    if not plain:
                        needed = min(needed, max(self.blocked(event, late) + 1, 0))
                times.append(needed)
        latest = max(times)
        gap = self._absent.get(event)
        if gap is not None and latest <= (inf if gap.end is None else gap.end):
            return min(latest, (gap.start or 0) - 1)
        return latest

    def parts(self, rule: Rule) -> list[Part]:
        """What a rule demands, part by part, but for what is met anyway."""
        found = self._parts.get(rule.label)
        if found is None:
            found = self._parts[rule.label] = self._look_for_parts(rule)
        return found

    def _look_for_parts(self, rule: Rule) -> list[Part]:
        found = self._program.parts(rule, self._standbys.get(rule.label))
        if all(part.instead is None for part in found):
            return found
        if self._asked is not None:
            met = self._free.met_anyway(rule, self._asked)
            found = [part for part in found if (part.clause, part.what) not in met]
        if any(part.instead is not None for part in found):
            self.choosing[rule.label] = max(map(len, self._program.ways(rule)))
        return found

    def _last_of(self, rule: Rule, part: Part, late: bool) -> float:
        """When it is called for at last, if its rule may be triggered as long as its trigger may be needed."""
        if part.what.end is None:
            return self._without_end(part.what, late)
        return self._triggered_until(rule, part, self._plainly(rule.trigger, late)) + part.what.end

    def _triggered_until(self, rule: Rule, part: Part, latest: float) -> float:
        """The last second after now at which a part of what a rule demands may come to be called for, if its trigger
        may occur up to `latest`."""
        if self.is_dead(rule, part.clause):
            return -inf
        until = latest if self.decides(rule, part.clause) else min(latest, self._since)
        return -1 if until == 0 and (rule.label, part.clause) in self._not_now else until

    def _soonest(self, rule: Rule, part: Part, late: bool) -> float:
        """When it is done for all who have called for it."""
        what, last = part.what, self.until(rule, part, late)
        if last < 0 or what.start is None:
            return last
        opens = self._triggered_until(rule, part, self.latest(rule.trigger, late)) + what.start
        return min(last, max(self.blocked(what.event, late) + 1, opens))

    def until(self, rule: Rule, part: Part, late: bool) -> float:
        """When the window of a part of what a rule demands ends at last."""
        what, instead, _ = part
        if what.end is None:
            return -inf if self.is_dead(rule, part.clause) else self._without_end(what, late)
        last = self._triggered_until(rule, part, self.latest(rule.trigger, late)) + what.end
        if instead is None or instead.is_empty:
            return last
        if instead.negated:
            # As long as nothing needs what may be left undone instead, that is left undone.
            opens = instead.start or 0
            return min(last, self.latest(instead.event, late or instead.end is None) + what.end - opens)
        if instead.end is None:
            return last
        # As long as there is room for what may be done instead, that is done at its last second.
        return min(last, self._full_until(instead, instead.end, late) + what.end - instead.end)

    def _without_end(self, what: Occurs, late: bool) -> float:
        """As `until`: before now, if it is done after all else."""
        if what.start is None:
            return inf
        return -1 if not what.negated and not late and self._free.comes_late(what.event) else inf

    # When an event can be done --------------------------------------------------------------------------------

    def blocked(self, event: str, late: bool, alone: Alone | None = None) -> float:
        """The last second after now at which an event may not be added to a lean way to go on, with all that it calls
        for in turn; before now, if it can be done at any time; `alone`, if it has its second to itself."""
        key = event, late, alone
        known = inf if event in self._never else self._blocked.get(key)
        if known is None:
            self._blocked[key] = inf
            known = self._blocked[key] = self.deeper(lambda: self._look_for_room(event, late, alone))
        return known

    def _full_until(self, what: Occurs, end: int, late: bool) -> float:
        """The last second after now at which a window may end that has no room for an event: as `blocked`, or less
        where the event has one of the last seconds to itself."""
        blocked = self.blocked(what.event, late)
        for alone in self.ways_alone if not late else ():
            seconds = self.spacing.seconds_for(what.event, alone)
            if seconds is not None and seconds <= end - (what.start or 0) + 1:
                blocked = min(blocked, max(alone.after, self.blocked(what.event, late, alone)) + seconds - 1)
        return blocked

    @property
    def ways_alone(self) -> Iterator[Alone]:
        """The ways to be alone that are worth a try."""
        return (alone for alone in ALONE if self._steady is None or not alone.is_measured)

    def forbidding(self, event: str) -> Iterator[tuple[Rule, Part]]:
        """The parts of what rules demand that forbid an event."""
        for rule in self._program.forbidding.get(event, ()):
            for part in self.parts(rule):
                if part.what.event == event and part.what.negated:
                    yield rule, part

    def is_open(self, event: str, second: float) -> bool:
        """Whether all windows that call for an event are open so many seconds after now: done then, it need not be done
        later."""
        if any(event in may_call(law) for law in self._program.laws_of_event.get(event, ())):
            return False
        return all(
            part.what.start is not None
            and self._triggered_until(rule, part, self.latest(rule.trigger, False)) + part.what.start <= second
            for rule in self._program.obliging.get(event, ())
            for part in self.parts(rule)
            if part.what.event == event and not part.what.negated
        )

    def _look_for_room(self, event: str, late: bool, alone: Alone | None) -> float:
        program, is_measured = self._program, alone is not None and alone.is_measured
        if self._program.brought.binds_any_instant:
            return inf
        times = [-1.0, self.forbidden_until(event, late, alone)]
        if self._steady is not None and event in self._free.reading:
            # Up to then, the measures are as they are.
            times.append(self._since)
        for law in program.laws_of_event.get(event, ()):
            if alone is None or not kept_apart(law, event):
                times.append(self.blocked_by(law, event, late, is_measured))
        asks = self._demanding_until(event, late)
        return max(*times, asks if asks < 0 else min(asks, self.settled_after(event, late, is_measured)))

    def _demanding_until(self, event: str, late: bool) -> float:
        """The last second after now at which something that an event calls for may not be met."""
        return max(
            (
                self.asks_until(rule, clause, late)
                for rule in self._program.by_trigger.get(event, ())
                for clause, _ in enumerate(rule.clauses())
                if self.decides(rule, clause)
            ),
            default=-1.0,
        )

    def asks_until(self, rule: Rule, clause: int, late: bool = False) -> float:
        """The last second after now at which something that a clause of a rule calls for may not be met."""
        try:
            demands = self._program.demands_of_clauses(rule)[clause]
        except Undecided:
            return inf
        times = [-1.0]
        for demand in demands:
            ways = ways_of(demand)
            if ways is None:
                return inf
            for way in ways:
                if not self._free.is_free_way(way):
                    times.append(min(self._unmet_until(what, late) for what in way))
        return max(times)

    def settled_after(self, event: str, late: bool, alone: bool = False) -> float:
        """The last second after now at which an event may not be added with measures by which all that it calls for can
        be met (`own_clauses`); `alone`, if it matters to no other event of that second how they are."""
        own = self.own_clauses(event)
        if own is None:
            return inf
        rules = self._program.ruleset.by_label
        asks = [self.asks_until(rules[label], clause, late) for label, clause in own.items() if clause is not None]
        latest = max(asks, default=-1.0)
        return latest if latest == inf else max(latest, 0, -1.0 if alone else self._measured_until(event, late))

    def own_clauses(self, event: str) -> dict[str, int | None] | None:
        """The clauses of its rules that decide at an instant at which the measures are chosen for an event, by what can
        be met soonest; None if they cannot be chosen for it alone, or nothing depends on them."""
        if event not in self._own:
            self._own[event] = None
            if self._steady is None and event in self._free.reading:
                from sleec_verify.timed.steady import at_an_instant_of

                found = at_an_instant_of(self._program, self, event)
                self._own[event] = None if found is None else dict(found.clauses)
        return self._own[event]

    def _unmet_until(self, what: Occurs, late: bool) -> float:
        """The last second at which a response may not be met by what is triggered then."""
        if what.negated:
            if what.start is None:
                return inf
            return self.latest(what.event, late or what.end is None) - what.start
        if what.is_empty:
            return inf
        if what.end is None:
            return inf if self.blocked(what.event, True) == inf else -1
        return self._full_until(what, what.end, late) - what.end

    def forbidden_until(self, event: str, late: bool, alone: Alone | None = None) -> float:
        """The last second after now at which a rule may forbid an event, or all that there are if it never occurs;
        `alone`, not counting those at which it is not."""
        if event in self._never:
            return inf
        times = [-1.0]
        for rule, part in self.forbidding(event):
            until = self.until(rule, part, late)
            if alone is not None and part.what.end is not None and self.spacing.is_short(rule, part, alone):
                until = min(until, alone.after + part.what.end)
            times.append(until)
        return max(times)

    def blocked_by(self, law: Law, event: str, late: bool, alone: bool = False) -> float:
        """The last second after now at which a law that speaks of an event may not let it be added; `alone`, as
        `settled_after`."""
        if isinstance(law, Effect):
            if self._steady is not None:
                return self._since
            if not self._free.has_measures(event):
                return inf
            return 0 if alone else max(0.0, self._measured_until(event, late))
        if isinstance(law, EventRelation) and law.relation == "happenBefore":
            if law.left == self._given:
                return 0
            return self.blocked(law.left, late) + 1 if event == law.right else -1
        others = kept_apart(law, event)
        if event in others:
            return inf
        times = [-1.0, *(self.latest(other, late) for other in sorted(others))]
        times += (self.blocked(other, late) for one, other in together(law) if one == event != other)
        return max(times)

    def _measured_until(self, event: str, late: bool) -> float:
        """The last second after now at which it may matter to some other event how the measures are."""
        if len(self._free.reading) > _MOST_READING:
            return inf
        others = (other for other in self._free.reading if other != event)
        return max((self.latest(other, late) for other in others), default=-1.0)

    def is_left_out(self, way: Sequence[Occurs]) -> bool:
        """Whether a demand of now, of several responses one, is met where nothing is done that nothing needs: if what
        it forbids is only there where it is given with what triggers the demand, or else where it is done in time."""
        forbidden = next((what for what in way if what.negated), None)
        if forbidden is None or len(way) > 2:
            return False
        last = self.called_until(forbidden.event, forbidden.end is None)
        if len(way) == 1:
            return last < (forbidden.start or 0)
        due = next((what for what in way if not what.negated), None)
        if due is None or due.event != forbidden.event or due.end is None:
            return False
        return (due.start or 0) <= (forbidden.start or 0) and last <= due.end

    def deeper(self, look: Callable[[], float]) -> float:
        """What is derived from other times; infinity, that is not known, where that takes too many steps."""
        self._looks += 1
        if self._depth >= _DEEPEST or (self._absent and self._looks > _MOST_LOOKS):
            return inf
        self._depth += 1
        try:
            return look()
        finally:
            self._depth -= 1


def _goes_without(part: Part) -> bool:
    """Whether the last time at which an event is done is never there for this part of a demand: without it, what comes
    in its place is that it is not done later."""
    what, instead, _ = part
    return (
        instead is not None
        and instead.negated
        and instead.event == what.event
        and what.end is not None
        and (instead.start or 0) >= what.end
    )
