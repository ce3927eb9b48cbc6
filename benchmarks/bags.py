"""Measure the audit of ROS 2 bags: messages for each second of processor time, and the largest memory.

Each second, a recording has 50 messages with the odometry, 10 with the state of a battery, 2 with that of a user, and 5
camera images. The mapping uses the battery and the user. The memory is to be the same for a recording that is ten times
as long, and images are to cost little.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.audit import measure
from tests.support.care_robot_log import odometry
from tests.support.ros_bags import STORE, Entry, battery, serialized, write_bag

RULES = "RULE privacy WHEN Undressing THEN Wait UNLESS BatteryLow IN WHICH CASE Dock\n"
MAPPING = """\
conditions.BatteryLow = {topic = "/battery_state", field = "percentage", below = 0.2}
events.Undressing = {topic = "/user_state", field = "undressed"}
obligations.Wait = {topic = "/user_state", field = "undressed"}
"""
LENGTHS = (200, 2_000)
"""Seconds."""
_PIXELS = 30_000


def entries(seconds: int, images: bool) -> Iterator[Entry]:
    """The messages of a recording."""
    import numpy as np

    header = battery(0)["header"]
    picture = np.random.default_rng(1).integers(0, 256, _PIXELS, np.uint8)
    image = {"header": header, "height": 100, "width": 100, "encoding": "rgb8", "is_bigendian": 0, "step": 300}
    pixels = serialized("sensor_msgs/msg/Image", {**image, "data": picture})
    position = serialized("nav_msgs/msg/Odometry", odometry(1))
    charge = serialized("sensor_msgs/msg/BatteryState", battery(0.5))
    user = STORE.types["care_msgs/msg/UserState"]
    for second in range(seconds):
        state = vars(user(undressed=second % 60 < 30, is_distressed=False, responsive=True, age=80))
        fields = {name: value for name, value in state.items() if name != "__msgtype__"}
        yield from ((second + n / 50, "/odom", "nav_msgs/msg/Odometry", position) for n in range(50))
        yield from ((second + n / 10, "/battery_state", "sensor_msgs/msg/BatteryState", charge) for n in range(10))
        yield from ((second + n / 2, "/user_state", "care_msgs/msg/UserState", fields) for n in range(2))
        if images:
            yield from ((second + n / 5, "/camera", "sensor_msgs/msg/Image", pixels) for n in range(5))


def main() -> None:
    with TemporaryDirectory() as folder:
        rules, mapping = Path(folder, "rules.sleec"), Path(folder, "mapping.toml")
        rules.write_text(RULES, encoding="utf-8")
        mapping.write_text(MAPPING, encoding="utf-8")
        for plugin, compression in (("mcap", "none"), ("mcap", "storage"), ("sqlite3", "none")):
            for seconds, images in ((LENGTHS[0], True), (LENGTHS[1], False), (LENGTHS[1], True)):
                name = f"{plugin}-{compression}-{seconds}-{images}"
                bag = write_bag(Path(folder, name), entries(seconds, images), plugin, compression)
                size = sum(path.stat().st_size for path in bag.iterdir())
                taken, memory = measure(bag, rules, "--mapping", str(mapping))
                messages = seconds * (67 if images else 62)
                kind = f"{plugin}, chunks compressed" if compression == "storage" else plugin
                pictures = "with images" if images else "without images"
                print(
                    f"{kind:24} {pictures:15} {messages:9,} messages {size / 2**20:6,.0f} MiB "
                    f"{messages / taken:9,.0f} messages/s {memory:5.0f} MiB"
                )
