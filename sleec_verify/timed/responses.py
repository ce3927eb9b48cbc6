"""What a response demands of a trace: a formula over occurrences in windows around the instant that triggered it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import chain, product
from math import ceil, floor
from typing import NamedTuple, Union

from sleec_runtime.model import Clause, Obligation, Rational, in_text_order
from sleec_runtime.model_time import Length, Window
from sleec_verify.solver import Undecided
from sleec_verify.timed.scope import Untimed
from sleec_verify.timed.windows import allows


class Occurs(NamedTuple):
    """The event occurs (`negated`: does not occur) at some time from `start` to `end`, in seconds after the trigger,
    both included. None is no bound."""

    event: str
    start: int | None
    end: int | None
    negated: bool = False

    @property
    def is_later(self) -> bool:
        """Whether its window opens only after the trigger."""
        return self.start is not None and self.start > 0

    @property
    def is_deadline(self) -> bool:
        """Whether it calls for the event by some time after the trigger."""
        return not self.negated and self.end is not None and self.end > 0

    @property
    def is_empty(self) -> bool:
        """Whether there is no time at all in its window."""
        return self.start is not None and self.end is not None and self.start > self.end

    def following(self, first: Occurs) -> Occurs:
        """The same, triggered by an occurrence in another window, in seconds after the trigger of that."""
        start = None if first.start is None or self.start is None else first.start + self.start
        return self._replace(start=start, end=None if first.end is None or self.end is None else first.end + self.end)

    def covers(self, after: int) -> bool:
        """Whether the time so many seconds after the trigger is in the window."""
        return allows((self.start, self.end), after)


class Every(NamedTuple):
    parts: tuple[Demand, ...]


class Some(NamedTuple):
    parts: tuple[Demand, ...]


Demand = Union[int, Occurs, Every, Some]
"""A formula in negation normal form. An integer is a literal about the instant of the trigger."""

Chain = Callable[[Clause], list[int]]
"""For each clause of a chain that stands by itself, in the order of the text, the literal "this one decides"."""


class Responses:
    """Reads responses under one meaning of those without a window."""

    def __init__(self, untimed: Untimed) -> None:
        self._untimed = untimed

    def of(self, obligations: tuple[Obligation, ...], chain: Chain, kept: bool = True, after: int = 0) -> Demand:
        """What it takes to keep all of `obligations` (not `kept`: to break one) that are due `after` seconds.

        Raises Undecided for a window whose length a measure says.
        """
        parts = tuple(self._obligation(o, chain, kept, after) for o in obligations)
        return _joined(parts, every=kept)

    def of_clause(self, clause: Clause, chain: Chain, kept: bool = True, after: int = 0) -> Demand:
        """As `of`, of a response with hedges of its own."""
        members = []
        for member, decides in zip(in_text_order(clause), chain(clause)):
            due = self.of(member.obligations, chain, kept, after)
            members.append(Some((-decides, due)) if kept else Every((decides, due)))
        return _joined(tuple(members), every=kept)

    def _obligation(self, obligation: Obligation, chain: Chain, kept: bool, after: int) -> Demand:
        timing = obligation.timing
        start, end = self._bounds(timing.window if timing is not None else None)
        negated = obligation.negated == kept
        itself = Occurs(obligation.name, after + start, None if end is None else after + end, negated)
        if timing is None:
            return itself
        parts: list[Demand] = [itself]
        if timing.otherwise is not None:
            closed = after + end if timing.window is not None and end is not None else after
            parts.append(self.of_clause(timing.otherwise, chain, kept, closed))
        if timing.instead is not None:
            parts.append(self.of_clause(timing.instead, chain, kept, after))
        return _joined(tuple(parts), every=not kept)

    def _bounds(self, window: Window | None) -> tuple[int, int | None]:
        if window is None:
            return (0, 0) if self._untimed == "at" else (0, None)
        # Instants are whole seconds.
        start = 0 if window.start is None else ceil(seconds(window.start))
        return start, None if window.end is None else floor(seconds(window.end))


def seconds(length: Length) -> Rational:
    """A length of time in seconds. Raises Undecided where a measure says it."""
    value = length.seconds
    if value is None:
        raise Undecided(f"the length of time {length} is that of a measure: not analysed")
    return value


def last_second(length: Length) -> int:
    """The last second of what lasts so long, counted from 0. Raises Undecided where a measure says how long."""
    return int(-(-seconds(length) // 1) - 1)


def _joined(parts: tuple[Demand, ...], every: bool) -> Demand:
    if len(parts) == 1:
        return parts[0]
    return Every(parts) if every else Some(parts)


def occurrences(demand: Demand) -> Iterator[Occurs]:
    """Every occurrence that a demand speaks of."""
    if isinstance(demand, Occurs):
        yield demand
    elif not isinstance(demand, int):
        for part in demand.parts:
            yield from occurrences(part)


def certain(demand: Demand) -> Iterator[Occurs]:
    """The occurrences that a demand speaks of and nothing can come in place of, whatever hedges inside decide."""
    if isinstance(demand, Occurs):
        yield demand
    elif isinstance(demand, Every):
        for part in demand.parts:
            yield from certain(part)


def ways_of(demand: Demand) -> list[tuple[Occurs, ...]] | None:
    """For each way in which hedges inside may decide, the responses of which one has to be kept; None where several
    have to be."""
    if isinstance(demand, Occurs):
        return [(demand,)]
    assert not isinstance(demand, int), "a literal is no response"
    # The literal that a clause of a chain decides is no response.
    parts = [ways_of(part) for part in demand.parts if not isinstance(part, int)]
    if isinstance(demand, Every):
        if not all(isinstance(part, Some) and isinstance(part.parts[0], int) for part in demand.parts):
            return None
        return None if None in parts else [way for ways in parts for way in ways or ()]
    if None in parts:
        return None
    return [tuple(chain.from_iterable(choice)) for choice in product(*(ways or () for ways in parts))]


class Part(NamedTuple):
    """A part of a demand, what may as well be done in its place, and the place of the clause that makes the demand."""

    what: Occurs
    instead: Occurs | None
    clause: int


def parts_of(demand: Demand, clause: int, standby: int | None = None) -> Iterator[Part]:
    """The parts of a demand of a clause. Of each choice, one is not done instead of the others, but they are left out
    for it: the `standby`, by its place, or else the first that calls for something."""
    ways = ways_of(demand)
    if ways is None:
        yield from (Part(what, None, clause) for what in occurrences(demand))
    for way in ways or ():
        first = next((what for what in way if not what.negated), None)
        instead = first if standby is None else way[standby % len(way)]
        yield from (Part(what, None if what is instead else instead, clause) for what in way)
