"""What an event brings with it: how many instants the deadlines take that its rules, and theirs, set."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from functools import cached_property
from typing import TYPE_CHECKING

from sleec_runtime.model_time import EventRelation
from sleec_verify.timed.responses import Occurs

if TYPE_CHECKING:
    from sleec_verify.timed.program import Program


class Brought:
    """Of the events of one program, each looked at once."""

    def __init__(self, program: Program) -> None:
        self._program = program
        self._found: dict[str, int | None] = {}
        self._deadlines: dict[str, set[Occurs]] = {}

    def instants(self, trigger: str, missing: Collection[str] = ()) -> int | None:
        """How many instants the deadlines take that an event brings with it, and those of what they call for; None
        where these come back to themselves. What is `missing` has not been done since."""
        total = 0
        for what in self._deadlines_of(trigger):
            if what.event in missing:
                continue
            if what.event not in self._found:
                self._found[what.event] = None
                self._found[what.event] = self.instants(what.event)
            further = self._found[what.event]
            if further is None:
                return None
            total += 1 + further
        return total

    def _deadlines_of(self, trigger: str) -> set[Occurs]:
        found = self._deadlines.get(trigger)
        if found is None:
            found = self._deadlines[trigger] = self._look_for_deadlines(trigger)
        return found

    def _look_for_deadlines(self, trigger: str) -> set[Occurs]:
        """What is due within some time once an event occurs, all that comes at once with it included. What an event
        may do from then on, it does for all rules; what happens at once has been done."""
        found: set[Occurs] = set()
        happens = self._at_once_with(trigger, surely=True)
        events = self._at_once_with(trigger)
        for rule in (rule for event in events for rule in self._program.by_trigger.get(event, ())):
            for occurrences in self._program.demands(rule):
                if not any(self._done(what, happens) for what in occurrences):
                    found.update(
                        what if what.is_later else Occurs(what.event, 0, 1) for what in occurrences if what.is_deadline
                    )
        return found

    def _done(self, what: Occurs, happens: set[str]) -> bool:
        """Whether it happens at once, or can as well: nothing keeps it, or what it calls for, from that, and nothing is
        forbidden by it."""
        if what.negated or what.is_later:
            return False
        if what.event in happens:
            return True
        found, ahead = {what.event}, [what.event]
        while ahead:
            event = ahead.pop()
            if event in self._program.bound or event in self._program.forbidding:
                return False
            for answer in self._answers(event):
                if answer.negated or answer.is_later:
                    return False
                if answer.event not in found:
                    found.add(answer.event)
                    ahead.append(answer.event)
        return True

    def _at_once_with(self, trigger: str, surely: bool = False) -> set[str]:
        """The events that may come at once with an event; `surely`, only those that do whatever the conditions."""
        found, ahead = {trigger}, [trigger]
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
            if isinstance(law, EventRelation) and law.relation in ("witness", "equal"):
                found.setdefault(law.left, set()).add(law.right)
                if law.relation == "equal":
                    found.setdefault(law.right, set()).add(law.left)
        return found

    def _answers(self, event: str, surely: bool = False) -> Iterator[Occurs]:
        for rule in self._program.by_trigger.get(event, ()):
            if not surely or (rule.guard is None and len(list(rule.clauses())) == 1):
                for occurrences in self._program.demands(rule):
                    if not surely or len(occurrences) == 1:
                        yield from occurrences
