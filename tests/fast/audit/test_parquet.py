"""The reader of Parquet tables, and the choice of a reader."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from sleec_runtime.audit.observation import (
    Entered,
    Executed,
    Observation,
    Occurred,
    RawMessage,
    Reported,
    write_line,
)
from sleec_runtime.errors import UnreadableLog
from sleec_verify.audit.readers.forms import open_log
from sleec_verify.audit.readers.json_lines import JsonLines
from sleec_verify.audit.readers.parquet import Parquet
from sleec_verify.audit.readers.reader import Unreadable

MISSION: list[Observation | RawMessage] = [
    Entered(0, "household"),
    Reported(Fraction(1, 10), {"UserUndressed": True, "UserAge": Fraction(731, 10), "RiskLevel": None}),
    Occurred(1, "CurtainOpenRequest"),
    RawMessage(Fraction(3, 2), "/battery_state", "sensor_msgs/msg/BatteryState", {"percentage": Fraction(2, 5)}),
    Executed(2, "RefuseRequest"),
    Entered(3, None),
]


def table(rows: Sequence[dict[str, object]], **columns: Any) -> pa.Table:
    """The lines of a log as a table. `columns` are the types of other columns than text."""
    names = ("time", "topic", "type", "domain", "event", "executed", "conditions", "message")
    found = {name: [row.get(name) for row in rows] for name in names}
    kinds = {"time": pa.float64(), **columns}
    return pa.table({name: pa.array(found[name], kinds.get(name, pa.string())) for name in names})


def rows() -> list[dict[str, object]]:
    found = []
    for observation in MISSION:
        row = json.loads(write_line(observation))
        if row.get("domain", "") is None:
            row["domain"] = ""
        found.append({name: json.dumps(value) if isinstance(value, dict) else value for name, value in row.items()})
    return found


def write(path: Path, content: pa.Table, **options: Any) -> Path:
    pq.write_table(content, path, **options)
    return path


def test_rows_are_read_as_json_lines_are(tmp_path: Path) -> None:
    path = write(tmp_path / "log.parquet", table(rows()))
    assert [item for _, item in Parquet(path).read()] == MISSION
    (tmp_path / "log.jsonl").write_text("".join(write_line(one) + "\n" for one in MISSION))
    assert [item for _, item in JsonLines(tmp_path / "log.jsonl").read()] == MISSION


@pytest.mark.parametrize("size", [1, 4, 100])
def test_reading_resumes_at_every_position(size: int, tmp_path: Path) -> None:
    path = write(tmp_path / "log.parquet", table(rows() * 3), row_group_size=size)
    reader = Parquet(path)
    whole = list(reader.read())
    assert len(whole) == 3 * len(MISSION)
    for index, (position, _) in enumerate(whole):
        assert list(reader.read(position)) == whole[index + 1 :]
        assert reader.fraction(position) == (index + 1) / len(whole)
    for other in (-1, 99, "1"):
        with pytest.raises(UnreadableLog):
            next(reader.read(other))


@pytest.mark.parametrize(
    ("kind", "value", "seconds"),
    [
        (pa.timestamp("ms"), 1500, Fraction(3, 2)),
        (pa.timestamp("ns", tz="UTC"), 1_500_000_001, Fraction(1_500_000_001, 10**9)),
        (pa.int32(), 7, 7),
        (pa.decimal128(10, 3), Decimal("7.125"), Fraction(57, 8)),
    ],
)
def test_times_are_exact(kind: Any, value: object, seconds: Fraction, tmp_path: Path) -> None:
    path = write(tmp_path / "log.parquet", table([{"time": value, "event": "E"}], time=kind))
    assert [item for _, item in Parquet(path).read()] == [Occurred(seconds, "E")]


def test_messages_on_other_topics_are_left_out(tmp_path: Path) -> None:
    path = write(tmp_path / "log.parquet", table(rows()))
    assert [item for _, item in Parquet(path, {"/other"}).read()] == MISSION[:3] + MISSION[4:]
    assert [item for _, item in Parquet(path, {"/battery_state"}).read()] == MISSION


def test_unreadable_rows_are_items(tmp_path: Path) -> None:
    bad: list[dict[str, object]] = [
        {"time": 1.0, "conditions": "{half"},
        {"time": 1.0, "conditions": "[" * 10**5},
        {"time": 1.0},
        {"event": "E"},
        {"time": float("nan"), "event": "E"},
        {"time": 1.0, "event": "E", "executed": "F"},
    ]
    *found, last = (item for _, item in Parquet(write(tmp_path / "log.parquet", table([*bad, *rows()[:1]]))).read())
    assert [item.place for item in found if isinstance(item, Unreadable)] == [f"row {n}" for n in range(1, 7)]
    assert last == MISSION[0]


def test_a_value_that_cannot_be_read_leaves_the_other_values_of_its_row(tmp_path: Path) -> None:
    row = {"time": 1.0, "conditions": '{"Dark": true, "battery": NaN}'}
    ((_, item),) = Parquet(write(tmp_path / "log.parquet", table([row]))).read()
    assert isinstance(item, Unreadable)
    assert item.rest == Reported(1, {"Dark": True, "battery": None})


@pytest.mark.parametrize(
    ("content", "problem"),
    [
        (pa.table({"event": ["E"]}), "has no column time"),
        (pa.table({"time": [1], "x": ["E"]}), "has no column domain or event or"),
        (pa.table([[1], [2], ["E"]], ["time", "time", "event"]), "has more than one column time"),
        (pa.table([[1], ["E"], ["F"]], ["time", "event", "event"]), "has more than one column event"),
        (pa.table({"time": ["1"], "event": ["E"]}), "time is a number or a timestamp; got string"),
        (pa.table({"time": [1], "conditions": [{"A": True}]}), "conditions is text; got struct"),
        (pa.table({"time": [1], "event": [5]}), "event is text; got int64"),
    ],
)
def test_other_columns_are_refused(content: pa.Table, problem: str, tmp_path: Path) -> None:
    with pytest.raises(UnreadableLog, match=problem):
        list(Parquet(write(tmp_path / "log.parquet", content)).read())


def test_damaged_files(tmp_path: Path) -> None:
    path = write(
        tmp_path / "log.parquet",
        table(rows() * 5000),
        compression="snappy",
        use_dictionary=False,
        row_group_size=10_000,
    )
    content = path.read_bytes()
    path.write_bytes(content[:-100])
    with pytest.raises(UnreadableLog, match="cannot be read as a Parquet file"):
        list(Parquet(path).read())
    with pytest.raises(UnreadableLog, match=r"file .* does not exist"):
        list(Parquet(tmp_path / "missing.parquet").read())
    middle = len(content) // 2
    path.write_bytes(content[:middle] + bytes(2_000) + content[middle + 2_000 :])
    *found, (_, last) = Parquet(path).read()
    assert isinstance(last, Unreadable)
    assert "damaged" in last.message
    assert 0 < len(found) < 30_000


def test_the_name_of_a_log_says_its_form(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    forms = {
        name: type(open_log(tmp_path / name)).__name__ for name in ("a.mcap", "a.db3", "a.parquet", "a.jsonl", "a")
    }
    assert forms == dict(zip(forms, ("RosBag", "RosBag", "Parquet", "JsonLines", "JsonLines")))
    assert type(open_log(tmp_path)).__name__ == "RosBag"
    for name, problem in (("a.bag", "ROS 1"), ("a.db3.zstd", "compressed file")):
        with pytest.raises(UnreadableLog, match=problem):
            open_log(tmp_path / name)
    for name, library in (("a.mcap", "rosbag2"), ("a.parquet", "parquet")):
        monkeypatch.setitem(sys.modules, f"sleec_verify.audit.readers.{library}", None)
        with pytest.raises(UnreadableLog, match="needs a library") as raised:
            open_log(tmp_path / name)
        assert "the extra `logs`" in str(raised.value.hint)
