"""The fields of decoded ROS messages as plain values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from rosbags.interfaces import Nodetype
from rosbags.typesys.base import normalize_fieldname

if TYPE_CHECKING:
    from rosbags.typesys.store import Typestore

_OF_EMPTY = "structure_needs_at_least_one_member"
"""The member that ROS adds to messages without fields."""


class MessageFields(Mapping[str, object]):
    """The fields of a message that rosbags has decoded. Fields are converted lazily, so unused fields, such as
    the pixels of an image, cost no time.

    A `float32` is converted to its shortest decimal that round-trips: 0.2, not 0.20000000298.
    """

    __slots__ = ("_message", "_types", "_values")

    def __init__(self, message: Any, store: Typestore) -> None:
        self._message = message
        self._types = store
        self._values = store.fielddefs[message.__msgtype__][1]

    def __getitem__(self, name: str) -> object:
        for field, (form, description) in self._values:
            if field == name != _OF_EMPTY:
                value = getattr(self._message, normalize_fieldname(name))
                is_single = form == Nodetype.BASE and description[0] == "float32"
                return _shortest(value) if is_single else self._plain(value)
        raise KeyError(name)

    def __contains__(self, name: object) -> bool:
        return any(field == name != _OF_EMPTY for field, _ in self._values)

    def __iter__(self) -> Iterator[str]:
        return (name for name, _ in self._values if name != _OF_EMPTY)

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __repr__(self) -> str:
        return repr(dict(self))

    def _plain(self, value: Any) -> object:
        """Booleans, numbers, strings, and lists and mappings of these."""
        if isinstance(value, (bool, int, float, str)):
            return value
        if isinstance(value, np.ndarray):
            return [_shortest(item) for item in value] if value.dtype == np.float32 else value.tolist()
        if isinstance(value, list):
            return [self._plain(item) for item in value]
        return MessageFields(value, self._types)


def _shortest(value: float) -> float:
    """The float that prints as the shortest decimal of the `float32` nearest to `value`."""
    return float(str(np.float32(value)))
