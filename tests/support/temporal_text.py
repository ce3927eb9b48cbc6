"""Reads the text form of metric temporal logic, and evaluates it at the instants of a trace."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from fractions import Fraction

from tests.support.fretish import Evaluation, Reader, Signals

Inside = Callable[[int, int], bool]
"""Whether the second instant is in a window around the first."""


class TemporalReader(Reader):
    """`times` are the times of the points. A point also has the ranks of the values of scales."""

    token = re.compile(r"\s*(\"[^\"]*\"|->|<=|>=|!=|[-+*/()!&|<>=,\[\]]|[a-zA-Z][a-zA-Z0-9_]*|\d+)")

    def __init__(self, text: str, points: Sequence[Signals], times: Sequence[int]) -> None:
        super().__init__(text, points)
        self.times = times

    def implication(self) -> Evaluation:
        left = super().implication()
        if not self.take("W"):
            return left
        inside, right = self.window(), super().implication()
        end = len(self.points)

        def weak_until(t: int) -> bool:
            return all(left(n) or any(right(m) for m in range(t, n + 1)) for n in range(t, end) if inside(t, n))

        return weak_until

    def primary(self) -> Evaluation:
        end = len(self.points)
        if self.take("G"):
            always, part = self.window(), self.primary()
            return lambda t: all(part(n) for n in range(end) if always(t, n))
        if self.take("F"):
            some, goal = self.window(), self.primary()
            return lambda t: any(goal(n) for n in range(end) if some(t, n))
        if self.take("O"):
            earlier = self.primary()
            return lambda t: any(earlier(n) for n in range(t))
        if self.tokens[self.at].startswith('"'):
            name = self.next().strip('"')
            return lambda t: self.points[t][name]
        return super().primary()

    def window(self) -> Inside:
        if not self.take("["):
            return lambda t, n: n >= t
        first = self.sum()
        assert self.take(",")
        last = None if self.take("inf") else self.sum()
        closed = self.take("]")
        assert closed or self.take(")")

        def inside(t: int, n: int) -> bool:
            distance = Fraction(self.times[n] - self.times[t])
            if distance < first(t):
                return False
            return last is None or distance < last(t) or (closed and distance == last(t))

        return inside
