"""What a robot is free to do whatever else is the case: demands that can be met after any history."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cached_property, partial
from math import inf
from typing import TYPE_CHECKING

from sleec_runtime.model import Rule
from sleec_runtime.model_time import Effect
from sleec_verify.solver import Undecided
from sleec_verify.timed.addition import can_be_added
from sleec_verify.timed.lean import Known, Lean
from sleec_verify.timed.responses import Demand, Occurs, ways_of
from sleec_verify.timed.windows import allows, inside

if TYPE_CHECKING:
    from sleec_verify.timed.program import Program
    from sleec_verify.timed.steady import Measured

MOST_LEAN = 24
"""Lean ways to go on that are looked at for one response: of each choice, another response may stand by."""

MOST_LOOKED_AT = 100
"""Events that may matter to one response, for more to be looked at than the plainest way to go on."""


class Free:
    """The demands of one program that can be met, each looked at once."""

    def __init__(self, program: Program) -> None:
        self._program = program
        self._late: dict[str, bool] = {}
        self._plainly: dict[tuple[Occurs, ...], bool] = {}
        self._answers: dict[tuple[tuple[Occurs, ...], str, int], bool] = {}
        self._leans: dict[tuple[object, ...], Lean] = {}
        self._met: dict[tuple[str, str], frozenset[tuple[int, Occurs]]] = {}
        self._can_be: dict[tuple[tuple[str, int | None], frozenset[str]], bool] = {}
        self._measured: dict[str, bool] = {}

    def can_be_done(self, leaves: Sequence[Occurs]) -> bool:
        """Whether, as long as anything of it is pending, something of it can be done, at once or after all else,
        whatever else is the case."""
        if self._can_wait(leaves):
            return True
        reached = 0
        harmless = [what for what in leaves if not what.negated and self._program.brought.is_harmless(what.event)]
        for what in sorted(harmless, key=lambda what: what.start or 0):
            if (what.start or 0) > reached + 1:
                return False
            if what.end is None:
                return True
            reached = max(reached, what.end)
        return all(what.end is not None and what.end <= reached for what in leaves)

    def is_free(self, demand: Demand) -> bool:
        """Whether a demand can be met whatever else is the case, when it is made and as long as it is pending."""
        ways = ways_of(demand)
        return ways is not None and all(map(self.is_free_way, ways))

    def is_free_way(self, way: Sequence[Occurs]) -> bool:
        """Whether one of several responses can be met whatever else is the case, when it is called for and as long as
        it is pending."""
        if self._can_wait(way):
            return True
        # A law may call for something else at an instant that is only there for this.
        at_hand = (what for what in way if not what.negated and (not what.is_later or not self._program.laws))
        pending = [what for what in way if what.end != 0]
        return any(self._program.brought.is_harmless(what.event) for what in at_hand) and (
            not pending or self.can_be_done(pending)
        )

    def is_free_now(self, demand: Demand, rule: Rule, clause: int, thorough: bool = True) -> bool:
        """Whether a demand of now that a clause of a rule makes can be met whatever else is the case: as `is_free`, or
        by a lean way to go on; the plainest one if not `thorough`."""
        ways = ways_of(demand)
        return ways is not None and all(
            self.is_free_way(way) or self._has_plain(way) or (thorough and self._has_lean(way, rule, clause))
            for way in ways
        )

    def is_all_free_now(self, rule: Rule, thorough: bool = True) -> bool:
        """As `is_free_now`, of all that a rule demands."""
        return all(
            self.is_free_now(demand, rule, clause, thorough)
            for clause, demands in enumerate(self._program.demands_of_clauses(rule))
            for demand in demands
        )

    def _has_plain(self, way: tuple[Occurs, ...]) -> bool:
        found = self._plainly.get(way)
        if found is None:
            known = Known()
            found = self._is_met(way, self._lean(known)) or self._is_added(way, self._lean(known, way))
            self._plainly[way] = found
        return found

    def _is_met(self, way: tuple[Occurs, ...], lean: Lean) -> bool:
        return any(map(lean.can_meet, way)) or lean.is_left_out(way)

    def _is_added(self, way: tuple[Occurs, ...], lean: Lean) -> bool:
        return any(not what.negated and can_be_added(self._program, lean, what) for what in way)

    def _has_lean(self, way: tuple[Occurs, ...], rule: Rule, clause: int) -> bool:
        key = way, rule.label, clause
        found = self._answers.get(key)
        if found is None:
            found = self._answers[key] = self._look_for_lean(way, rule, clause)
        return found

    def _look_for_lean(self, way: tuple[Occurs, ...], rule: Rule, clause: int) -> bool:
        # In the order in which they come up, each once.
        looked_at = dict.fromkeys(what.event for what in way)
        if self._is_free_by_lean(way, Known(), looked_at):
            return True
        return len(looked_at) <= MOST_LOOKED_AT and self._is_free_by_lean(
            way, self._known(rule, clause, looked_at), looked_at
        )

    def _known(self, rule: Rule, clause: int, events: Iterable[str]) -> Known:
        """What is known where a clause of a rule decides now, of some events and the rules that they trigger."""
        from sleec_verify.timed.questions import can_decide, can_occur, together_at_once

        def never(what: tuple[str, int | None], ask: Callable[[frozenset[str]], bool]) -> bool:
            """Where it is so in a trace that keeps all rules, it is in one that keeps all but this."""
            for without in (frozenset[str](), frozenset({rule.label})):
                key = what, without
                known = self._can_be.get(key)
                if known is None:
                    known = self._can_be[key] = ask(without)
                if known:
                    return False
            return True

        program = self._program
        rules = [one for event in events for one in program.by_trigger.get(event, ())]
        clauses = [(one, place) for one in rules for place, _ in enumerate(one.clauses())]
        try:
            now = together_at_once(program, rule, clause, rules)
        except Undecided:
            now = {(one.label, place) for one, place in clauses}
        return Known(
            rule.label,
            rule.trigger,
            frozenset(event for event in events if never((event, None), partial(can_occur, program, event))),
            frozenset(
                (one.label, place)
                for one, place in clauses
                if never((one.label, place), partial(can_decide, program, one, place))
            ),
            frozenset((one.label, place) for one, place in clauses) - now,
        )

    def _is_free_by_lean(self, way: tuple[Occurs, ...], known: Known, looked_at: dict[str, None]) -> bool:
        from sleec_verify.timed.steady import steady

        def is_free(measures: Measured | None = None, since: float = 0) -> bool:
            # Without the demand of now, nothing of it is met.
            for absent, is_one in (((), self._is_met), (way, self._is_added)):
                for lean in self._lean_ways(known, absent, measures, since):
                    if is_one(way, lean) and lean.is_steady():
                        return True
                    looked_at.update(dict.fromkeys(lean.looked_at))
            return False

        if is_free():
            return True
        never_steady = self._program.brought.binds_any_instant or any(what.end is None for what in way)
        if never_steady or len(looked_at) > MOST_LOOKED_AT:
            return False
        measures = steady(self._program, self._lean(known, way), looked_at)
        if measures is None or not measures.clauses:
            return False
        restless = self._lean(known, way, measures).restless_until()
        return is_free(measures) or (0 < restless < inf and is_free(measures, restless))

    def _lean_ways(
        self, known: Known, absent: tuple[Occurs, ...], measures: Measured | None, since: float
    ) -> Iterator[Lean]:
        """Lean ways to go on: the plain one, and those that have other responses stand by, as far as it mattered to
        those before."""
        ahead: deque[dict[str, int]] = deque([{}])
        seen = [ahead[0]]
        while ahead:
            standbys = ahead.popleft()
            lean = self._lean(known, absent, measures, since, standbys)
            yield lean
            if len(lean.looked_at) > MOST_LOOKED_AT:
                return
            for label, places in sorted(lean.choosing.items()):
                for place in range(places) if label not in standbys else ():
                    more = {**standbys, label: place}
                    if more not in seen and len(seen) < MOST_LEAN:
                        seen.append(more)
                        ahead.append(more)

    def _lean(
        self,
        known: Known,
        absent: tuple[Occurs, ...] = (),
        measures: Measured | None = None,
        since: float = 0,
        standbys: Mapping[str, int] | None = None,
    ) -> Lean:
        key = known, absent, measures, since, frozenset((standbys or {}).items())
        found = self._leans.get(key)
        if found is None:
            found = self._leans[key] = Lean(self._program, known, absent, standbys, measures, since)
        return found

    def met_anyway(self, rule: Rule, without: str) -> frozenset[tuple[int, Occurs]]:
        """Of the clauses of a rule, by their places, the responses of several of which one has to be kept, and is, as
        another rule of the same trigger calls for it in any case; not the rule `without`."""
        program = self._program
        others = {other.label: other for other in program.by_trigger[rule.trigger] if other is not rule}
        key = rule.label, without if without in others else ""
        found = self._met.get(key)
        if found is None:
            others.pop(without, None)
            called = [what for other in others.values() for what in program.surely_called(other)]
            met: set[tuple[int, Occurs]] = set()
            open_: set[tuple[int, Occurs]] = set()
            for clause, demands in enumerate(program.demands_of_clauses(rule)):
                for way in (way for demand in demands for way in ways_of(demand) or ()):
                    is_met = len(way) > 1 and any(_is_within(one, what) for one in called for what in way)
                    (met if is_met else open_).update((clause, what) for what in way)
            found = self._met[key] = frozenset(met - open_)
        return found

    @cached_property
    def reading_rules(self) -> list[Rule]:
        """The rules to which it may matter how the measures are."""
        return [rule for rule in self._program.rules if rule.guard is not None or len(list(rule.clauses())) > 1]

    @cached_property
    def reading(self) -> list[str]:
        """The events at whose instants it may matter how the measures are."""
        laws = (law.event for law in self._program.laws if isinstance(law, Effect))
        return sorted({*(rule.trigger for rule in self.reading_rules), *laws})

    def has_measures(self, event: str) -> bool:
        """Whether the laws leave any measures at an instant of an event."""
        known = self._measured.get(event)
        if known is None:
            try:
                known = self._look_for_measures(event)
            except Undecided:
                known = False
            self._measured[event] = known
        return known

    def _look_for_measures(self, event: str) -> bool:
        from sleec_verify.timed.unfolding import Unfolding

        unfolding = Unfolding(self._program, rules={})
        number = unfolding.instant(unfolding.formula.true)
        return unfolding.ask(unfolding.instants[number].event(event))

    def _can_wait(self, way: Sequence[Occurs]) -> bool:
        """Whether something of it has no end, and can be done after all else."""
        return any(not what.negated and what.end is None and self.comes_late(what.event) for what in way)

    def comes_late(self, event: str) -> bool:
        """Whether an event can be done after all else (`can_come_late`)."""
        known = self._late.get(event)
        if known is None:
            from sleec_verify.timed.policies import can_come_late

            known = self._late[event] = can_come_late(self._program, event)
        return known


def _is_within(called: Occurs, what: Occurs) -> bool:
    """Whether what is called for in one window is done in another."""
    return called.event == what.event and not what.negated and allows(inside(called, what), 0)
