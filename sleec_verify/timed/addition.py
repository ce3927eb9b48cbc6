"""An event that is added to a lean way to go on (`sleec_verify.timed.lean`), with all that comes of it."""

from __future__ import annotations

from math import inf
from typing import NamedTuple

from sleec_runtime.model_time import Effect, EventRelation
from sleec_verify.solver import Undecided
from sleec_verify.timed.alone import Alone
from sleec_verify.timed.lean import Lean
from sleec_verify.timed.program import Law, Program, kept_apart, together
from sleec_verify.timed.responses import Demand, Occurs, ways_of

MOST_STEPS = 50
"""Events that are tried to be added for one that is."""

_Path = tuple[tuple[int, str, int], ...]
"""The clauses of rules that lead to something: which of the events added triggers it, the rule, and its clause."""


class _Placed(NamedTuple):
    """An event that is added at a time, or may not occur from one time to another, because of the clauses of a path. It
    may need measures of its own."""

    event: str
    start: float
    end: float
    path: _Path
    is_measured: bool = False

    def goes_with(self, other: _Placed) -> bool:
        """Whether one clause of each rule decides for both."""
        mine = {step[:2]: step[2] for step in self.path}
        return all(mine.get(step[:2], step[2]) == step[2] for step in other.path)


def can_be_added(program: Program, lean: Lean, what: Occurs) -> bool:
    """Whether what is called for now, and is absent from the lean ways to go on, can be done at its last second, with
    all that comes of it; or a second before that, where what may not come with it can make way."""
    if what.is_empty or program.brought.binds_any_instant:
        return False
    if what.end is None:
        return Addition(program, lean).works(what.event, inf)
    # There is no other one a second before it or after it.
    sliding = what.end if lean.is_open(what.event, what.end) else what.end - 1
    is_long = sliding >= 2 and sliding > (what.start or 0)
    return (
        Addition(program, lean).works(what.event, what.end)
        or (is_long and Addition(program, lean, slides=True).works(what.event, sliding))
        or any(_has_choice(program, lean, what, what.end, alone) for alone in lean.ways_alone)
    )


def _has_choice(program: Program, lean: Lean, what: Occurs, end: int, alone: Alone) -> bool:
    """Whether what is called for can be done at one of its last seconds, which it has to itself."""
    seconds = lean.spacing.seconds_for(what.event, alone)
    if seconds is None or seconds > end - max(what.start or 0, alone.after + 1) + 1:
        return False
    first = end - seconds + 1
    addition = Addition(program, lean, alone=alone)
    # At a later one, all that comes of it is later by as much.
    return addition.works(what.event, first) and (
        not addition.has_first
        or all(Addition(program, lean, alone=alone).works(what.event, second) for second in range(first + 1, end + 1))
    )


