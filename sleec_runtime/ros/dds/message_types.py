"""ROS message types: the fields of each message, and their types."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

FieldType: TypeAlias = "Primitive | String | Items | Message"


@dataclass(frozen=True)
class Primitive:
    """A number or a boolean. `code` is its format character in `struct`, and `size` its size in bytes."""

    name: str
    code: str
    size: int


@dataclass(frozen=True)
class String:
    """Text in UTF-8 of at most `bound` bytes; 0 means no bound."""

    bound: int = 0


@dataclass(frozen=True)
class Items:
    """An array of `length` values, or a sequence of at most `length` values; a sequence of 0 has no bound."""

    of: FieldType
    length: int
    fixed: bool


@dataclass(frozen=True)
class Message:
    """A message type, such as `std_msgs/msg/String`, with its fields in order."""

    name: str
    fields: tuple[tuple[str, FieldType], ...]


PRIMITIVES = {
    name: Primitive(name, code, size)
    for name, code, size in (
        ("bool", "?", 1),
        ("byte", "B", 1),
        ("char", "B", 1),
        ("int8", "b", 1),
        ("uint8", "B", 1),
        ("int16", "h", 2),
        ("uint16", "H", 2),
        ("int32", "i", 4),
        ("uint32", "I", 4),
        ("int64", "q", 8),
        ("uint64", "Q", 8),
        ("float32", "f", 4),
        ("float64", "d", 8),
    )
}

STANDARD = {
    message.name: message
    for message in (
        Message("std_msgs/msg/String", (("data", String()),)),
        # IDL does not allow a structure without members, so ROS 2 adds one.
        Message("std_msgs/msg/Empty", (("structure_needs_at_least_one_member", PRIMITIVES["uint8"]),)),
        *(
            Message(f"std_msgs/msg/{name[0].upper()}{name[1:]}".replace("Uint", "UInt"), (("data", primitive),))
            for name, primitive in PRIMITIVES.items()
        ),
    )
}
"""The types that need no type store."""
