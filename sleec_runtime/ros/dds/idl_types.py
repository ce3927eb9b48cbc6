"""The type of a topic in DDS: its name, and the description of its fields that discovery sends."""

from __future__ import annotations

from functools import cache
from typing import Any

import cyclonedds.idl

from sleec_runtime.ros.dds.message_types import FieldType, Message, Primitive, String

# cyclonedds computes its types in ways that mypy cannot follow.
_idl: Any = cyclonedds.idl
_types: Any = cyclonedds.idl.types
_PRIMITIVES = {"char": _types.uint8, "bool": bool}


@cache
def serialized_type(message: Message) -> Any:
    """The class for the messages of a type, constructed from their bytes, which the attribute `data` has.

    cyclonedds sends and receives these bytes as they are: `cdr.py` checks them more strictly. There is one class for
    each type, because cyclonedds 11 never returns from creating a topic if about 32 classes have the same definition.
    """
    samples = _struct(message)
    samples.__init__ = _keep
    samples.serialize = _serialize
    samples.deserialize = samples.deserialize_key = classmethod(_deserialize)
    return samples


def _keep(self: Any, data: bytes) -> None:
    self.data = data


def _serialize(self: Any, **_options: object) -> bytes:
    data: bytes = self.data
    return data


def _deserialize(cls: Any, /, data: bytes, **_options: object) -> Any:
    return cls(data)


def _struct(message: Message) -> Any:
    package, folder, name = message.name.split("/")
    return _idl.make_idl_struct(
        f"{name}_",
        # As ROS 2 names types in DDS: `std_msgs::msg::dds_::String_`.
        f"{package}.{folder}.dds_.{name}_",
        {field: _field(kind) for field, kind in message.fields},
        dataclassify=False,
    )


def _field(kind: FieldType) -> Any:
    if isinstance(kind, Primitive):
        return _PRIMITIVES.get(kind.name) or getattr(_types, kind.name)
    if isinstance(kind, String):
        return _types.bounded_str[kind.bound] if kind.bound else str
    if isinstance(kind, Message):
        return _struct(kind)
    if kind.fixed:
        return _types.array[_field(kind.of), kind.length]
    return _types.sequence[_field(kind.of), kind.length] if kind.length else _types.sequence[_field(kind.of)]
