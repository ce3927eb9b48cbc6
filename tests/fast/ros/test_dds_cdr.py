"""Messages in CDR are the same bytes as those of rosbags and of cyclonedds; other bytes are refused."""

from __future__ import annotations

import struct

import pytest

from sleec_runtime.ros.dds.cdr import decode, encode
from sleec_runtime.ros.dds.message_types import STANDARD
from sleec_runtime.ros.dds.type_store import TypeStore
from sleec_runtime.ros.transport_errors import (
    InvalidDefinition,
    MalformedMessage,
    TransportUnavailable,
    UnknownMessageType,
    WrongFields,
)
from tests.support.dds import require_dds
from tests.support.ros_messages import compare_bytes

require_dds()

TYPES = (
    *STANDARD,
    "std_msgs/msg/Header",
    "std_msgs/msg/ColorRGBA",
    "std_msgs/msg/Float64MultiArray",
    "action_msgs/msg/GoalStatusArray",
    "diagnostic_msgs/msg/DiagnosticArray",
    "geometry_msgs/msg/PoseStamped",
    "geometry_msgs/msg/Twist",
    "nav_msgs/msg/Odometry",
    "rcl_interfaces/msg/ParameterEvent",
    "sensor_msgs/msg/BatteryState",
    "sensor_msgs/msg/Image",
    "sensor_msgs/msg/JointState",
    "sensor_msgs/msg/LaserScan",
    "sensor_msgs/msg/Range",
    "shape_msgs/msg/SolidPrimitive",
    "visualization_msgs/msg/MenuEntry",
)


@pytest.mark.parametrize("name", TYPES)
def test_bytes_are_those_of_rosbags_and_cyclonedds(name: str) -> None:
    compare_bytes(name, samples=3)


GRIP = "bool[3] fingers\nint8 left\nfloat64[<=2] forces\nstring<=4 note\nuint8 OPEN=1\nstd_msgs/Header header\n"


def test_own_types_have_defaults_and_bounds() -> None:
    message = TypeStore("humble", {"my_msgs/msg/Grip": GRIP}).message("my_msgs/msg/Grip")
    header = {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": ""}
    defaults = {"fingers": [False] * 3, "left": 0, "forces": [], "note": "", "header": header}
    assert decode(message, encode(message, {})) == defaults
    given = {"fingers": (True, False, True), "forces": [1, 2.5], "note": "äö", "header": {"frame_id": "hand"}}
    assert decode(message, encode(message, given))["header"] == {**header, "frame_id": "hand"}


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"right": 1}, "has no field 'right'"),
        ({"left": 128}, "field 'left' is int8; got 128"),
        ({"left": True}, "field 'left' is int8; got True"),
        ({"left": 0.5}, "field 'left' is int8; got 0.5"),
        ({"fingers": [True]}, "field 'fingers' is a list of 3 values; got [True]"),
        ({"fingers": [0, 1, 0]}, "field 'fingers' is bool; got 0"),
        ({"forces": [1.0] * 3}, "a list of at most 2 values"),
        ({"forces": "ab"}, "field 'forces' is a list; got 'ab'"),
        ({"note": b"x"}, "field 'note' is text; got b'x'"),
        ({"note": "\ud800"}, "field 'note' is text in UTF-8"),
        ({"note": "äöü"}, "text of at most 4 bytes"),
        ({"header": {"stamp": {"sec": "now"}}}, "field 'header.stamp.sec' is int32; got 'now'"),
        ({"header": 1}, "field 'header' is a mapping of fields; got 1"),
    ],
)
def test_fields_that_do_not_fit_are_refused(fields: dict[str, object], message: str) -> None:
    with pytest.raises(WrongFields) as caught:
        encode(TypeStore("jazzy", {"my_msgs/msg/Grip": GRIP}).message("my_msgs/msg/Grip"), fields)
    assert message in caught.value.message


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"\0\1\0",
        b"\0\7\0\0\2\0\0\0a\0",
        b"\0\1\0\0\0\0\0\0",
        b"\0\1\0\0\2\0\0\0ab",
        b"\0\1\0\0\xff\xff\xff\xffa\0",
        b"\0\1\0\0\2\0\0\0\xff\0",
        b"\0\1\0\0\2\0\0\0a\0\0\0\0\0",
    ],
    ids=["empty", "short", "XCDR2", "no-terminator", "unterminated", "truncated", "not-UTF-8", "too-long"],
)
def test_malformed_bytes_are_refused(data: bytes) -> None:
    with pytest.raises(MalformedMessage):
        decode(STANDARD["std_msgs/msg/String"], data)


def test_a_short_message_cannot_claim_a_long_list() -> None:
    message = TypeStore("jazzy", {}).message("diagnostic_msgs/msg/DiagnosticArray")
    data = encode(message, {})
    with pytest.raises(MalformedMessage, match="truncated"):
        decode(message, data[:-4] + struct.pack("<I", 0xFFFFFFFF))


def test_types_without_a_definition_are_named() -> None:
    types = TypeStore("jazzy", {})
    with pytest.raises(UnknownMessageType, match=r"did you mean `sensor_msgs/msg/BatteryState`\?"):
        types.message("sensor_msgs/msg/BateryState")
    with pytest.raises(UnknownMessageType, match=r"\.msg"):
        types.message("my_msgs/msg/Grip")
    with pytest.raises(InvalidDefinition, match="'my_msgs/msg/Grip' is invalid"):
        TypeStore("jazzy", {"my_msgs/msg/Grip": "float64 = ?"}).message("my_msgs/msg/Grip")
    with pytest.raises(TransportUnavailable, match="set ROS_DISTRO"):
        TypeStore("rolling-2031", {}).message("std_msgs/msg/Header")
