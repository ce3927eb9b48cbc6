"""The transport over DDS between processes: a round trip, a fork, and processes that end or are killed."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from queue import SimpleQueue

import pytest

from sleec_runtime.ros.transport import Topic
from tests.support.dds import PATIENCE, dds_environment, eventually, require_dds, unused_topic
from tests.support.dds import transports as transports
from tests.support.paths import ROOT

require_dds()


class Echo:
    """The other process, see tests/support/dds_echo.py."""

    def __init__(self, transport) -> None:
        self.name = unused_topic()
        self._answers: SimpleQueue[str] = SimpleQueue()
        self.process = subprocess.Popen(
            [sys.executable, "-m", "tests.support.dds_echo", self.name],
            cwd=ROOT,
            env=dds_environment(),
            stderr=subprocess.PIPE,
        )
        transport.subscribe(
            Topic(f"{self.name}/answers", latched=True, depth=100), lambda fields: self._answers.put(fields["data"])
        )
        self.publisher = transport.publisher(Topic(self.name, depth=100))
        assert self.next() == "ready"
        assert eventually(self.publisher.subscription_count)

    def tell(self, text: str) -> None:
        self.publisher.publish({"data": text})

    def next(self) -> str:
        return self._answers.get(timeout=PATIENCE)


@pytest.fixture
def echo(transports) -> Iterator[Echo]:
    echo = Echo(transports())
    yield echo
    echo.process.kill()
    echo.process.communicate()


def test_two_processes_exchange_messages_and_end(echo: Echo) -> None:
    for number in range(50):
        echo.tell(str(number))
    assert [echo.next() for _ in range(50)] == [f"echo: {number}" for number in range(50)]
    echo.tell("end")
    assert echo.process.communicate(timeout=PATIENCE)[1] == b""
    assert echo.process.returncode == 0
    assert eventually(lambda: not echo.publisher.subscription_count())


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs os.fork")
def test_a_forked_process_gets_an_error_and_ends(echo: Echo) -> None:
    echo.tell("fork")
    assert echo.next() == "forked: a DDS transport cannot be used in a forked process, exit 3"
    echo.tell("still here")
    assert echo.next() == "echo: still here"


def test_a_killed_process_does_not_stop_the_others(echo: Echo, transports) -> None:
    other = Echo(transports())
    try:
        echo.process.kill()
        echo.process.wait()
        echo.tell("lost")
        other.tell("delivered")
        assert other.next() == "echo: delivered"
    finally:
        other.process.kill()
        other.process.communicate()
