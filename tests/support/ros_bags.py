"""ROS 2 bags, written with the writers of rosbags."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

OWN_TYPES = {
    "care_msgs/msg/Person": "string name\nfloat32 distance\nbool class\nuint8[] picture\nfloat32[] scores\n",
    "care_msgs/msg/UserState": "bool undressed\nbool is_distressed\nbool responsive\nuint8 age\n",
    "care_msgs/msg/People": "std_msgs/Header header\ncare_msgs/Person[] people\n",
}
"""Message types that no distribution of ROS has."""


def type_store() -> Any:
    """The standard types and our own ones."""
    store = get_typestore(Stores.LATEST)
    for name, definition in OWN_TYPES.items():
        store.register(get_types_from_msg(definition, name))
    return store


STORE = type_store()


def serialized(kind: str, fields: Mapping[str, object]) -> bytes:
    """A message in the encoding of ROS 2. `fields` are all fields of its type."""
    return bytes(STORE.serialize_cdr(STORE.types[kind](**fields), kind))


Entry = tuple[float, str, str, "Mapping[str, object] | bytes"]
"""Time in seconds, topic, type, and the fields or the serialized message."""


def write_bag(path: Path, entries: Iterable[Entry], plugin: str = "mcap", compression: str = "none") -> Path:
    """Write a recording to the folder `path`, and return it. `compression` is none, message, file or storage."""
    writer = Writer(path, version=9, storage_plugin=StoragePlugin[plugin.upper()])
    if compression != "none":
        writer.set_compression(CompressionMode[compression.upper()], CompressionFormat.ZSTD)
    with writer:
        connections: dict[tuple[str, str], Any] = {}
        for time, topic, kind, content in entries:
            if (topic, kind) not in connections:
                connections[topic, kind] = writer.add_connection(topic, kind, typestore=STORE)
            data = content if isinstance(content, bytes) else serialized(kind, content)
            writer.write(connections[topic, kind], round(time * 10**9), data)
    return path


def battery(percentage: float) -> dict[str, object]:
    """The fields of a sensor_msgs/msg/BatteryState."""
    import numpy as np

    header = STORE.types["std_msgs/msg/Header"](
        stamp=STORE.types["builtin_interfaces/msg/Time"](sec=0, nanosec=0), frame_id=""
    )
    nothing = np.zeros(0, np.float32)
    numbers = dict.fromkeys(("voltage", "temperature", "current", "charge", "capacity", "design_capacity"), 0.0)
    states = dict.fromkeys(("power_supply_status", "power_supply_health", "power_supply_technology"), 0)
    return {
        "header": header,
        **numbers,
        "percentage": percentage,
        **states,
        "present": True,
        "cell_voltage": nothing,
        "cell_temperature": nothing,
        "location": "",
        "serial_number": "",
    }
