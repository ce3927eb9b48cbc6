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

from collections.abc import Callable, Sequence
from math import inf
from typing import TYPE_CHECKING

from sleec_runtime.model import Rule
from sleec_runtime.model_time import Effect, EventRelation
from sleec_verify.solver import Undecided
from sleec_verify.timed.program import Law, Program, kept_apart, may_call, together
from sleec_verify.timed.responses import Occurs, Part, ways_of

if TYPE_CHECKING:
    from sleec_verify.timed.brought import Brought

_DEEPEST = 40
"""Steps from one time to another that it is derived from; what takes more is not known."""


class Lean:
    """The lean ways to go on with a program, where none of the events `absent` occurs in the window given with it."""

    def __init__(self, program: Program, absent: Sequence[Occurs] = ()) -> None:
        self._program = program
        self._absent = {what.event: what for what in absent if not what.negated}
        self._plain: dict[tuple[str, bool], float] = {}
        self._latest: dict[tuple[str, bool], float] = {}
        self._blocked: dict[tuple[str, bool], float] = {}
        self._depth = 0

    @property
    def _brought(self) -> Brought:
        return self._program.brought

    def can_meet(self, what: Occurs, second: float = 0) -> bool:
        """Whether a response that is called for so many seconds after now can be met: by doing it at its last second,
        or, if it forbids something, as nothing needs that."""
        return second > self._unmet_until(what, second == inf)

    # When an event is needed ----------------------------------------------------------------------------------

    def latest(self, event: str, late: bool) -> float:
        """The last second after now at which a lean way to go on may have an event; infinity if that is not known."""
        key = event, late
        known = self._latest.get(key)
        if known is None:
            self._latest[key] = self._plainly(event, late)
            known = self._latest[key] = self._deeper(lambda: self._look_for_latest(event, late, plain=False))
        return known

    def _plainly(self, event: str, late: bool) -> float:
        """As `latest`, if what is called for may be done at any of the times at which it may be."""
        key = event, late
        known = self._plain.get(key)
        if known is None:
            self._plain[key] = inf
            known = self._plain[key] = self._deeper(lambda: self._look_for_latest(event, late, plain=True))
        return known

    def _look_for_latest(self, event: str, late: bool, plain: bool) -> float:
        program, until = self._program, self._last_of if plain else self._soonest
        times = [0.0]
        for rule in program.obliging.get(event, ()):
            for part in program.parts(rule):
                if part.what.event == event and not part.what.negated:
                    times.append(until(rule, part, late))
        for law in program.laws_of_event.get(event, ()):
            if event in may_call(law):
                if not isinstance(law, EventRelation):
                    return inf
                other = law.right if event == law.left else law.left
                needed = self._plainly(other, late) if plain else self.latest(other, late)
                if law.relation == "happenBefore" and not plain:
                    needed = min(needed, max(self.blocked(event, late) + 1, 0))
                times.append(needed)
        latest = max(times)
        gap = self._absent.get(event)
        if gap is not None and latest <= (inf if gap.end is None else gap.end):
            return (gap.start or 0) - 1
        return latest

    def _last_of(self, rule: Rule, part: Part, late: bool) -> float:
        """When it is called for at last, if its rule may be triggered as long as its trigger may be needed."""
        if part.what.end is None:
            return self._without_end(part.what, late)
        return self._plainly(rule.trigger, late) + part.what.end

    def _soonest(self, rule: Rule, part: Part, late: bool) -> float:
        """When it is done for all who have called for it."""
        last = self._until(rule, part, late)
        if last < 0:
            return last
        what = part.what
        opens = self.latest(rule.trigger, late) + (what.start or 0)
        return min(last, max(self.blocked(what.event, late) + 1, opens))

    def _until(self, rule: Rule, part: Part, late: bool) -> float:
        """When the window of a part of what a rule demands ends at last."""
        what, instead = part
        if what.end is None:
            return self._without_end(what, late)
        last = self.latest(rule.trigger, late) + what.end
        if instead is None or instead.end is None or instead.is_empty:
            return last
        # As long as there is room for what may be done instead, that is done at its last second.
        return min(last, self.blocked(instead.event, late) + what.end - instead.end)

    def _without_end(self, what: Occurs, late: bool) -> float:
        """As `_until`: before now, if it is done after all else."""
        return -1 if not what.negated and not late and self._brought.comes_late(what.event) else inf

    # When an event can be done --------------------------------------------------------------------------------

    def blocked(self, event: str, late: bool) -> float:
        """The last second after now at which an event may not be added to a lean way to go on, with all that it calls
        for in turn; before now, if it can be done at any time."""
        key = event, late
        known = self._blocked.get(key)
        if known is None:
            self._blocked[key] = inf
            known = self._blocked[key] = self._deeper(lambda: self._look_for_room(event, late))
        return known

    def _look_for_room(self, event: str, late: bool) -> float:
        program = self._program
        if self._brought.binds_any_instant:
            return inf
        times = [-1.0, self.forbidden_until(event, late)]
        for law in program.laws_of_event.get(event, ()):
            times.append(self.blocked_by(law, event, late))
        return max(*times, min(self._demanding_until(event, late), self.calm_after(event, late)))

    def _demanding_until(self, event: str, late: bool) -> float:
        """The last second after now at which something that an event calls for may not be met."""
        try:
            demands = [d for rule in self._program.by_trigger.get(event, ()) for d in self._program.demands(rule)]
        except Undecided:
            return inf
        times = [-1.0]
        for demand in demands:
            ways = ways_of(demand)
            if ways is None:
                return inf
            for way in ways:
                if not self._brought.is_free_way(way):
                    times.append(min(self._unmet_until(what, late) for what in way))
        return max(times)

    def calm_after(self, event: str, late: bool) -> float:
        """The last second after now at which the measures may not be such that an event calls for nothing."""
        if event not in self._brought.reading or not self._brought.has_measures(event, calm=True):
            return inf
        return max(0.0, self._measured_until(event, late))

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
        return self.blocked(what.event, late) - what.end

    def forbidden_until(self, event: str, late: bool) -> float:
        """The last second after now at which a rule may forbid an event."""
        return max(
            (
                self._until(rule, part, late)
                for rule in self._program.forbidding.get(event, ())
                for part in self._program.parts(rule)
                if part.what.event == event and part.what.negated
            ),
            default=-1.0,
        )

    def blocked_by(self, law: Law, event: str, late: bool) -> float:
        """The last second after now at which a law that speaks of an event may not let it be added."""
        if isinstance(law, Effect):
            return max(0.0, self._measured_until(event, late)) if self._brought.has_measures(event) else inf
        if isinstance(law, EventRelation) and law.relation == "happenBefore":
            return self.blocked(law.left, late) + 1 if event == law.right else -1
        others = kept_apart(law, event)
        if event in others:
            return inf
        times = [-1.0, *(self.latest(other, late) for other in sorted(others))]
        times += (self.blocked(other, late) for one, other in together(law) if one == event)
        return max(times)

    def _measured_until(self, event: str, late: bool) -> float:
        """The last second after now at which it may matter to some other event how the measures are."""
        others = (other for other in self._brought.reading if other != event)
        return max((self.latest(other, late) for other in others), default=-1.0)

    def _deeper(self, look: Callable[[], float]) -> float:
        if self._depth >= _DEEPEST:
            return inf
        self._depth += 1
        try:
            return look()
        finally:
            self._depth -= 1
