"""Memoization: queries that are computed once for an object."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

_Self = TypeVar("_Self", bound="Memo")
_Answer = TypeVar("_Answer")


class Memo:
    """An object that stores the answers of queries about it."""

    def __init__(self) -> None:
        self._answers: dict[Callable[[Any], object], object] = {}

    def once(self: _Self, query: Callable[[_Self], _Answer]) -> _Answer:
        """The answer of a query about this object, which is computed at the first call only."""
        if query not in self._answers:
            self._answers[query] = query(self)
        return cast("_Answer", self._answers[query])
