"""The recorder: what it writes can be audited, and what it cannot write is missing in a visible way."""

from __future__ import annotations

import errno
import math
import os
import subprocess
import sys
from fractions import Fraction
from pathlib import Path
from textwrap import dedent

import pytest

from sleec_runtime.audit.observation import RawMessage
from sleec_runtime.errors import UnwritableLog
from sleec_runtime.ros.in_process import Network
from sleec_runtime.ros.monitoring.recorder_node import RecorderNode
from sleec_runtime.ros.transport import Topic
from sleec_runtime.timed.clocks import VirtualClock
from sleec_verify.audit.readers.json_lines import JsonLines
from sleec_verify.audit.readers.reader import Item, Unreadable

BATTERY = Topic("/battery_state", "sensor_msgs/msg/BatteryState")
NEWS = Topic("/news")
START = Fraction("1790000000.25")


class Recording:
    """A recorder in a network of this process."""

    def __init__(self, path: Path, append: bool = False) -> None:
        self.network = Network()
        self.clock = VirtualClock(START)
        self.recorder = RecorderNode(self.network.transport(), path, (BATTERY, NEWS), clock=self.clock, append=append)
        self.path = path

    def send(self, topic: Topic, fields: object) -> None:
        self.network.transport().publisher(topic).publish(fields)  # type: ignore[arg-type]
        self.network.deliver()

    def items(self) -> list[Item]:
        return [item for _, item in JsonLines(self.path).read()]


def test_messages_are_recorded_when_they_arrive(tmp_path: Path) -> None:
    recording = Recording(tmp_path / "log.jsonl")
    recording.send(BATTERY, {"percentage": 0.4, "cell_voltage": [3.3, 3.4], "header": {"frame_id": "é\ud800\n"}})
    recording.clock.advance(Fraction("0.125"))
    recording.send(NEWS, {"data": "{}"})
    # Each line is in the file before the next message.
    first, second = recording.items()
    assert isinstance(first, RawMessage)
    assert first.fields["header"] == {"frame_id": "é\ud800\n"}
    assert (first.time, first.topic, first.type) == (START, BATTERY.name, BATTERY.type)
    assert second == RawMessage(START + Fraction(1, 8), NEWS.name, NEWS.type, {"data": "{}"})
    recording.recorder.close()
    recording.send(NEWS, {"data": "{}"})
    assert recording.recorder.recorded == 2 == len(recording.items())


def test_a_file_is_overwritten_by_nobody_and_continued_when_asked(tmp_path: Path) -> None:
    path = tmp_path / "log.jsonl"
    recording = Recording(path)
    recording.send(NEWS, {"data": "1"})
    recording.recorder.close()
    with pytest.raises(UnwritableLog, match=r"log\.jsonl exists"):
        Recording(path)
    # A recorder that was killed left a part of a line.
    with open(path, "a", encoding="utf-8") as file:
        file.write('{"time": 17900')
    again = Recording(path, append=True)
    again.send(NEWS, {"data": "2"})
    one, part, two = again.items()
    assert isinstance(part, Unreadable)
    assert [item.fields for item in (one, two) if isinstance(item, RawMessage)] == [{"data": "1"}, {"data": "2"}]


def test_a_log_needs_a_place(tmp_path: Path) -> None:
    for path in (tmp_path / "missing" / "log.jsonl", tmp_path, Path("/dev/null"), Path("a\0b")):
        with pytest.raises(UnwritableLog, match=r"cannot be written|exists|is not a regular file"):
            Recording(path, append=True)


