"""How many instants before now can matter to a conflict: what rules that were triggered then still demand.

What is pending now is the sum of what each triggering left. Of many triggerings, few say all of it:

- A prohibition from now on (``NOT Open WITHIN 5 minutes``) that ends last says all that the others of its event say,
  and so does the deadline that ends first: what meets it meets the others too. One each is enough for an event,
  whatever the rules. A prohibition without end that begins first is one more.
- Windows that open later (``WITHIN [3, 5] minutes``) add up until they are open: there is one for each second at most.
  Prohibitions need no more of them than cover times ahead with none in vain; equal windows then overlap with the next
  one only, so every other one has its length for itself. What is called for can be asked for one by one, as long as the
  event has no consequences.
- What is due in place of something that was forbidden needs the instant at which it was done all the same.
- Whatever else the same triggers brought with them was done by now, at instants of its own, unless it can be done at
  once.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from functools import cached_property
from typing import NamedTuple

from sleec_runtime.model import Rule
from sleec_runtime.model_time import EventRelation, Lasting
from sleec_verify.timed.program import Program
from sleec_verify.timed.responses import Occurs


class Past(NamedTuple):
    """No history with more than `most` instants before now conflicts unless a shorter one does, if that is `known`."""

    most: int
    known: bool


def past(program: Program, rules: Iterable[Rule]) -> Past:
    """Of conflicts among `rules`. Raises Undecided for a window whose length a measure says."""
    return _Counting(program).of(rules)


class _Counting:
    def __init__(self, program: Program) -> None:
        self._program = program
        self._known = True
        self._single: dict[tuple[str, bool, bool], int] = {}
        self._more = 0
        self._found: dict[str, int | None] = {}

    def of(self, rules: Iterable[Rule]) -> Past:
        for rule in rules:
            for occurrences in self._program.demands(rule):
                self._count(rule.trigger, occurrences)
        laws = sum(
            isinstance(law, Lasting) or (isinstance(law, EventRelation) and law.relation == "happenBefore")
            for law in self._program.laws
        )
        return Past(sum(self._single.values()) + self._more + laws, self._known)

    def _count(self, trigger: str, occurrences: list[Occurs]) -> None:
        """What one obligation of a rule of this trigger adds."""
        done_all_the_same = 0
        # An event that is still to come for one rule is still to come for the others.
        missing: set[str] = set()
        for what in occurrences:
            if not what.negated:
                missing.add(what.event)
            if _presses(what):
                brought = self._brought(trigger, missing)
                if brought is None:
                    self._known = False
                    brought = 0
                instants = 1 + done_all_the_same + brought
                windows = self._windows(what)
                if len(occurrences) == 1 and windows == 1:
                    key = (what.event, what.negated, _later(what))
                    self._single[key] = max(self._single.get(key, 0), instants)
                else:
                    self._more += instants * windows
            done_all_the_same += what.negated and what.end != 0

    def _windows(self, what: Occurs) -> int:
        """How many triggerings of one rule it takes to say all that they say together. Of those whose windows are open,
        one; of the others no more than there are seconds until then."""
        start = what.start or 0
        if start <= 1 or (what.end is None and what.negated) or (not what.negated and self._inert(what.event)):
            return 1
        if not what.negated:
            return start
        assert what.end is not None, "what has no end was told apart above"
        length = max(what.end - start + 1, 1)
        return 1 + min(start - 1, 2 * ((what.end - 1) // length))

    def _brought(self, trigger: str, missing: Collection[str] = ()) -> int | None:
        """How many instants the deadlines take that an event brings with it, and those of what they call for; None
        where these come back to themselves. What is `missing` has not been done since."""
        total = 0
        for what in self._deadlines(trigger):
            if what.event in missing:
                continue
            if what.event not in self._found:
                self._found[what.event] = None
                self._found[what.event] = self._brought(what.event)
            further = self._found[what.event]
            if further is None:
                return None
            total += 1 + further
        return total

    def _deadlines(self, trigger: str) -> set[Occurs]:
        """What is due within some time once an event occurs, all that comes at once with it included. What an event
        may do from then on, it does for all rules; what happens at once has been done."""
        found: set[Occurs] = set()
        happens = self._at_once_with(trigger, surely=True)
        events = self._at_once_with(trigger)
        for rule in (rule for event in events for rule in self._program.by_trigger.get(event, ())):
            for occurrences in self._program.demands(rule):
                if not any(self._done(what, happens) for what in occurrences):
                    found.update(
                        what if _later(what) else Occurs(what.event, 0, 1) for what in occurrences if _deadline(what)
                    )
        return found

    def _done(self, what: Occurs, happens: set[str]) -> bool:
        """Whether it happens at once, or can as well: nothing keeps it, or what it calls for, from that, and nothing is
        forbidden by it."""
        if what.negated or _later(what):
            return False
        if what.event in happens:
            return True
        found, ahead = {what.event}, [what.event]
        while ahead:
            event = ahead.pop()
            if event in self._program.bound or event in self._program.forbidding:
                return False
            for answer in self._answers(event):
                if answer.negated or _later(answer):
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

    def _inert(self, event: str) -> bool:
        return event not in self._program.by_trigger and event not in self._program.bound


def _later(what: Occurs) -> bool:
    return what.start is not None and what.start > 0


def _deadline(what: Occurs) -> bool:
    return not what.negated and what.end is not None and what.end > 0


def _presses(what: Occurs) -> bool:
    """Whether it may still be demanded after its trigger. What is due at some time without end presses no more than if
    it had been triggered now."""
    return _deadline(what) or (what.negated and what.end != 0)
