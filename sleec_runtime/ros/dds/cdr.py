"""Messages as bytes in plain CDR (XCDR1), which ROS 2 uses on the wire.

Source: OMG, DDS-RTPS 2.5, Section 10 (encapsulation), and DDS-XTypes 1.3, Section 7.4.3 (PLAIN_CDR). Each primitive
is aligned to its size, counted from the end of the header. A header of 4 bytes names the byte order.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from typing import Any

from sleec_runtime.ros.dds.message_types import FieldType, Items, Message, Primitive, String
from sleec_runtime.ros.transport_errors import MalformedMessage, WrongFields
from sleec_runtime.support.messages import represent

_BIG, _LITTLE = b"\x00\x00", b"\x00\x01"
"""The kinds of header: big endian and little endian."""


def encode(message: Message, fields: Mapping[str, object]) -> bytes:
    """A message in little endian. Fields that are not given have the default of ROS: 0, false or empty.

    Raises WrongFields for an unknown field, or a value that does not fit its field.
    """
    data = bytearray()
    _write(data, message, fields, "")
    return _LITTLE + b"\x00\x00" + data


def decode(message: Message, data: bytes) -> dict[str, object]:
    """The fields of a message. Raises MalformedMessage for anything but the bytes of one message and their padding."""
    if data[:2] not in (_BIG, _LITTLE) or len(data) < 4:
        raise MalformedMessage(f"not a message in plain CDR: its header is {data[:4].hex() or 'missing'}")
    reader = _Reader(data, "<" if data[:2] == _LITTLE else ">")
    fields: dict[str, object] = reader.read(message)
    if reader.left > 3:
        raise MalformedMessage(f"{reader.left} bytes follow a message of type {message.name!r}")
    return fields


def _write(data: bytearray, kind: FieldType, value: Any, path: str) -> None:
    """Adds a value to the data. `path` names its field in messages."""
    if isinstance(kind, Primitive):
        _write_primitives(data, kind, (value,), path)
    elif isinstance(kind, String):
        _write_string(data, kind, value, path)
    elif isinstance(kind, Items):
        _write_items(data, kind, value, path)
    else:
        if not isinstance(value, Mapping):
            raise _misfit(path, "a mapping of fields", value)
        names = dict(kind.fields)
        for name in value:
            if name not in names:
                raise WrongFields(f"message type {kind.name!r} has no field {name!r}", f"it has {', '.join(names)}")
        for name, field in kind.fields:
            _write(data, field, value[name] if name in value else _default(field), f"{path}.{name}" if path else name)


def _write_primitives(data: bytearray, kind: Primitive, values: Sequence[Any], path: str) -> None:
    for value in values:
        if isinstance(value, bool) != (kind.code == "?"):
            raise _misfit(path, kind.name, value)
    data += bytes(-len(data) % kind.size)
    try:
        data += struct.pack(f"<{len(values)}{kind.code}", *values)
    except (struct.error, OverflowError, TypeError) as error:
        raise _misfit(path, kind.name, values[0] if len(values) == 1 else values) from error


def _write_string(data: bytearray, kind: String, value: object, path: str) -> None:
    if not isinstance(value, str):
        raise _misfit(path, "text", value)
    try:
        text = value.encode()
    except UnicodeEncodeError as error:
        raise _misfit(path, "text in UTF-8", value) from error
    if kind.bound and len(text) > kind.bound:
        raise _misfit(path, f"text of at most {kind.bound} bytes", value)
    data += bytes(-len(data) % 4)
    data += struct.pack("<I", len(text) + 1)
    data += text
    data.append(0)


def _write_items(data: bytearray, kind: Items, value: Any, path: str) -> None:
    if isinstance(value, (str, Mapping)) or not hasattr(value, "__len__") or not hasattr(value, "__iter__"):
        raise _misfit(path, "a list", value)
    if kind.fixed and len(value) != kind.length:
        raise _misfit(path, f"a list of {kind.length} values", value)
    if not kind.fixed:
        if kind.length and len(value) > kind.length:
            raise _misfit(path, f"a list of at most {kind.length} values", value)
        data += bytes(-len(data) % 4)
        data += struct.pack("<I", len(value))
    if isinstance(kind.of, Primitive):
        # An empty sequence has no padding for its values.
        if len(value):
            _write_primitives(data, kind.of, value, path)
    else:
        for number, one in enumerate(value):
            _write(data, kind.of, one, f"{path}[{number}]")


def _default(kind: FieldType) -> object:
    if isinstance(kind, Primitive):
        return False if kind.code == "?" else 0
    if isinstance(kind, String):
        return ""
    if isinstance(kind, Items):
        return [_default(kind.of)] * kind.length if kind.fixed else []
    return {}


def _misfit(path: str, expected: str, value: object) -> WrongFields:
    return WrongFields(f"field {path!r} is {expected}; got {represent(value)}" if path else f"a message is {expected}")


def _shortest(value: float) -> float:
    """The float that prints as the shortest decimal of a `float32`: 0.2, not 0.20000000298. Rules have decimals."""
    for digits in (6, 7, 8):
        decimal = float(f"{value:.{digits}g}")
        if struct.unpack("<f", struct.pack("<f", decimal))[0] == value:
            return decimal
    return float(f"{value:.9g}")


class _Reader:
    """Reads values from the bytes of a message, and never beyond their end."""

    def __init__(self, data: bytes, order: str) -> None:
        self._data = data
        self._order = order
        self._at = 4

    @property
    def left(self) -> int:
        """The number of bytes that are not read yet."""
        return len(self._data) - self._at

    def read(self, kind: FieldType) -> Any:
        if isinstance(kind, Primitive):
            return self._primitives(kind, 1)[0]
        if isinstance(kind, String):
            return self._string(kind)
        if isinstance(kind, Items):
            return self._items(kind)
        return {name: self.read(field) for name, field in kind.fields}

    def _primitives(self, kind: Primitive, count: int) -> tuple[Any, ...]:
        self._at += -(self._at - 4) % kind.size
        start = self._at
        self._skip(count * kind.size)
        values = struct.unpack_from(f"{self._order}{count}{kind.code}", self._data, start)
        return tuple(map(_shortest, values)) if kind.code == "f" else values

    def _skip(self, size: int) -> None:
        if size > self.left:
            raise MalformedMessage(
                f"the message is truncated: byte {self._at + size:,} of {len(self._data):,} is missing"
            )
        self._at += size

    def _count(self) -> int:
        self._at += -(self._at - 4) % 4
        start = self._at
        self._skip(4)
        count: int = struct.unpack_from(f"{self._order}I", self._data, start)[0]
        # Each character and each value takes at least one byte.
        if count > self.left:
            raise MalformedMessage(f"the message is truncated: {count:,} values follow in {self.left:,} bytes")
        return count

    def _string(self, kind: String) -> str:
        size = self._count()
        text = self._data[self._at : self._at + size]
        self._at += size
        if not text or text[-1] or (kind.bound and size > kind.bound + 1):
            raise MalformedMessage("a text has no end, or is longer than its bound")
        try:
            return str(text[:-1], "utf-8")
        except UnicodeDecodeError as error:
            raise MalformedMessage("a text is not UTF-8") from error

    def _items(self, kind: Items) -> list[Any]:
        count = kind.length if kind.fixed else self._count()
        if not kind.fixed and kind.length and count > kind.length:
            raise MalformedMessage(f"a sequence of at most {kind.length} values has {count:,}")
        if isinstance(kind.of, Primitive):
            return list(self._primitives(kind.of, count)) if count else []
        return [self.read(kind.of) for _ in range(count)]
