"""Messages in CDR, as other programs send them over DDS."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from random import Random

from sleec_runtime.ros.dds.cdr import decode, encode
from sleec_runtime.ros.dds.message_types import PRIMITIVES, STANDARD, Items, Message, String
from sleec_runtime.ros.transport_errors import MalformedMessage
from tests.support.ros_messages import random_value

STATUS = Message("test/msg/Status", (("level", PRIMITIVES["byte"]), ("name", String(8)), ("ok", PRIMITIVES["bool"])))
REPORT = Message(
    "test/msg/Report",
    (
        ("statuses", Items(STATUS, 0, fixed=False)),
        ("covariance", Items(PRIMITIVES["float64"], 3, fixed=True)),
        ("ranges", Items(PRIMITIVES["float32"], 0, fixed=False)),
        ("names", Items(String(), 2, fixed=False)),
        ("last", STATUS),
    ),
)
TYPES = (STANDARD["std_msgs/msg/String"], STANDARD["std_msgs/msg/Empty"], STANDARD["std_msgs/msg/Float32"], REPORT)


def cdr(data: bytes, folder: Path) -> None:
    """Bytes are a message or malformed. A message is the same after it is written and read again.

    The first byte of the input chooses the type.
    """
    if not data:
        return
    kind = TYPES[data[0] % len(TYPES)]
    try:
        fields = decode(kind, data[1:])
    except MalformedMessage:
        return
    written = encode(kind, fields)
    assert encode(kind, decode(kind, written)) == written


def cdr_seeds() -> Iterator[bytes]:
    """Messages of each type, and truncated ones."""
    random = Random(0)
    for number, kind in enumerate(TYPES):
        for _ in range(3):
            data = encode(kind, random_value(kind, random))
            yield bytes([number]) + data
            yield bytes([number]) + data[: len(data) // 2]
