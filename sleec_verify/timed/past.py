"""How many instants before now can matter to a conflict: what rules that were triggered then still demand.

What is pending now is the sum of what each triggering left. Of many triggerings, few say all of it (`Past.pending`):

- A prohibition from now on (``NOT Open WITHIN 5 minutes``) that ends last says all that the others of its event say,
  and so does the deadline that ends first: what meets it meets the others too, and those without end. One each is
  enough for an event, whatever the rules. A prohibition without end that begins later is one more.
- Windows that open later (``WITHIN [3, 5] minutes``) add up until they are open: there is one for each second at most.
  Prohibitions need no more of them than cover times ahead with none in vain; equal windows then overlap with the next
  one only, so every other one has its length for itself.
- Where something else is due in place of what was not done, the oldest of the triggerings whose windows are all open
  says all that the others say, as long as nothing in it is forbidden. Else each second may leave a demand of its own.
- An event that nothing calls for need not happen again: that it is forbidden leaves nothing. One that can be done now
  whatever else is the case (`Brought.is_harmless`) leaves nothing either where it is called for.
- An event that has no consequences, and whose prohibitions do not depend on what is done, is called for one by one:
  each call can be met or cannot, whatever becomes of the others. If one cannot, that one is enough: one in all.

All windows that end do so within the longest of them (`Past.reach`): of the triggerings before that, only those matter
that leave something without end (`Past.endless`). No rule tells times apart that are further from each other.

For a history of these, each instant needs others (`Past.most`): at which what is due in place of something forbidden
was forbidden and done all the same; at which whatever else the same triggers brought with them was done, unless it can
be done at once; at which an event was that has to come before another one, or that a relation holds from, or up to.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import comb
from typing import NamedTuple

from sleec_runtime.model import Rule
from sleec_runtime.model_time import EventRelation, Lasting
from sleec_verify.timed.program import Program
from sleec_verify.timed.responses import Demand, Occurs, occurrences, seconds, ways_of


class Past(NamedTuple):
    """No history with more than `most` instants before now conflicts unless a shorter one does, if that is `known`.

    Of all that a history leaves to be done, as many as `pending` of its instants say everything; so do those of the
    last `reach` seconds, with `endless` others."""

    most: int
    known: bool
    pending: int
    reach: int
    endless: int


def past(program: Program, rules: Iterable[Rule]) -> Past:
    """Of conflicts among `rules`. Raises Undecided for a window whose length a measure says."""
    return _Counting(program).of(rules)


class _Counting:
    def __init__(self, program: Program) -> None:
        self._program = program
        self._brought = program.brought
        self._known = True
        self._shared: dict[tuple[str, str], int] = {}
        self._shared_endless: set[tuple[str, str]] = set()
        self._pending = 0
        self._endless = 0
        self._more = 0

    def of(self, rules: Iterable[Rule]) -> Past:
        rules = list(rules)
        for rule in rules:
            for demand in self._program.demands(rule):
                self._count(rule.trigger, demand)
        # Instants of which one is enough, whatever called for it.
        one_each = list(self._brought.from_then_on(rule.trigger for rule in rules))
        laws = 0
        for law in self._program.laws:
            if isinstance(law, EventRelation) and law.relation == "happenBefore":
                one_each.append(law.left)
                laws += 1
            elif isinstance(law, Lasting):
                one_each.append(law.event)
                laws += 1
        most = sum(self._shared.values()) + self._more + sum(1 + self._further(event) for event in one_each)
        for law in self._program.laws:
            if isinstance(law, Lasting) and law.end is not None:
                # Each instant may begin it, and need one that ends it.
                self._known &= not self._further(law.end) and not self._brought.may_come(law.end, law.event)
                most *= 2
        return Past(
            most=most,
            known=self._known,
            pending=len(self._shared) + self._pending + laws,
            reach=self._reach(rules),
            endless=len(self._shared_endless) + self._endless + laws,
        )

    def _reach(self, rules: Iterable[Rule]) -> int:
        ends = [
            max(what.start or 0, what.end or 0)
            for rule in rules
            for demand in self._program.demands(rule)
            for what in occurrences(demand)
        ]
        lasting = [
            int(-(-seconds(law.duration) // 1))
            for law in self._program.laws
            if isinstance(law, Lasting) and law.duration is not None
        ]
        return max([*ends, *lasting], default=0)

    def _further(self, trigger: str, missing: Iterable[str] = ()) -> int:
        brought = self._brought.instants(trigger, set(missing))
        if brought is None:
            self._known = False
            return 0
        return brought

    def _count(self, trigger: str, demand: Demand) -> None:
        """What one obligation of a rule of this trigger adds."""
        ways = ways_of(demand)
        if ways is None:
            every = tuple(occurrences(demand))
            # What each second may leave, and what may be left for ever.
            endless = 2 ** len(every) if any(what.end is None for what in every) else 0
            self._endless += endless
            self._add(trigger, every, max(what.end or 0 for what in every) + endless)
            return
        for way in ways:
            leaves = [o for o in way if o.end != 0 and not (o.negated and self._is_never_called(o.event))]
            if not leaves or self._program.free.can_be_done(leaves):
                continue
            shared, more = self._of_leaves(leaves)
            self._add(trigger, way, more)
            if any(what.end is None for what in leaves):
                self._shared_endless.update(shared)
                self._endless += _past_all_ends(leaves) if more else 0
            instants = self._instants(trigger, way) if shared else 0
            for key in shared:
                self._shared[key] = max(self._shared.get(key, 0), instants)

    def _add(self, trigger: str, way: Sequence[Occurs], triggerings: int) -> None:
        if triggerings:
            self._pending += triggerings
            self._more += triggerings * self._instants(trigger, way)

    def _instants(self, trigger: str, way: Sequence[Occurs]) -> int:
        """The instants that one triggering takes."""
        first = way[0]
        if len(way) == 1:
            # What is still to come for one rule is still to come for the others.
            missing = [first.event] if not first.negated and not first.is_later else []
            return 1 + self._further(trigger, missing)
        done_all_the_same = [1 + self._further(what.event) for what in way if what.negated and what.end != 0]
        return 1 + self._further(trigger) + sum(done_all_the_same)

    def _of_leaves(self, leaves: Sequence[Occurs]) -> tuple[list[tuple[str, str]], int]:
        """How many triggerings say all that these responses, of which one has to be kept, come to leave: those that
        they have in common with others, by what they say, and how many more."""
        forbidden = [what for what in leaves if what.negated]
        due = [what for what in leaves if not what.negated]
        if len(forbidden) <= 1 and all(map(self._is_settled, due)):
            shared, more = self._of_prohibition(forbidden[0]) if forbidden else ([], 0)
            return [*shared, *([("", "due")] if due else [])], more
        if forbidden:
            return [], _second_by_second(leaves)
        latest = max(what.start or 0 for what in due)
        if len(due) > 1:
            return [], max(latest - 1, 0) + 1
        if due[0].end is None and latest > 1:
            return [(due[0].event, "due from then on")], 0
        return [(due[0].event, "due")], max(latest - 1, 0)

    def _of_prohibition(self, what: Occurs) -> tuple[list[tuple[str, str]], int]:
        start = what.start or 0
        if start <= 1:
            return [(what.event, "forbidden")], 0
        if what.end is None:
            return [(what.event, "forbidden from then on")], 0
        length = max(what.end - start + 1, 1)
        return [(what.event, "forbidden")], min(start - 1, 2 * ((what.end - 1) // length))

    def _is_never_called(self, event: str) -> bool:
        return event not in self._program.obliging and event not in self._program.bound

    def _is_settled(self, what: Occurs) -> bool:
        """Whether it can be met or cannot, whatever is done."""
        return (
            self._program.is_open_ended
            and self._program.is_inert(what.event)
            and all(
                self._is_never_called(rule.trigger)
                and all(
                    len(list(occurrences(demand))) == 1
                    for demand in self._program.demands(rule)
                    if any(other.negated and other.event == what.event for other in occurrences(demand))
                )
                for rule in self._program.forbidding.get(what.event, ())
            )
        )


_LONG = 100
"""Seconds that are not looked at one by one."""


def _past_all_ends(leaves: Sequence[Occurs]) -> int:
    """How many triggerings say all that is left once all windows that end have ended."""
    for_ever = [what for what in leaves if what.end is None]
    # What was done all the same tells triggerings apart; the fewer responses are left, the more it says.
    forbidden = sum(what.negated for what in for_ever)
    return comb(forbidden, forbidden // 2) if for_ever else 0


def _second_by_second(leaves: Sequence[Occurs]) -> int:
    """How many triggerings say all that responses of both kinds come to leave, of which one has to be kept."""
    ends = [what.end for what in leaves if what.end is not None]
    longest = max(ends, default=0)
    found = _past_all_ends(leaves)
    if longest > _LONG:
        return found + longest
    alike = set()
    for since in range(1, longest + 1):
        pending = [what for what in leaves if what.end is None or what.end >= since]
        is_open = all((what.start or 0) <= since for what in pending)
        if is_open and not any(what.negated for what in pending):
            alike.add("the oldest says all")
        elif is_open and len(pending) == 1:
            alike.add("the newest says all")
        else:
            found += 1
    return found + len(alike)
