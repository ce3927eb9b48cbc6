"""The ids of the last messages, to ignore those that arrive again."""

from __future__ import annotations

from collections import OrderedDict

MOST = 10_000
"""The number of ids that are kept."""


class RecentIds:
    """A set of the last ids."""

    def __init__(self) -> None:
        self._ids: OrderedDict[str, None] = OrderedDict()

    def add(self, one: str | None) -> bool:
        """Whether `one` is new. None always is."""
        if one is None:
            return True
        if one in self._ids:
            return False
        self._ids[one] = None
        if len(self._ids) > MOST:
            self._ids.popitem(last=False)
        return True

    def ids(self) -> list[str]:
        """The ids, the oldest first."""
        return list(self._ids)
