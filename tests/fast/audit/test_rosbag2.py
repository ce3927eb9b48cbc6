"""The reader of ROS 2 bags."""

from __future__ import annotations

import shutil
import sqlite3
from fractions import Fraction
from pathlib import Path
from random import Random

import pytest

from sleec_runtime.audit.observation import RawMessage
from sleec_runtime.errors import UnreadableLog
from sleec_verify.audit.readers.reader import Item, Unreadable
from sleec_verify.audit.readers.rosbag2 import RosBag
from tests.support.cli import Cli
from tests.support.ros_bags import STORE, Entry, battery, write_bag

TEXT = "std_msgs/msg/String"
MAPPING = '[events]\nCall = {topic = "/call"}\n'
FALL = 'Fall = {topic = "/fall"}\n'
ENTRIES: list[Entry] = [
    (1.5, "/conditions", TEXT, {"data": "first"}),
    (1.5, "/conditions", TEXT, {"data": "second"}),
    (2, "/battery_state", "sensor_msgs/msg/BatteryState", battery(0.2)),
    (2, "/call", "std_msgs/msg/Empty", {}),
    (3.000000001, "/conditions", TEXT, {"data": "third"}),
]


def items(reader: RosBag) -> list[Item]:
    return [item for _, item in reader.read()]


def texts(found: list[Item]) -> list[object]:
    return [item.fields["data"] for item in found if isinstance(item, RawMessage)]


def long_texts() -> list[Entry]:
    """Messages that cannot be compressed, so that a recording has several chunks."""
    texts = (Random(time).randbytes(400_000).hex() for time in range(4))
    return [(time, "/a", TEXT, {"data": f"{time}{text}"}) for time, text in enumerate(texts)]


