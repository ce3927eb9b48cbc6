"""A persistent sequence: a change makes a new one, which shares most of its rows with the old one.

A snapshot of the context is one reference to such a sequence. With n entries in rows of √n, a change of k entries
copies the list of rows and at most k rows: for 10,000 entries, a change of one copies 200 references instead of 10,000.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import isqrt
from typing import Generic, TypeVar

T = TypeVar("T")


class Chunks(Generic[T]):
    """An immutable sequence of fixed length. `rows` is public for callers for which a method call is too slow."""

    __slots__ = ("rows", "width")

    def __init__(self, rows: list[list[T]], width: int) -> None:
        self.rows = rows
        self.width = width

    @classmethod
    def of(cls, items: Iterable[T]) -> Chunks[T]:
        """The sequence of `items`. O(n)."""
        flat = list(items)
        width = isqrt(len(flat)) + 1
        return cls([flat[start : start + width] for start in range(0, len(flat), width)], width)

    def place(self, index: int) -> tuple[int, int]:
        """The row and the column of `index`."""
        return divmod(index, self.width)

    def __getitem__(self, index: int) -> T:
        row, column = divmod(index, self.width)
        return self.rows[row][column]

    def replaced(self, changes: Mapping[int, T]) -> Chunks[T]:
        """The sequence with `changes`. Copies O(k·√n) references for k changes, O(√n) for none."""
        rows = list(self.rows)
        fresh: set[int] = set()
        for index, item in changes.items():
            row, column = divmod(index, self.width)
            if row not in fresh:
                rows[row] = list(rows[row])
                fresh.add(row)
            rows[row][column] = item
        return Chunks(rows, self.width)