class Addition:
    """One try to add an event; if it `slides`, what a law keeps from it is moved by a second where it can be; if it
    is `alone`, it has the second to itself."""

    def __init__(self, program: Program, lean: Lean, slides: bool = False, alone: Alone | None = None) -> None:
        self._program = program
        self._lean = lean
        self._slides = slides
        self._alone = alone
        self._added: list[_Placed] = []
        self._forbidden: list[_Placed] = []
        self._steps = 0
        self._first = ("", 0.0)
        self.has_first = False
        """Whether anything is added that has to come before something else: at a time of its own."""

    def works(self, event: str, second: float) -> bool:
        """Whether the event can be added so many seconds after now."""
        added, self._first = self._added, (event, second)
        return (
            self._add(event, second, ())
            and not any(_clash(one, other) for one in added for other in self._forbidden)
            and not any(self._exclude(one, other) for one in added for other in added if one is not other)
        )

    def _add(self, event: str, second: float, path: _Path) -> bool:
        program, late, number = self._program, second == inf, len(self._added)
        # Of two that come after all else, the one may come after the other.
        if not late and any(one[:2] == (event, second) and _leads_to(one, path) for one in self._added):
            return True
        self._steps += 1
        alone = self._alone if self._first[1] == second else None
        if self._steps > MOST_STEPS or second <= self._lean.forbidden_until(event, late, alone):
            return False
        own = self._lean.own_clauses(event)
        if own is not None and second <= self._lean.settled_after(event, late, alone is not None and alone.is_measured):
            own = None
        laws = program.laws_of_event.get(event, ())
        needs_measures = own is not None or any(isinstance(law, Effect) for law in laws)
        is_measured = needs_measures and not self._lean.has_steady(second)
        self._added.append(_Placed(event, second, second, path, is_measured))
        if not all(self._let_in(law, event, second, path, alone) for law in laws):
            return False
        try:
            rules = [(rule, program.demands_of_clauses(rule)) for rule in program.by_trigger.get(event, ())]
        except Undecided:
            return False
        return all(
            self._meet(demand, second, (*path, (number, rule.label, clause)))
            for rule, clauses in rules
            for clause, demands in enumerate(clauses)
            for demand in demands
            if (self._lean.decides(rule, clause, second) if own is None else own[rule.label] == clause)
        )

    def _let_in(self, law: Law, event: str, second: float, path: _Path, alone: Alone | None) -> bool:
        """Whether a law lets an event be added, with what the law has come with it, or before it."""
        late = second == inf
        if isinstance(law, EventRelation) and law.relation == "happenBefore":
            if event != law.right or self._lean.has_come(law.left, second):
                return True
            if any(one.event == law.left and one.start < second and _leads_to(one, path) for one in self._added):
                return True
            self.has_first = True
            soonest = max(self._lean.blocked(law.left, late) + 1, 1)
            return self._add(law.left, min(soonest, second - 1), path)
        others = kept_apart(law, event)
        if isinstance(law, Effect) or others:
            if others and event not in others:
                slides = self._slides and self._first == (event, second)
                if alone is not None or (slides and all(self._makes_way(other, event) for other in others)):
                    return True
            return second > self._lean.blocked_by(law, event, late, alone is not None and alone.is_measured)
        return all(self._add(other, second, path) for one, other in together(law) if one == event)

    def _makes_way(self, other: str, event: str) -> bool:
        """Whether an event that a law keeps from one that is absent around the time at which it is added can be moved
        by a second."""
        program = self._program
        if other in program.by_trigger or other in program.forbidding:
            return False
        if any(kept_apart(law, other) != {event} for law in program.laws_of_event[other]):
            return False
        called = (part.what for rule in program.obliging.get(other, ()) for part in program.parts(rule))
        return all(
            what.event != other
            or what.negated
            or (what.start is not None and (what.end is None or what.end > what.start))
            for what in called
        )

    def _meet(self, demand: Demand, second: float, path: _Path) -> bool:
        """Meet a demand of an event that is added."""
        ways = ways_of(demand)
        if ways is None:
            return False
        for way in ways:
            if self._program.free.is_free_way(way):
                continue
            for what in way:
                so_far = len(self._added), len(self._forbidden)
                end = inf if what.end is None else second + what.end
                if what.negated:
                    if self._lean.can_meet(what, second):
                        self._forbidden.append(_Placed(what.event, second + (what.start or 0), end, path))
                        break
                elif not what.is_empty and self._add(what.event, end, path):
                    break
                del self._added[so_far[0] :], self._forbidden[so_far[1] :]
            else:
                return False
        return True

    def _exclude(self, one: _Placed, other: _Placed) -> bool:
        """Whether a law may keep two events that are added from one instant."""
        if one.start != other.start or not one.goes_with(other):
            return False
        if one.is_measured and other.event in self._program.free.reading:
            return True
        laws = self._program.laws_of_event.get(one.event, ())
        return any(other.event in kept_apart(law, one.event) for law in laws)


def _leads_to(added: _Placed, path: _Path) -> bool:
    """Whether an event is added whenever the clauses of a path decide."""
    return path[: len(added.path)] == added.path


def _clash(added: _Placed, forbidden: _Placed) -> bool:
    return (
        added.event == forbidden.event
        and forbidden.start <= added.start <= forbidden.end
        and added.goes_with(forbidden)
    )
