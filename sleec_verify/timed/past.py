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

from collections.abc import Iterable
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
                brought = self._program.brought.instants(trigger, missing)
                if brought is None:
                    self._known = False
                    brought = 0
                instants = 1 + done_all_the_same + brought
                windows = self._windows(what)
                if len(occurrences) == 1 and windows == 1:
                    key = (what.event, what.negated, what.is_later)
                    self._single[key] = max(self._single.get(key, 0), instants)
                else:
                    self._more += instants * windows
            done_all_the_same += what.negated and what.end != 0

    def _windows(self, what: Occurs) -> int:
        """How many triggerings of one rule it takes to say all that they say together. Of those whose windows are open,
        one; of the others no more than there are seconds until then."""
        start = what.start or 0
        if (
            start <= 1
            or (what.end is None and what.negated)
            or (not what.negated and self._program.is_inert(what.event))
        ):
            return 1
        if not what.negated:
            return start
        assert what.end is not None, "what has no end was told apart above"
        length = max(what.end - start + 1, 1)
        return 1 + min(start - 1, 2 * ((what.end - 1) // length))


def _presses(what: Occurs) -> bool:
    """Whether it may still be demanded after its trigger. What is due at some time without end presses no more than if
    it had been triggered now."""
    return what.is_deadline or (what.negated and what.end != 0)
