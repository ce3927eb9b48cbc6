"""Recordings with other values than rosbags expects: YAML and SQLite may have values of any type everywhere."""

from __future__ import annotations

import re
import sqlite3
from pathlib import Path

import pytest

from sleec_runtime.errors import UnreadableLog
from sleec_verify.audit.readers.forms import open_log
from sleec_verify.audit.readers.reader import IndexedReader, Unreadable
from sleec_verify.audit.suggestion.log_topics import topics_of
from tests.support.ros_bags import Entry, write_bag

TEXT = "std_msgs/msg/String"
ENTRIES: list[Entry] = [(time, topic, TEXT, {"data": "x"}) for time in range(3) for topic in ("/a", "/b")]
COLUMNS = {
    "messages": ("timestamp", "data", "topic_id"),
    "topics": ("name", "type", "serialization_format", "offered_qos_profiles", "type_description_hash"),
    "message_definitions": ("topic_type", "encoding", "encoded_message_definition", "type_description_hash"),
}
CELLS = ("text", "", b"\xff\x00", b"\xed\xa0\x80", 1.5, float("inf"), -1, -(2**63), 2**63 - 1, "9" * 400)
SCALARS = (
    *("abc", "null", "true", "[]", "{}", "[[1]]", "{a: {}}", "2020-01-01", '"\\ud800"', "!!python/object:os.system x"),
    *("-1", "1.5", ".nan", ".inf", "1e400", "9" * 30),
)


def is_read(path: Path) -> bool:
    """Whether a recording can be read, at least in part. Otherwise, it must be refused."""
    reader = open_log(path)
    assert isinstance(reader, IndexedReader)
    try:
        for _, item in reader.read():
            assert isinstance(item, Unreadable) or item.time >= 0
        topics_of(reader)
    except UnreadableLog:
        return False
    assert all(isinstance(topic, str) for topic in reader.topics)
    return True


@pytest.mark.parametrize(("table", "column"), [(table, column) for table in COLUMNS for column in COLUMNS[table]])
def test_cells_of_any_type(table: str, column: str, tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", ENTRIES, "sqlite3")
    content = (bag / "bag.db3").read_bytes()
    for cell in CELLS:
        for rows in ("WHERE rowid = 1", "WHERE rowid = 2", ""):
            (bag / "bag.db3").write_bytes(content)
            database = sqlite3.connect(bag / "bag.db3")
            database.execute(f"UPDATE {table} SET {column} = ? {rows}", [cell])
            database.commit()
            database.close()
            is_read(bag)
            is_read(bag / "bag.db3")


def test_metadata_of_any_type(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", ENTRIES, "sqlite3")
    metadata = bag / "metadata.yaml"
    text = metadata.read_text()
    answers = set()
    for key in dict.fromkeys(re.findall(r"(\w+):", text)):
        for scalar in SCALARS:
            metadata.write_text(re.sub(rf"\b{key}:.*", f"{key}: {scalar}".replace("\\", r"\\"), text))
            answers.add(is_read(bag))
    assert answers == {True, False}
