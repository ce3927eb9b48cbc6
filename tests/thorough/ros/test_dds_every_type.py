"""Messages of every type that ROS 2 Jazzy ships are the same bytes as those of rosbags and of cyclonedds."""

from __future__ import annotations

from tests.support.dds import require_dds
from tests.support.ros_messages import compare_bytes

require_dds()


def test_bytes_of_every_type() -> None:
    from rosbags.typesys import Stores, get_typestore

    names = sorted(get_typestore(Stores.ROS2_JAZZY).fielddefs)
    assert len(names) > 150
    for name in names:
        compare_bytes(name, samples=1)
