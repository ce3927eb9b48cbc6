"""What an event brings with it: how many instants the deadlines take that its rules, and theirs, set."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from functools import cached_property
from typing import TYPE_CHECKING

from sleec_runtime.model import Assume, Never
from sleec_runtime.model_time import Effect, Lasting
from sleec_verify.timed.program import events_of, together
from sleec_verify.timed.responses import Occurs, occurrences

if TYPE_CHECKING:
    from sleec_verify.timed.program import Program

MOST_LEAN = 24
"""Lean ways to go on that are looked at for one response: of each choice, another response may stand by."""


class Brought:
    """Of the events of one program, each looked at once."""

    def __init__(self, program: Program) -> None:
        self._program = program
        self._found: dict[str, int | None] = {}
        self._due: dict[str, set[Occurs]] = {}
        self._harmless: dict[str, bool] = {}

    def instants(self, trigger: str, missing: Collection[str] = ()) -> int | None:
        """How many instants the deadlines take that an event brings with it, and those of what they call for; None
        where these come back to themselves. What is `missing` has not been done since."""
        total = 0
        for what in self._due_after(trigger):
            if what.event in missing or what.end is None:
                continue
            if what.event not in self._found:
                self._found[what.event] = None
                self._found[what.event] = self.instants(what.event)
            further = self._found[what.event]
            if further is None:
                return None
            total += 1 + further
        return total

    def from_then_on(self, triggers: Iterable[str]) -> set[str]:
        """The events that are called for by some of these, or by what they bring with them, without end. The last time
        that one was done does for all who had called for it."""
        found: set[str] = set()
        seen: set[str] = set()
        ahead = list(triggers)
        while ahead:
            trigger = ahead.pop()
            if trigger not in seen:
                seen.add(trigger)
                due = self._due_after(trigger)
                ahead += [what.event for what in due]
                found.update(what.event for what in due if what.end is None)
        return found

    def may_come(self, trigger: str, event: str) -> bool:
        """Whether an event may come at once with another one."""
        return event in self.at_once_with(trigger)

    def _due_after(self, trigger: str) -> set[Occurs]:
        found = self._due.get(trigger)
        if found is None:
            found = self._due[trigger] = self._look_for_due(trigger)
        return found

    def _look_for_due(self, trigger: str) -> set[Occurs]:
        """What is due later once an event occurs, all that comes at once with it included. What an event may do from
        then on, it does for all rules; what happens at once has been done."""
        found: set[Occurs] = set()
        happens = self.at_once_with(trigger, surely=True)
        events = self.at_once_with(trigger)
        for rule in (rule for event in events for rule in self._program.by_trigger.get(event, ())):
            for demand in self._program.demands(rule):
                leaves = list(occurrences(demand))
                if not any(self._done(what, happens) for what in leaves):
                    found.update(
                        what if what.is_later else Occurs(what.event, 0, None if what.end is None else 1)
                        for what in leaves
                        if not what.negated and what.end != 0
                    )
        return found

    def _done(self, what: Occurs, happens: set[str]) -> bool:
        """Whether it happens at once, or can as well."""
        if what.negated or what.is_later:
            return False
        return what.event in happens or self.is_harmless(what.event)

    def is_harmless(self, event: str) -> bool:
        """Whether an event can be done whatever else is the case: nothing forbids it, or what it calls for, no law
        speaks of them, and all that they call for can be done at the same time. They forbid nothing."""
        known = self._harmless.get(event)
        if known is None:
            with_it = self._all_at_once(event)
            # What an event that is harmless calls for is so too.
            self._harmless.update(dict.fromkeys(with_it or (), True))
            known = self._harmless[event] = with_it is not None
        return known

    def _all_at_once(self, event: str) -> set[str] | None:
        """The events that are done at once with an event that is harmless; None if it is not."""
        found, ahead = {event}, [event]
        while ahead:
            trigger = ahead.pop()
            if self._harmless.get(trigger):
                continue
            if trigger in self._program.bound or trigger in self._program.forbidding or trigger in self._harmless:
                return None
            for rule in self._program.by_trigger.get(trigger, ()):
                for demand in self._program.demands(rule):
                    # What may come in its place comes after it.
                    answer = next(occurrences(demand))
                    if answer.negated or answer.is_later:
                        return None
                    if answer.event not in found:
                        found.add(answer.event)
                        ahead.append(answer.event)
        return found

    def at_once_with(self, trigger: str, surely: bool = False) -> set[str]:
        """The events that may come at once with an event; `surely`, only those that do whatever the conditions."""
        found, ahead = {trigger}, [trigger]
        if not surely:
            ahead += self._at_any_time - found
            found |= self._at_any_time
        while ahead:
            event = ahead.pop()
            fresh = {what.event for what in self._answers(event, surely) if not what.negated and what.end == 0}
            fresh |= self._tied.get(event, set())
            ahead += fresh - found
            found |= fresh
        return found

    @cached_property
    def _tied(self) -> dict[str, set[str]]:
        """The events that a relation has occur whenever another one does."""
        found: dict[str, set[str]] = {}
        for law in self._program.laws:
            for one, other in together(law):
                found.setdefault(one, set()).add(other)
        return found

    @cached_property
    def binds_any_instant(self) -> bool:
        """Whether a law may demand something of an instant that is there for another event."""
        return bool(self._at_any_time) or any(isinstance(law, Lasting) for law in self._program.laws)

    @cached_property
    def _at_any_time(self) -> set[str]:
        """The events that a law may have occur at any instant."""
        return {
            event
            for law in self._program.laws
            if isinstance(law, (Assume, Never)) or (isinstance(law, Effect) and law.relation == "causation")
            for event in events_of(law)
        }

    def _answers(self, event: str, surely: bool) -> Iterator[Occurs]:
        for rule in self._program.by_trigger.get(event, ()):
            if not surely or (rule.guard is None and len(list(rule.clauses())) == 1):
                for demand in self._program.demands(rule):
                    leaves = list(occurrences(demand))
                    if not surely or len(leaves) == 1:
                        yield from leaves
