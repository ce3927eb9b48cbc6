"""Random ROS messages, and their values in rosbags and in cyclonedds."""

from __future__ import annotations

import struct
from random import Random
from types import SimpleNamespace
from typing import Any

import pytest

from sleec_runtime.ros.dds.cdr import decode, encode
from sleec_runtime.ros.dds.message_types import FieldType, Items, Message, Primitive, String
from sleec_runtime.ros.dds.type_store import TypeStore
from sleec_runtime.ros.transport_errors import MalformedMessage

_TEXTS = ("", "a", "map", "Grüße, Pepper 🤖", "x" * 37)


def random_value(kind: FieldType, random: Random) -> Any:
    """A value of a field."""
    if isinstance(kind, Primitive):
        return _random_number(kind, random)
    if isinstance(kind, String):
        return random.choice(_TEXTS).encode()[: kind.bound or None].decode(errors="ignore")
    if isinstance(kind, Items):
        length = kind.length if kind.fixed else random.randrange(min(kind.length or 4, 4))
        return [random_value(kind.of, random) for _ in range(length)]
    return {name: random_value(field, random) for name, field in kind.fields}


def _random_number(kind: Primitive, random: Random) -> Any:
    if kind.code == "?":
        return random.random() < 0.5
    if kind.code == "f":
        import numpy

        # The shortest decimal of a value of 32 bits, which reading gives back.
        return float(str(numpy.float32(random.choice((0.0, float("-inf"), 0.2, random.gauss(0, 1e6))))))
    if kind.code == "d":
        return random.choice((0.0, -0.0, random.gauss(0, 1e9), float("inf"), 5e-324))
    return struct.unpack(kind.code, random.randbytes(kind.size))[0]


def rosbags_value(store: Any, kind: FieldType, value: Any) -> Any:
    """A value as rosbags has it."""
    import numpy

    if isinstance(kind, Message):
        return store.types[kind.name](**{name: rosbags_value(store, field, value[name]) for name, field in kind.fields})
    if isinstance(kind, Items):
        if isinstance(kind.of, Primitive):
            return numpy.array(value, dtype=numpy.dtype(kind.of.code))
        return [rosbags_value(store, kind.of, one) for one in value]
    if isinstance(kind, Primitive) and kind.name == "byte":
        # An octet, which rosbags takes as a number with a sign.
        return struct.unpack("b", bytes([value]))[0]
    return value


def cyclonedds_value(kind: FieldType, value: Any) -> Any:
    """A value as the serialiser of cyclonedds reads it: the fields of a message are attributes."""
    if isinstance(kind, Message):
        return SimpleNamespace(**{name: cyclonedds_value(field, value[name]) for name, field in kind.fields})
    if isinstance(kind, Items):
        return [cyclonedds_value(kind.of, one) for one in value]
    return value


def compare_bytes(name: str, samples: int) -> None:
    """Compares the bytes of random messages of a type of ROS 2 Jazzy with those of rosbags and of cyclonedds, and
    reads them back, in both byte orders and truncated."""
    from rosbags.typesys import Stores, get_typestore

    from sleec_runtime.ros.dds.idl_types import serialized_type

    store = get_typestore(Stores.ROS2_JAZZY)
    message = TypeStore("jazzy", {}).message(name)
    idl = serialized_type(message).__idl__
    random = Random(name)
    for _ in range(samples):
        fields = random_value(message, random)
        data = encode(message, fields)
        value = rosbags_value(store, message, fields)
        assert data == bytes(store.serialize_cdr(value, name, little_endian=True))
        assert data == idl.serialize(cyclonedds_value(message, fields), use_version_2=False)
        assert decode(message, data) == fields
        assert decode(message, bytes(store.serialize_cdr(value, name, little_endian=False))) == fields
        for size in range(0, len(data), 1 + len(data) // 50):
            with pytest.raises(MalformedMessage):
                decode(message, data[:size])
