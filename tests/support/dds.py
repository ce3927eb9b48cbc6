"""Transports over DDS on loopback, in a domain and on topics that no other test uses."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from itertools import count

import pytest

from sleec_runtime.ros.dds.environment import LOOPBACK
from sleec_runtime.ros.dds.transport import DdsTransport

PATIENCE = 20.0
"""Seconds after which a test gives up."""

_topics = count()


def require_dds() -> None:
    """Skips the tests of a module without the extra `dds`. With CI=true, they fail, because the lock has it."""
    if os.environ.get("CI") != "true":
        pytest.importorskip("cyclonedds", reason="needs the extra `dds` of sleec-runtime")
        pytest.importorskip("rosbags", reason="needs the extra `dds` of sleec-runtime")


def unused_domain() -> int:
    """A DDS domain for the tests of this process."""
    return 1 + os.getpid() % 89  # the evaluation uses those from 90 on


def unused_topic() -> str:
    """The name of a topic that no other test uses, also not one of another process in the same domain."""
    return f"/test_{os.getpid()}_{next(_topics)}"


def dds_environment() -> dict[str, str]:
    """The environment of this process, with discovery on loopback in the domain of its tests."""
    return {**os.environ, "CYCLONEDDS_URI": LOOPBACK, "ROS_DOMAIN_ID": str(unused_domain())}


def eventually(condition: Callable[[], object]) -> bool:
    """Whether a condition becomes true while a test waits."""
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            return False
        time.sleep(0.005)
    return True


@pytest.fixture
def transports(monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., DdsTransport]]:
    """Makes transports, and closes them at the end."""
    for name, value in dds_environment().items():
        monkeypatch.setenv(name, value)
    made: list[DdsTransport] = []

    def make(**options: object) -> DdsTransport:
        made.append(DdsTransport(**options))  # type: ignore[arg-type]
        return made[-1]

    yield make
    for transport in made:
        transport.close()
