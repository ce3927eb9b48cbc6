"""What came about at the instants that a part of a history leaves out."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from sleec_verify.timed.instant import Formula
from sleec_verify.timed.needs import Placed
from sleec_verify.timed.responses import Occurs
from sleec_verify.timed.times import Times
from sleec_verify.timed.windows import allows, inside


class Unseen(NamedTuple):
    """That an event (or what ends a law) came about in a window around instant `at`, at an instant before now that is
    not one of those that are known. Those that begin without bound end right before it (`before`)."""

    at: int
    what: str
    start: int | None = None
    end: int | None = None

    @classmethod
    def before(cls, at: int, event: str) -> Unseen:
        return cls(at, event, None, -1)


class LeftOut:
    """What came about where the first instants, so many, after which comes now, are only a part of those before now: it
    is `known`, or open."""

    def __init__(self, formula: Formula, times: Times, instants: int, known: Mapping[Unseen, bool] | None) -> None:
        self._formula = formula
        self._times = times
        self.instants = instants
        self._known = known
        self.literals: dict[Unseen, int] = {}

    @property
    def are_some(self) -> bool:
        """Whether any may be left out."""
        return self.instants > 0 or self._known is not None

    def came_about(self, at: int, what: str, start: int | None = None, end: int | None = None) -> int:
        """The literal "it came about in this window, at an instant before now that is not one of these"."""
        if end is not None and end <= 0:
            return self.came_before(at, what) if start is None else -self._formula.true
        if at >= self.instants:
            return -self._formula.true
        key = Unseen(at, what, start, end)
        if self._known is None and key not in self.literals:
            add = self._formula.clauses.append
            literal = self._formula.fresh()
            for other, its in self.literals.items():
                if (other.at, other.what) == (at, what):
                    # What comes about in a part of a window does so in all of it.
                    if allows(inside(key, other), 0):
                        add([-literal, its])
                    if allows(inside(other, key), 0):
                        add([-its, literal])
            self.literals[key] = literal
            # There has been time for it, after this instant and before now.
            for bound in self._times.bounds(at, self.instants, max(start or 0, 1) + 1, None):
                add([-literal, bound])
        return self._literal(key)

    def came_before(self, at: int, event: str) -> int:
        """The literal "it came about before this instant, and before now, at one that is not one of these"."""
        if not self.are_some:
            return -self._formula.true
        key = Unseen.before(min(at, self.instants), event)
        if self._known is None and key not in self.literals:
            literal = self._formula.fresh()
            for other, its in self.literals.items():
                if other == Unseen.before(other.at, event):
                    # The instants are numbered in the order of time.
                    self._formula.clauses.append([-its, literal] if other.at < key.at else [-literal, its])
            self.literals[key] = literal
        return self._literal(key)

    def _literal(self, key: Unseen) -> int:
        if self._known is None:
            return self.literals[key]
        return self._formula.true if self._known.get(key) else -self._formula.true

    def placed(self) -> Iterator[Placed]:
        """All of it that may have come about."""
        for key, literal in self.literals.items():
            yield Placed(key.at, Occurs(key.what, key.start, key.end), literal)
