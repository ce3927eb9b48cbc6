"""Damaged logs: whatever a disk or a crash does to a log, reading it ends with items or a typed error."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from sleec_runtime.audit.observation import RawMessage
from sleec_runtime.errors import UnreadableLog
from sleec_verify.audit.readers.forms import open_log
from sleec_verify.audit.readers.reader import Unreadable
from sleec_verify.audit.suggestion.log_topics import topics_of
from tests.support.care_robot_log import write_care_robot_log
from tests.support.ros_bags import Entry, write_bag

TEXTS: list[Entry] = [(time, "/a", "std_msgs/msg/String", {"data": "text" * 20}) for time in range(30)]


def damaged(content: bytes, chance: Random) -> bytes:
    """The content with some bytes changed, removed, repeated or cut off."""
    data = bytearray(content)
    for _ in range(chance.choice((1, 1, 2, 5, 30))):
        at, size = chance.randrange(len(data) or 1), chance.randrange(1, 40)
        how = chance.randrange(6)
        if how < 3:
            data[at : at + 1] = chance.randbytes(1)
        elif how == 3:
            data[at : at + 4] = bytes([chance.choice((0, 1, 127, 255))] * 4)
        elif how == 4:
            data[at : at + size] = data[:size] if chance.random() < 0.5 else b""
        else:
            del data[max(1, at) :]
    return bytes(data)


@pytest.fixture(scope="module")
def logs(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    folder = tmp_path_factory.mktemp("logs")
    table = pa.table({"time": [float(n) for n in range(99)], "event": ["E"] * 99, "conditions": ['{"A": true}'] * 99})
    pq.write_table(table, folder / "table.parquet")
    return [
        write_care_robot_log(folder / "whole") / "whole.mcap",
        write_care_robot_log(folder / "rows", "sqlite3") / "rows.db3",
        write_bag(folder / "chunks", TEXTS, "mcap", "storage") / "chunks.mcap",
        folder / "table.parquet",
    ]


@pytest.mark.parametrize("seed", range(2))
def test_reading_a_damaged_log_ends_with_items_or_a_typed_error(seed: int, logs: list[Path], tmp_path: Path) -> None:
    chance = Random(seed)
    contents = {path: path.read_bytes() for path in logs}
    counts = {"items": 0, "unreadable": 0, "refused": 0}
    for number in range(40):
        log = chance.choice(logs)
        path = tmp_path / f"{number}{log.suffix}"
        path.write_bytes(damaged(contents[log], chance))
        try:
            for _, item in open_log(path).read():
                counts["unreadable" if isinstance(item, Unreadable) else "items"] += 1
                if isinstance(item, RawMessage):
                    repr(item.fields)
            topics_of(open_log(path))
        except UnreadableLog as error:
            counts["refused"] += str(path) in error.message
    assert all(counts.values())


def test_damaged_metadata(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", TEXTS, "sqlite3")
    content = (bag / "metadata.yaml").read_bytes()
    problems = []
    for seed in range(60):
        (bag / "metadata.yaml").write_bytes(damaged(content, Random(seed)))
        try:
            for _, item in open_log(bag).read():
                assert isinstance(item, (RawMessage, Unreadable))
        except UnreadableLog as error:
            problems.append(error.message)
    assert problems
    assert all(str(bag) in problem for problem in problems)
