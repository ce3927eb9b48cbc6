"""Seconds that an event can have to itself, as what may not come with it is not done in vain."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING, NamedTuple

from sleec_runtime.model import Rule
from sleec_runtime.model_time import EventRelation
from sleec_verify.timed.program import Program, kept_apart, may_call
from sleec_verify.timed.responses import Occurs, Part

if TYPE_CHECKING:
    from sleec_verify.timed.lean import Lean

_TRIED_SECONDS = (2, 3, 4, 5, 7, 10, 13, 20, 30, 60, 120)
"""Seconds in a row of which an event may have one to itself."""

_MOST_FORBIDDEN = 60
"""Of so many seconds, those at which what forbids an event for a short time may forbid it."""

_MOST_OTHERS = 30
"""Events to which it may matter how the measures are; where there are more, no second is looked for without them."""

_SETTLED = 60
"""Seconds after now from which what is called for before them is over."""


class Alone(NamedTuple):
    """How an event has a second to itself, later than `after` seconds from now: with nothing that laws keep apart from
    it, nor while something that forbids it for a short time does so; and if it `is_measured`, with nothing to which it
    matters how the measures are."""

    is_measured: bool
    after: int


ALONE = tuple(Alone(is_measured, after) for is_measured in (False, True) for after in (0, _SETTLED))


class Spacing:
    """How often events occur in one of the lean ways to go on."""

    def __init__(self, program: Program, lean: Lean) -> None:
        self._program = program
        self._lean = lean
        self._seconds: dict[tuple[str, Alone], int | None] = {}
        self._densities: dict[tuple[str, int, int], int] = {}

    def seconds_for(self, event: str, alone: Alone) -> int | None:
        """Of how many seconds in a row an event has one to itself; None where that is not known."""
        key = event, alone
        if key not in self._seconds:
            self._seconds[key] = None
            self._seconds[key] = self._look_for_seconds(event, alone)
        return self._seconds[key]

    def _look_for_seconds(self, event: str, alone: Alone) -> int | None:
        if alone.is_measured and len(self._program.free.reading) > _MOST_OTHERS:
            return None
        events = sorted(self._program.brought.at_once_with(event))
        laws = ((law, one) for one in events for law in self._program.laws_of_event.get(one, ()))
        others = {other for law, one in laws for other in kept_apart(law, one)}
        if others.intersection(events):
            return None
        if alone.is_measured:
            others |= {*self._program.free.reading}.difference(events)
        forbidding = [
            (rule.trigger, _length(part.what))
            for one in events
            for rule, part in self._lean.forbidding(one)
            if self.is_short(rule, part, alone)
        ]
        if not others and not forbidding:
            return None

        def taken(seconds: int) -> int:
            found = sum(self._density(other, seconds, alone.after) for other in others)
            for trigger, length in forbidding:
                found += self._density(trigger, seconds + length - 1, alone.after) * length
            return found

        return next((seconds for seconds in _TRIED_SECONDS if taken(seconds) < seconds), None)

    def is_short(self, rule: Rule, part: Part, alone: Alone) -> bool:
        """Whether what forbids an event at times later than some seconds from now leaves much room."""
        if part.what.end is None or self._lean.called_until(rule.trigger, False) <= 0:
            return False
        return self._density(rule.trigger, _TRIED_SECONDS[-1], alone.after) * _length(part.what) <= _MOST_FORBIDDEN

    def _density(self, event: str, seconds: int, after: int) -> int:
        """At how many of so many seconds in a row, all later than `after` seconds from now, a lean way to go on may
        have an event at most."""
        if self._lean.called_until(event, False) <= after:
            return 0
        key = event, seconds, after
        known = self._densities.get(key)
        if known is None:
            self._densities[key] = seconds
            count = self._lean.deeper(lambda: self._count(event, seconds, after))
            known = self._densities[key] = int(min(seconds, count))
        return known

    def _count(self, event: str, seconds: int, after: int) -> float:
        called = 0
        shortest = inf
        with_it = []
        for rule in self._program.obliging.get(event, ()):
            for part in self._lean.parts(rule):
                what = part.what
                if what.event != event or what.negated or self._lean.until(rule, part, False) <= after:
                    continue
                if what.start is None:
                    return inf
                if what.start == what.end == 0:
                    with_it.append(rule.trigger)
                else:
                    called = 1
                    shortest = min(shortest, inf if what.end is None else what.end - what.start)
        # As nothing is done in vain, each time that one is done there is a window with none else in it, which is
        # between the one before and the one after: two in a stretch of one window and a second.
        times: float = called * 2 * max(1, -(-seconds // (shortest + 2)))
        for law in self._program.laws_of_event.get(event, ()):
            if event in may_call(law):
                if not isinstance(law, EventRelation):
                    return inf
                if law.relation == "happenBefore":
                    times += 1
                else:
                    with_it += {law.left, law.right} - {event}
        return times + sum(self._density(other, seconds, after) for other in with_it)


def _length(what: Occurs) -> int:
    """The number of seconds in a window that ends."""
    assert what.end is not None, "a window without end has no length"
    return max(what.end - (what.start or 0) + 1, 0)
