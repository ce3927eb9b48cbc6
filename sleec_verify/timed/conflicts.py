"""Situational conflicts: a history that no rule breaks, in which a rule, triggered now, leaves no way to go on.

A history is searched for with few instants before now first, then with more, as far as more can matter; by the second
where all windows are short; and among those of the same rules with shorter windows. See `sleec_verify.timed.histories`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

from sleec_runtime.model import Rule
from sleec_verify.solver import Undecided
from sleec_verify.timed.conflict_cone import Cone
from sleec_verify.timed.drawn_out import drawn_out, shortened
from sleec_verify.timed.histories import Search, Tried, after
from sleec_verify.timed.instant import Fixed
from sleec_verify.timed.past import Past, past
from sleec_verify.timed.policy import Style
from sleec_verify.timed.program import Program
from sleec_verify.timed.questions import decided, needed
from sleec_verify.timed.timeline import Timeline, excerpt
from sleec_verify.timed.turns import turns

MOST_PAST = 8
"""Instants before now that are tried. Each more takes half as long again."""

FEW = 2
"""Histories with fewer instants before now are tried first: most conflicts need no more."""

MOST_WORK = 100_000
"""Clauses of all tries together after which no further ones are made that could only find a history."""

MOST_PENDING = 12
"""Instants before now that are tried where those that matter only to these are left out."""

MOST_SECONDS = 64
"""Seconds before now that are tried one by one, where histories at any times take too many instants: the last ones, or
those from which what the rule calls for may be forbidden by turns."""

SECONDS_FOR_ONE = 4
"""As many of them are as much work as one instant at any time."""

MOST_DRAWN_OUT = 4
"""Instants before now of a conflict that may be drawn out."""

FEW_PLANS: tuple[tuple[int, Style], ...] = (
    (2, "plain"),
    (3, "patient"),
    (7, "patient"),
    (7, "plain"),
    (7, "busy"),
    (12, "patient"),
    (12, "busy"),
    (12, "plain"),
)
"""Numbers of instants before now with which all histories are tried at once, all plans being reckoned from now: as many
are enough to show that a history defeats these plans (`Policies.faults`). With each, the style of policies: those that
wait take two or more."""


@dataclass(frozen=True)
class History:
    """A history that cannot be continued: its instants up to now, and the rules and laws that stand in the way."""

    instants: tuple[Fixed, ...]
    matter: tuple[str, ...]
    timeline: Timeline


def _partial(needed: Past, by_seconds: bool) -> tuple[list[Tried], list[Tried]]:
    """The searches for parts of histories that are worth a try, and those that are if nothing else helps."""
    one, two, *more = (Tried(instants, True, from_now=True, style=style) for instants, style in FEW_PLANS)
    # To leave out the instants that nothing pending now needs rules out no history.
    pending = [Tried(needed.pending, True)] if needed.pending <= MOST_PENDING else []
    if by_seconds and needed.endless <= MOST_PENDING:
        pending.append(Tried(needed.endless, True, range(needed.reach, 0, -1)))
    pending.sort(key=lambda tried: tried.instants * SECONDS_FOR_ONE + len(tried.seconds))
    return [one, two, *pending[:1]], [*more, *pending[1:]]


def conflict(program: Program, rule: Rule) -> History | None:
    """A history in which `rule`, triggered now, leaves no way to go on, or None if there is none.

    Raises Undecided where more instants could matter than are tried.
    """
    if rule.label in program.tied:
        raise Undecided("conditions that name events, where rules have times, are not analysed yet")
    if program.free.is_all_free_now(rule, thorough=False):
        return None
    found = _Searches(program, rule).find()
    return None if found is None else _shown(program, rule, found)


class _Answer(NamedTuple):
    """That a history cannot be continued, or that each can be."""

    history: tuple[Fixed, ...] | None


class _Searches:
    """What is tried, one after the other, to find a conflict of a rule or that there is none."""

    def __init__(self, program: Program, rule: Rule) -> None:
        self._program = program
        self._rule = rule
        self._cone = Cone(program, rule)
        self._needed = past(program, self._cone.rules.values())
        self._by_seconds = 0 < self._needed.reach <= MOST_SECONDS
        self._early, self._rest = _partial(self._needed, self._by_seconds)
        self._work = 0
        self._looked_at = 0

    def find(self) -> tuple[Fixed, ...] | None:
        try:
            return self._any_times()
        except Undecided as reason:
            if self._program.free.is_all_free_now(self._rule):
                return None
            # Where responses come back to their own trigger, each further try may take as long as the first.
            if not self._program.is_acyclic:
                raise
            answer = self._by_parts(self._rest)
            if answer is not None:
                return answer.history
            # Where few instants were too much work, they are with shorter windows, too.
            if self._looked_at >= FEW and self._of_many is not None:
                return self._of_many
            if not self._by_seconds:
                raise
            return self._each_second(reason)

    def _search(self, tried: Tried) -> tuple[Fixed, ...] | None:
        def ask() -> tuple[Fixed, ...] | None:
            one = Search(self._program, self._rule, self._cone, tried)
            try:
                return one.find()
            finally:
                self._work += one.outer.size

        return decided(self._program, ask, frozenset(), frozenset({self._rule.label}))

    def _by_parts(self, tries: list[Tried]) -> _Answer | None:
        """The answer, where one of the tries shows that all histories can be continued, or finds a part that is a whole
        history; None where that is not known. The tries are used up."""
        while tries:
            try:
                part = self._search(tries.pop(0))
                if part is None:
                    return _Answer(None)
                if _is_conflict(self._program, self._rule, part):
                    return _Answer(self._less(part))
            except Undecided:
                pass
        return None

    def _any_times(self) -> tuple[Fixed, ...] | None:
        most = self._needed.most
        tried = min(most, MOST_PAST)
        for instants in range(tried + 1):
            if instants == FEW:
                # Most conflicts have been found.
                if self._program.free.is_all_free_now(self._rule):
                    return None
                answer = self._by_parts(self._early)
                if answer is not None:
                    return answer.history
            if instants > MOST_DRAWN_OUT and self._program.is_acyclic and self._of_many is not None:
                return self._of_many
            found = self._search(Tried(instants))
            if found is not None:
                return self._less(found)
            self._looked_at = instants
            if self._work > MOST_WORK and most > MOST_PAST:
                # That there is none would not follow from the further ones either.
                tried = instants
                break
        if self._needed.known and most <= tried:
            return None
        answer = (self._by_parts(self._early) if tried < FEW else None) or self._by_parts(self._rest)
        if answer is not None:
            return answer.history
        raise Undecided(f"no conflict with up to {tried} instants before now, and more could matter")

    def _each_second(self, otherwise: Undecided) -> tuple[Fixed, ...] | None:
        # Times that are further from each other than any rule can tell may as well be near.
        enough = self._needed.most * (self._needed.reach + 1)
        for seconds in (self._needed.reach, min(enough, MOST_SECONDS)):
            found = self._search(Tried(0, seconds=range(seconds, 0, -1)))
            if found is not None:
                return self._less(found)
        if self._needed.known and enough <= MOST_SECONDS:
            return None
        raise otherwise

    @cached_property
    def _of_many(self) -> tuple[Fixed, ...] | None:
        """A conflict in which many instants matter, if one is found."""
        for look in (self._drawn_out, self._by_turns):
            try:
                found = look()
            except Undecided:
                found = None
            if found is not None:
                return found
        return None

    def _by_turns(self) -> tuple[Fixed, ...] | None:
        """A conflict in which what the rule calls for is kept off by one instant after the other."""
        for ago in turns(self._program, self._rule, MOST_SECONDS):
            try:
                found = self._search(Tried(0, seconds=ago))
            except Undecided:
                continue
            if found is not None:
                return self._less(found)
        return None

    def _drawn_out(self) -> tuple[Fixed, ...] | None:
        """A conflict drawn out from one of the same rules with shorter windows."""
        shorter = shortened(self._program.ruleset)
        if shorter is None:
            return None
        ruleset, unit = shorter
        searches = _Searches(Program(ruleset, self._program.untimed), ruleset.by_label[self._rule.label])
        found = searches._of_few(MOST_DRAWN_OUT)
        for history in drawn_out(found, unit) if found is not None else ():
            if _is_conflict(self._program, self._rule, history):
                return history
        return None

    def _of_few(self, most: int) -> tuple[Fixed, ...] | None:
        """A conflict with so many instants before now at most."""
        found = (self._search(Tried(instants)) for instants in range(1, most + 1))
        first = next((one for one in found if one is not None), None)
        return None if first is None else self._less(first)

    def _less(self, found: tuple[Fixed, ...]) -> tuple[Fixed, ...]:
        return _smaller(self._program, self._rule, found)


def _is_conflict(program: Program, rule: Rule, history: tuple[Fixed, ...]) -> bool:
    return after(program, history, rule).ask() and not after(program, history).ask()


def _smaller(program: Program, rule: Rule, history: tuple[Fixed, ...]) -> tuple[Fixed, ...]:
    """The history without what does not matter: instants and events, as long as it stays one."""

    def is_one(candidate: tuple[Fixed, ...]) -> bool:
        try:
            return _is_conflict(program, rule, candidate)
        except Undecided:
            return False

    for place in reversed(range(len(history) - 1)):
        without = (*history[:place], *history[place + 1 :])
        if is_one(without):
            history = without
    grew_less = True
    while grew_less:
        grew_less = False
        for place, instant in enumerate(history):
            keep = rule.trigger if place == len(history) - 1 else None
            for event in sorted(instant.events - {keep}):
                less = replace(history[place], events=history[place].events - {event})
                without = (*history[:place], less, *history[place + 1 :])
                if is_one(without):
                    # What another one called for may go with it.
                    history = without
                    grew_less = True
    begins = history[0].time
    return tuple(replace(instant, time=instant.time - begins) for instant in history)


def _shown(program: Program, rule: Rule, history: tuple[Fixed, ...]) -> History:
    inner = after(program, history)
    stuck = not inner.ask()
    assert stuck, "the history was found to have no way to go on"
    # What is known to come to no end leaves no rule to name but this one.
    matter = [rule.label, *(name for name in needed(inner) if name != rule.label)]
    around = after(program, history, rule)
    goes_on = around.ask()
    assert goes_on, "without the rule's demand of now there is a way to go on"
    moments = []
    happens = set().union(*(instant.events for instant in history))
    for place, instant in enumerate(history):
        now = place == len(history) - 1
        # What no event of the history triggers is triggered by what is due now.
        rules = [program.ruleset.by_label[name] for name in matter if name in program.ruleset.by_label]
        speaking = [r for r in rules if r.trigger in instant.events or (now and r.trigger not in happens)]
        moments.append((place, speaking))
    return History(history, tuple(matter), excerpt(around, moments, now=len(history) - 1))