@pytest.mark.parametrize(
    ("plugin", "compression"),
    [("mcap", "none"), ("mcap", "storage"), ("mcap", "message"), ("sqlite3", "none"), ("sqlite3", "message"),
     ("sqlite3", "file")],
)  # fmt: skip
def test_messages_have_the_fields_and_times_of_the_recording(plugin: str, compression: str, tmp_path: Path) -> None:
    found = items(RosBag(write_bag(tmp_path / "bag", ENTRIES, plugin, compression)))
    messages = [item for item in found if isinstance(item, RawMessage)]
    assert len(messages) == len(found) == len(ENTRIES)
    assert [m.time for m in messages] == [Fraction(3, 2), Fraction(3, 2), 2, 2, 3 + Fraction(1, 10**9)]
    assert [(m.topic, m.type) for m in messages] == [(topic, kind) for _, topic, kind, _ in ENTRIES]
    assert messages[0].fields == {"data": "first"}
    # Written as a float32, of which the nearest float is 0.20000000298…
    assert messages[2].fields["percentage"] == 0.2
    assert messages[2].fields["header"] == {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": ""}
    assert messages[3].fields == {}


@pytest.mark.parametrize("plugin", ["mcap", "sqlite3"])
def test_single_files_need_no_folder(plugin: str, tmp_path: Path) -> None:
    whole = items(RosBag(write_bag(tmp_path / "bag", ENTRIES, plugin)))
    (file,) = (path for path in (tmp_path / "bag").iterdir() if path.suffix != ".yaml")
    # A name with characters that have a meaning in the URI of a database.
    alone = file.rename(tmp_path / f"a ?#%20b{file.suffix}")
    assert items(RosBag(alone)) == whole


def test_types_of_the_recording_are_read_from_it(tmp_path: Path) -> None:
    import numpy as np

    person = STORE.types["care_msgs/msg/Person"](
        name="Ann", distance=1.1, class_=True, picture=np.arange(3, dtype=np.uint8),
        scores=np.array([0.1, 0.7], np.float32),
    )  # fmt: skip
    header = battery(0)["header"]
    entries: list[Entry] = [(1, "/people", "care_msgs/msg/People", {"header": header, "people": [person]})]
    (item,) = items(RosBag(write_bag(tmp_path / "bag", entries)))
    assert isinstance(item, RawMessage)
    assert item.fields["people"] == [
        {"name": "Ann", "distance": 1.1, "class": True, "picture": [0, 1, 2], "scores": [0.1, 0.7]}
    ]


def test_a_recording_of_ros_2_humble_has_no_definitions(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", ENTRIES, "sqlite3")
    whole = items(RosBag(bag))
    with sqlite3.connect(bag / "bag.db3") as database:
        database.execute("DROP TABLE message_definitions")
        database.execute("ALTER TABLE topics DROP COLUMN type_description_hash")
        database.execute("UPDATE schema SET schema_version = 3, ros_distro = 'humble'")
    database.close()
    metadata = bag / "metadata.yaml"
    lines = [line for line in metadata.read_text().splitlines() if "ros_distro" not in line and "RIHS01" not in line]
    text = "\n".join(lines).replace("version: 9", "version: 5").replace("type_description_hash: ", "")
    metadata.write_text(text.replace("      type_description_hash:", ""))
    assert items(RosBag(bag)) == items(RosBag(bag / "bag.db3")) == whole


@pytest.mark.parametrize("plugin", ["mcap", "sqlite3"])
def test_reading_resumes_at_every_position(plugin: str, tmp_path: Path) -> None:
    reader = RosBag(write_bag(tmp_path / "bag", ENTRIES, plugin))
    whole = list(reader.read())
    for index, (position, _) in enumerate(whole):
        assert list(reader.read(position)) == whole[index + 1 :]
    fractions = [reader.fraction(position) for position, _ in whole]
    assert fractions == sorted(fractions)
    assert fractions[0] == 0
    assert fractions[-1] > 0.99
    for other in (5, {"time": 1}, {"time": 10**11, "messages": 1}):
        with pytest.raises(UnreadableLog):
            next(reader.read(other))  # type: ignore[arg-type]


def test_messages_on_other_topics_are_not_decoded(tmp_path: Path) -> None:
    entries: list[Entry] = [(1, "/camera", TEXT, b"\x00\x01\x00\x00 damaged"), *ENTRIES]
    assert texts(items(RosBag(write_bag(tmp_path / "bag", entries), {"/conditions"}))) == ["first", "second", "third"]
    reader = RosBag(tmp_path / "bag", {"/none"})
    assert items(reader) == []
    assert reader.topics == {"/camera", "/conditions", "/battery_state", "/call"}


def test_files_of_a_folder_are_merged_by_time(tmp_path: Path) -> None:
    one = write_bag(tmp_path / "one", [(time, "/a", TEXT, {"data": f"{time}"}) for time in (1, 3, 5)])
    other = write_bag(tmp_path / "other", [(time, "/a", TEXT, {"data": f"{time}"}) for time in (2, 4, 6)])
    shutil.copy(other / "other.mcap", one)
    metadata = one / "metadata.yaml"
    metadata.write_text(metadata.read_text().replace("- one.mcap", "- one.mcap\n  - other.mcap"))
    reader = RosBag(one)
    assert texts(items(reader)) == list("123456")
    # The times in metadata.yaml end with those of the first file.
    assert [round(reader.fraction(position), 3) for position, _ in reader.read()] == [0, 0.2, 0.4, 0.6, 0.8, 1]
    for position, _ in reader.read():
        next(reader.read(position), None)


@pytest.mark.parametrize("compression", ["none", "storage"])
def test_a_file_without_an_end_is_read_up_to_its_last_whole_record(compression: str, tmp_path: Path) -> None:
    file = write_bag(tmp_path / "bag", long_texts(), "mcap", compression) / "bag.mcap"
    content = file.read_bytes()
    read = set()
    for size in (len(content) - 1, len(content) * 3 // 4, len(content) // 2):
        for tail in (b"", bytes(1000)):  # power loss may leave zeros
            file.write_bytes(content[:size] + tail)
            *messages, end = items(RosBag(file))
            assert isinstance(end, Unreadable)
            assert "it has no valid index" in end.message
            assert [str(text)[0] for text in texts(messages)] == list("0123"[: len(messages)])
            read.add(len(messages))
            assert items(RosBag(tmp_path / "bag")) == [*messages, end]
    assert len(read) > 1


def test_damage_within_a_file_ends_it(tmp_path: Path) -> None:
    file = write_bag(tmp_path / "bag", long_texts(), "mcap", "storage") / "bag.mcap"
    content = file.read_bytes()
    last = content.rindex(b"\x28\xb5\x2f\xfd")  # the begin of a chunk that zstd has compressed
    file.write_bytes(content[:last] + bytes(99) + content[last + 99 :])
    *messages, end = items(RosBag(file))
    assert 1 <= len(messages) < 4
    assert isinstance(end, Unreadable)
    assert "damaged" in end.message


def test_a_message_that_is_not_of_its_type_is_an_item(tmp_path: Path) -> None:
    entries: list[Entry] = [*ENTRIES, (4, "/conditions", TEXT, b"\x00\x01\x00\x00\xff\xff\xff"), (5, "/a", TEXT, b"")]
    *_, damaged, empty = items(RosBag(write_bag(tmp_path / "bag", entries)))
    assert isinstance(damaged, Unreadable)
    assert damaged.place == "the message on '/conditions' at 4.000000000 s"
    assert isinstance(empty, Unreadable)


@pytest.mark.parametrize("head", ["", f"{'=' * 80}\nIDL: std_msgs/msg/String\n"])
def test_definitions_in_idl(head: str, tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", ENTRIES[:1], "sqlite3")
    idl = "module std_msgs { module msg { struct String { string data; }; }; };"
    with sqlite3.connect(bag / "bag.db3") as database:
        database.execute(
            "UPDATE message_definitions SET encoding = 'ros2idl', encoded_message_definition = ?", [head + idl]
        )
    database.close()
    assert texts(items(RosBag(bag / "bag.db3"))) == ["first"]


def test_a_definition_that_cannot_be_parsed_is_not_replaced_by_the_standard_one(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", ENTRIES[:1], "sqlite3")
    with sqlite3.connect(bag / "bag.db3") as database:
        database.execute("UPDATE message_definitions SET encoded_message_definition = 'string<'")
    database.close()
    (unreadable,) = items(RosBag(bag / "bag.db3"))
    assert isinstance(unreadable, Unreadable)
    assert "cannot be used" in unreadable.message


def test_an_unknown_type_is_reported_once(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", [*ENTRIES, *ENTRIES], "sqlite3")
    with sqlite3.connect(bag / "bag.db3") as database:
        database.execute("UPDATE topics SET type = 'lost_msgs/msg/Call' WHERE name = '/call'")
    database.close()
    found = items(RosBag(bag / "bag.db3"))
    (unreadable,) = (item for item in found if isinstance(item, Unreadable))
    assert unreadable.place == "the messages on '/call'"
    assert "no definition of 'lost_msgs/msg/Call'" in unreadable.message
    assert len(found) == 2 * len(ENTRIES) - 1


def test_the_name_of_a_type_is_not_executed(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", ENTRIES[:1], "sqlite3")
    mark = tmp_path / "executed"
    name = f"a/msg/B:\n  open({str(mark)!r}, 'w')\nclass C"
    with sqlite3.connect(bag / "bag.db3") as database:
        for table, column in (("topics", "type"), ("message_definitions", "topic_type")):
            database.execute(f"UPDATE {table} SET {column} = ?", [name])
    database.close()
    (unreadable,) = items(RosBag(bag / "bag.db3"))
    assert isinstance(unreadable, Unreadable)
    assert not mark.exists()


@pytest.mark.parametrize("plugin", ["mcap", "sqlite3"])
def test_a_recording_without_messages(plugin: str, tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", [], plugin)
    assert items(RosBag(bag)) == list(RosBag(bag).sample(5)) == []
    metadata = bag / "metadata.yaml"
    (file,) = (path for path in bag.iterdir() if path != metadata)
    text = metadata.read_text()
    metadata.write_text(text.replace(f"relative_file_paths:\n  - {file.name}", "relative_file_paths: []"))
    assert items(RosBag(bag)) == []


def test_a_recording_without_a_whole_part_says_so(tmp_path: Path) -> None:
    file = write_bag(tmp_path / "bag", ENTRIES, "mcap", "storage") / "bag.mcap"
    (tmp_path / "cut.mcap").write_bytes(file.read_bytes()[:300])
    with pytest.raises(UnreadableLog, match="it ends before its first complete message or chunk"):
        items(RosBag(tmp_path / "cut.mcap"))


def test_messages_that_sqlite_has_not_merged_are_reported(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", ENTRIES, "sqlite3")
    (bag / "bag.db3-wal").write_bytes(b"")
    whole = items(RosBag(bag))
    assert len(whole) == len(ENTRIES)
    (bag / "bag.db3-wal").write_bytes(b"frames")
    for path in (bag, bag / "bag.db3"):
        *messages, end = items(RosBag(path))
        assert messages == whole
        assert isinstance(end, Unreadable)
        assert "bag.db3-wal" in end.message


def test_other_files_are_refused(tmp_path: Path) -> None:
    bag = write_bag(tmp_path / "bag", ENTRIES)
    (tmp_path / "other.mcap").write_bytes(b"\x89PNG\r\n\x1a\n" * 9)
    (tmp_path / "empty.mcap").write_bytes(b"")
    (tmp_path / "text.db3").write_text("text\n" * 2000)
    sqlite3.connect(tmp_path / "other.db3").execute("CREATE TABLE t(x)").connection.close()
    (tmp_path / "folder").mkdir()
    for name in ("other.mcap", "empty.mcap", "text.db3", "other.db3", "folder", "missing.mcap"):
        with pytest.raises(UnreadableLog, match=name):
            items(RosBag(tmp_path / name))
    (bag / "metadata.yaml").write_text("rosbag2_bagfile_information: {version: 99}")
    with pytest.raises(UnreadableLog, match="version 99 not supported"):
        items(RosBag(bag))
    (bag / "metadata.yaml").unlink()
    with pytest.raises(UnreadableLog, match=r"metadata\.yaml") as raised:
        items(RosBag(bag))
    assert ".mcap" in str(raised.value.hint)


def test_a_topic_that_was_not_recorded_is_not_a_pass(tmp_path: Path, cli: Cli) -> None:
    bag = write_bag(tmp_path / "bag", [(1.5, "/mode", TEXT, {"data": "home"}), (2, "/call", "std_msgs/msg/Empty", {})])
    files = {"r.sleec": "RULE r WHEN Call THEN NOT Sleep\nRULE s WHEN Fall THEN Help\n", "m.toml": MAPPING}
    ran = cli("audit", str(bag), "--ruleset", "r.sleec", "--mapping", "m.toml", files=files)
    assert ran.code == 0
    ran = cli("audit", str(bag), "--ruleset", "r.sleec", "--mapping", "m.toml", files={"m.toml": MAPPING + FALL})
    assert ran.code == 3
    assert "SLEEC712" in ran.out
    assert "the recording does not have the topic `/fall`" in ran.out