@pytest.mark.parametrize(
    ("fields", "problem"),
    [
        ({"image": b"\x00" * 10}, "has no form in JSON"),
        ({"deep": eval("[" * 90 + "0" + "]" * 90)}, None),
        ({"value": 10**5000}, "has no form in JSON"),
        ("text", "not a mapping of fields"),
        ({"image": list(range(300))}, "longer than"),
        ({"value": math.nan, "other": [math.inf]}, None),
    ],
)
def test_a_message_that_has_no_form_is_counted_as_lost(
    tmp_path: Path,
    fields: object,
    problem: str | None,
    caplog: pytest.LogCaptureFixture,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("sleec_runtime.ros.monitoring.recorder_node.LONGEST_LINE", 1_000)
    recording = Recording(tmp_path / "log.jsonl")
    for _ in range(3):
        recording.send(NEWS, fields)
    recording.send(NEWS, {"data": "next"})
    items = recording.items()
    if problem is None:
        assert len(items) == 4
        assert not caplog.records
        return
    (record,) = caplog.records
    assert "a message on /news cannot be recorded" in record.getMessage()
    assert problem in record.getMessage()
    assert recording.recorder.lost.total() == 3
    message, loss = items
    assert isinstance(message, RawMessage)
    assert isinstance(loss, Unreadable)
    assert "the recorder lost 3 messages" in loss.message


def test_a_write_that_fails_in_the_middle_spoils_one_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    recording = Recording(tmp_path / "log.jsonl")
    write, budget = os.write, 10

    def limited(file: int, data: bytes) -> int:
        nonlocal budget
        if not budget:
            raise OSError(errno.ENOSPC, "No space left on device")
        count = write(file, data[:budget])
        budget -= count
        return count

    recording.send(NEWS, {"data": "1"})
    with monkeypatch.context() as patched:
        patched.setattr(os, "write", limited)
        for number in (2, 3):
            recording.send(NEWS, {"data": str(number)})
    recording.send(NEWS, {"data": "4"})
    one, part, four, loss = recording.items()
    assert isinstance(part, Unreadable)
    assert isinstance(loss, Unreadable)
    assert "lost 2 messages" in loss.message
    assert [item.fields["data"] for item in (one, four) if isinstance(item, RawMessage)] == ["1", "4"]


def test_a_recorder_that_is_killed_has_written_all_that_it_received(tmp_path: Path) -> None:
    program = """
        import os, sys
        from sleec_runtime.ros import Network, RecorderNode, Topic

        topic, network = Topic("/news"), Network()
        recorder = RecorderNode(network.transport(), sys.argv[1], [topic])
        for number in range(5):
            network.transport().publisher(topic).publish({"data": str(number)})
            network.deliver()
        os._exit(9)
    """
    path = tmp_path / "log.jsonl"
    subprocess.run([sys.executable, "-c", dedent(program), path], timeout=60, check=False)
    assert [item.fields["data"] for _, item in JsonLines(path).read() if isinstance(item, RawMessage)] == [*"01234"]


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no limit on the size of files")
def test_a_full_disk_is_reported_once_and_the_node_continues(tmp_path: Path) -> None:
    """The limit on the size of files, in a process of its own, stands for a full disk."""
    program = """
        import resource, sys
        from sleec_runtime.ros.in_process import Network
        from sleec_runtime.ros.monitoring.recorder_node import RecorderNode
        from sleec_runtime.ros.transport import Topic
        from sleec_runtime.timed.clocks import VirtualClock

        topic, network = Topic("/news"), Network()
        recorder = RecorderNode(network.transport(), sys.argv[1], [topic], clock=VirtualClock())
        publisher = network.transport().publisher(topic)
        resource.setrlimit(resource.RLIMIT_FSIZE, (500, resource.RLIM_INFINITY))
        for number in range(20):
            publisher.publish({"data": str(number)})
            network.deliver()
        resource.setrlimit(resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY,) * 2)
        publisher.publish({"data": "last"})
        network.deliver()
        print(recorder.recorded, recorder.lost.total())
    """
    path = tmp_path / "log.jsonl"
    run = subprocess.run(
        [sys.executable, "-c", dedent(program), path], capture_output=True, text=True, timeout=60, check=True
    )
    recorded, lost = map(int, run.stdout.split())
    items = [item for _, item in JsonLines(path).read()]
    assert 0 < lost < 20
    assert recorded + lost == 21
    assert sum(isinstance(item, RawMessage) for item in items) == recorded
    assert any(isinstance(item, Unreadable) and f"lost {lost} messages" in item.message for item in items)
    assert run.stderr.count("cannot be written") == 1
