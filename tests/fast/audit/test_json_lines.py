"""The reader of JSON lines."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from sleec_runtime.audit.observation import Occurred, Reported
from sleec_runtime.errors import UnreadableLog
from sleec_verify.audit.readers import json_lines
from sleec_verify.audit.readers.json_lines import JsonLines
from sleec_verify.audit.readers.reader import Unreadable

LINES = [f'{{"time": {time}, "event": "E"}}\n' for time in range(5)]


def log(folder: Path, text: str | bytes) -> JsonLines:
    path = folder / "mission.jsonl"
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return JsonLines(path)


def test_reading_resumes_at_every_position(tmp_path: Path) -> None:
    reader = log(tmp_path, "\n".join(LINES))
    whole = list(reader.read())
    assert [item for _, item in whole] == [Occurred(time, "E") for time in range(5)]
    for index, (position, _) in enumerate(whole):
        assert list(reader.read(position)) == whole[index + 1 :]
    fractions = [reader.fraction(position) for position, _ in [(None, None), *whole]]
    assert fractions == sorted(fractions)
    assert fractions[0] == 0
    assert fractions[-1] == 1


def test_an_unreadable_line_is_an_item_with_its_place(tmp_path: Path) -> None:
    reader = log(tmp_path, LINES[0] + "\n{nonsense}\n" + LINES[1])
    (_, _), (position, unreadable), (_, last) = reader.read()
    assert isinstance(unreadable, Unreadable)
    assert unreadable.place == "line 3"
    assert last == Occurred(1, "E")
    assert [item for _, item in reader.read(position)] == [last]


def test_a_recorder_may_have_lost_the_first_messages(tmp_path: Path) -> None:
    (_, loss), (_, first) = log(tmp_path, '{"time": 0, "lost": 3}\n' + LINES[1]).read()
    assert isinstance(loss, Unreadable)
    assert loss.message == "the recorder lost 3 messages before the time 0"
    assert first == Occurred(1, "E")


@pytest.mark.parametrize("value", ["NaN", "Infinity", "[1]", "{}", "1e1001", "1" * 1001])
@pytest.mark.parametrize("first", ["", LINES[0]])
def test_a_value_that_cannot_be_read_leaves_the_other_values_of_its_line(
    first: str, value: str, tmp_path: Path
) -> None:
    line = f'{{"time": 1, "conditions": {{"Dark": true, "battery": {value}, "risk": null}}}}\n'
    *_, (_, item) = log(tmp_path, first + line).read()
    assert isinstance(item, Unreadable)
    assert item.message.startswith("the value of 'battery' is ")
    assert item.rest == Reported(1, {"Dark": True, "battery": None, "risk": None})


def test_a_half_written_last_line_is_read_again_later(tmp_path: Path) -> None:
    reader = log(tmp_path, LINES[0] + LINES[1][:9])
    (_, _), (position, item) = reader.read()
    assert isinstance(item, Unreadable)
    assert (item.place, item.line) == ("line 2", 2)
    log(tmp_path, LINES[0] + LINES[1])
    assert [item for _, item in reader.read(position)] == [Occurred(1, "E")]


def test_a_half_written_line_after_a_break_is_read_again_later(tmp_path: Path) -> None:
    reader = log(tmp_path, LINES[0][:-1])
    ((saved, _),) = reader.read()
    log(tmp_path, f"{LINES[0]}\n\n{LINES[1][:9]}")
    ((position, item),) = reader.read(saved)
    assert isinstance(item, Unreadable)
    assert position == saved
    log(tmp_path, f"{LINES[0]}\n\n{LINES[1]}{{nonsense}}\n")
    (_, item), (_, unreadable) = reader.read(saved)
    assert item == Occurred(1, "E")
    assert isinstance(unreadable, Unreadable)
    assert unreadable.line == 5


def test_a_line_that_is_completed_while_it_is_read_is_read_again_later(tmp_path: Path) -> None:
    reader = log(tmp_path, LINES[0] + LINES[1][:9])
    items = reader.read()
    saved, _ = next(items)
    position, item = next(items)
    assert isinstance(item, Unreadable)
    with reader.path.open("a") as file:
        file.write(LINES[1][9:])
    assert list(items) == []
    assert position == saved
    assert [item for _, item in reader.read(position)] == [Occurred(1, "E")]


@pytest.mark.parametrize("end", ["", "\n", "\r\n", "  \n", f"\n{LINES[2]}"])
def test_a_last_line_may_have_no_line_break(end: str, tmp_path: Path) -> None:
    reader = log(tmp_path, LINES[0] + LINES[1][:-1])
    *_, (position, item) = reader.read()
    assert item == Occurred(1, "E")
    log(tmp_path, LINES[0] + LINES[1][:-1] + end + ("" if end.endswith("\n") else "\n") + "{nonsense}\n")
    *more, (_, unreadable) = reader.read(position)
    assert [item for _, item in more] == ([Occurred(2, "E")] if LINES[2] in end else [])
    assert isinstance(unreadable, Unreadable)
    assert unreadable.line == 3 + len(more)
    log(tmp_path, LINES[0] + LINES[1][:-1] + LINES[2])
    with pytest.raises(UnreadableLog, match="has changed since"):
        list(reader.read(position))


def test_a_log_may_be_removed_while_it_is_read(tmp_path: Path) -> None:
    reader = log(tmp_path, "".join(LINES))
    items = reader.read()
    position, _ = next(items)
    reader.path.unlink()
    assert reader.fraction(position) == 0.2
    assert len(list(items)) == 4


def test_a_long_line_is_skipped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(json_lines, "LONGEST_LINE", 2**20)
    reader = log(tmp_path, LINES[0] + "x" * 3 * 2**20 + "\n" + LINES[1])
    (_, _), (_, unreadable), (_, last) = reader.read()
    assert isinstance(unreadable, Unreadable)
    assert "longer than 1 MiB" in unreadable.message
    assert last == Occurred(1, "E")


@pytest.mark.parametrize("content", [b"\x00\x01\x02\xff" * 100, b"\x89PNG\r\n\x1a\n", b"text\n", b'{"a": 1}\n'])
def test_another_form_is_refused(content: bytes, tmp_path: Path) -> None:
    with pytest.raises(UnreadableLog, match="is not a log of JSON lines: in line 1"):
        list(log(tmp_path, content).read())


def test_a_log_that_changes_is_refused(tmp_path: Path) -> None:
    reader = log(tmp_path, "".join(LINES))
    items = reader.read()
    position, _ = next(items)
    log(tmp_path, "")
    with pytest.raises(UnreadableLog, match="became shorter"):
        list(items)
    with pytest.raises(UnreadableLog, match="has changed since"):
        list(reader.read(position))


@pytest.mark.parametrize("position", [5, [1], [-1, 0], ["a", 1], {}])
def test_other_positions_are_refused(position: object, tmp_path: Path) -> None:
    with pytest.raises(UnreadableLog, match="is not a position"):
        list(log(tmp_path, LINES[0]).read(position))  # type: ignore[arg-type]


def test_files_that_cannot_be_read_are_refused(tmp_path: Path) -> None:
    with pytest.raises(UnreadableLog, match=r"file .* does not exist"):
        list(JsonLines(tmp_path / "missing").read())
    with pytest.raises(UnreadableLog, match="cannot be read"):
        list(JsonLines(tmp_path).read())
    if hasattr(os, "mkfifo"):
        os.mkfifo(tmp_path / "pipe")
        with pytest.raises(UnreadableLog, match="is not a regular file"):
            list(JsonLines(tmp_path / "pipe").read())
