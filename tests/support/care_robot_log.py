"""A recording of an assistive robot that knows nothing of rules. Its developers chose the names of its topics."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from tests.support.ros_bags import STORE, Entry, battery, write_bag

_TEXT, _EMPTY = "std_msgs/msg/String", "std_msgs/msg/Empty"
_BATTERY = "sensor_msgs/msg/BatteryState"


def write_care_robot_log(path: Path, plugin: str = "mcap") -> Path:
    """Two minutes at home and in hospital. Ann, undressed, asks to open the curtains; later, she says stop."""
    levels = ((2, "low"), (50, "severe"), (90, "moderate"))
    entries: list[Entry] = [
        (0, "/site", _TEXT, {"data": "household"}),
        *((time, "/battery_state", _BATTERY, battery(0.9 - time / 200)) for time in range(0, 120, 5)),
        *((time, "/odom", "nav_msgs/msg/Odometry", odometry(time)) for time in range(0, 120, 2)),
        *((time, "/camera/image_raw", "sensor_msgs/msg/Image", _image()) for time in range(0, 120, 10)),
        *(
            (time, "/user_state", "care_msgs/msg/UserState",
             {"undressed": time < 40, "is_distressed": time > 60, "responsive": True, "age": 81})
            for time in range(1, 120, 7)
        ),
        *((time, "/risk_level", _TEXT, {"data": level}) for time, level in levels),
        (10, "/curtain_open_requests", _EMPTY, {}),
        (55, "/speech/heard", _TEXT, {"data": "user says stop"}),
        (70, "/speech/heard", _TEXT, {"data": "good morning"}),
        *_goals("/open_curtains", 30), *_goals("/stop_robot", 56), *_goals("/refuse_request", 11),
        (60, "/site", _TEXT, {"data": "hospital"}),
        (80, "/preparing_examination", _EMPTY, {}),
        (81, "/private_space_ensured", "std_msgs/msg/Bool", {"data": True}),
    ]  # fmt: skip
    return write_bag(path, sorted(entries, key=lambda entry: entry[0]), plugin)


def _goals(action: str, time: float) -> list[Entry]:
    """A goal of an action that is executed from `time` on and succeeds a second later."""
    import numpy as np

    types = STORE.types
    stamp = types["builtin_interfaces/msg/Time"](sec=int(time), nanosec=0)
    goal = types["unique_identifier_msgs/msg/UUID"](uuid=np.full(16, int(time), np.uint8))
    info = types["action_msgs/msg/GoalInfo"](goal_id=goal, stamp=stamp)
    kind = "action_msgs/msg/GoalStatusArray"
    states = ((time, 2), (time + 1, 4))
    return [
        (at, f"{action}/_action/status", kind, {"status_list": [types["action_msgs/msg/GoalStatus"](info, state)]})
        for at, state in states
    ]


def _header() -> Any:
    return battery(0)["header"]


def _image() -> dict[str, object]:
    import numpy as np

    pixels = np.zeros(64 * 48, np.uint8)
    return {"header": _header(), "height": 48, "width": 64, "encoding": "mono8", "is_bigendian": 0, "step": 64,
            "data": pixels}  # fmt: skip


def odometry(time: float) -> dict[str, object]:
    """The fields of a nav_msgs/msg/Odometry."""
    import numpy as np

    types = STORE.types
    pose = types["geometry_msgs/msg/Pose"](
        types["geometry_msgs/msg/Point"](time / 100, 0.0, 0.0),
        types["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0),
    )
    still = types["geometry_msgs/msg/Vector3"](0.0, 0.0, 0.0)
    unsure = np.zeros(36)
    return {
        "header": _header(),
        "child_frame_id": "base_link",
        "pose": types["geometry_msgs/msg/PoseWithCovariance"](pose, unsure),
        "twist": types["geometry_msgs/msg/TwistWithCovariance"](types["geometry_msgs/msg/Twist"](still, still), unsure),
    }
