"""The file on disk: no change of anybody is lost, and drafts survive the server."""

from __future__ import annotations

import errno
import os
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from sleec_runtime.support.files import size_limit
from tests.support.pages import Page, page_on

OLD, NEW, OTHER = "WHEN A THEN B\n", "WHEN A THEN C\n", "WHEN A THEN D\n"


def test_a_text_is_saved(tmp_path: Path) -> None:
    page = page_on(tmp_path, OLD)
    page.path.chmod(0o640)
    first = page.get("file")["sha256"]
    digest = page.post("save", text=NEW, based_on=first)["sha256"]
    assert page.path.read_text(encoding="utf-8") == NEW
    assert page.path.stat().st_mode & 0o777 == 0o640
    assert page.get("disk")["sha256"] == digest == page.get("file")["sha256"]
    assert os.listdir(tmp_path) == ["rules.sleec"]


def test_a_change_on_the_disk_is_a_conflict_and_is_not_overwritten(tmp_path: Path) -> None:
    page = page_on(tmp_path, OLD)
    first = page.get("file")["sha256"]
    page.path.write_text(OTHER, encoding="utf-8")
    answer = page.post("save", 409, text=NEW, based_on=first)
    assert answer["text"] == OTHER
    assert page.path.read_text(encoding="utf-8") == OTHER
    assert page.post("save", text=NEW, based_on=answer["sha256"])
    assert page.path.read_text(encoding="utf-8") == NEW


def test_of_two_pages_on_one_file_the_second_is_told(tmp_path: Path) -> None:
    one = page_on(tmp_path, OLD)
    two = Page(one.path)
    based_on = one.get("file")["sha256"]
    one.post("save", text=NEW, based_on=based_on)
    assert two.post("save", 409, text=OTHER, based_on=based_on)["text"] == NEW


def test_a_deleted_file_is_a_conflict_and_can_be_saved_again(tmp_path: Path) -> None:
    page = page_on(tmp_path, OLD)
    first = page.get("file")["sha256"]
    page.path.unlink()
    assert page.get("disk") == {"sha256": None, "problem": None, "cases": None}
    answer = page.post("save", 409, text=NEW, based_on=first)
    assert (answer["text"], answer["sha256"]) == (None, None)
    page.post("save", text=NEW, based_on=None)
    assert page.path.read_text(encoding="utf-8") == NEW
    page.post("save", 409, text=OLD, based_on=None)


def test_a_read_only_file_is_not_written(tmp_path: Path) -> None:
    page = page_on(tmp_path, OLD)
    page.path.chmod(0o444)
    answer = page.post("save", 400, text=NEW, based_on=page.get("file")["sha256"])
    assert "read-only" in answer["message"]
    assert page.path.read_text(encoding="utf-8") == OLD


def test_a_link_stays_a_link(tmp_path: Path) -> None:
    target = tmp_path / "target.sleec"
    target.write_text(OLD, encoding="utf-8")
    link = tmp_path / "link.sleec"
    link.symlink_to(target)
    page = Page(link)
    page.post("save", text=NEW, based_on=page.get("file")["sha256"])
    assert link.is_symlink()
    assert target.read_text(encoding="utf-8") == NEW


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("A\r\nB\r\n", "C\r\nB\r\n"),
        ("A\rB\r", "C\rB\r"),
        ("\ufeffA\nB\n", "\ufeffC\nB\n"),
        ("A\nB\r\nD\n", "C\nB\nD\n"),
        ("A\r\nB\nD\r\n", "C\r\nB\r\nD\r\n"),
        ("A\nB", "C\nB"),
    ],
    ids=repr,
)
def test_line_breaks_and_the_mark_stay(before: str, after: str, tmp_path: Path) -> None:
    page = page_on(tmp_path)
    page.path.write_bytes(before.encode())
    known = page.get("file")
    assert known["text"] == before.lstrip("\ufeff").replace("\r\n", "\n").replace("\r", "\n")
    page.post("save", text=known["text"].replace("A", "C"), based_on=known["sha256"])
    assert page.path.read_bytes() == after.encode()


@pytest.mark.parametrize("content", [b"\x00\x01", b"\xff\xfe\x00", b"\xff"], ids=repr)
def test_a_binary_file_is_shown_as_a_problem_and_not_overwritten(content: bytes, tmp_path: Path) -> None:
    page = page_on(tmp_path, OLD)
    page.path.write_bytes(content)
    known = page.get("file")
    assert known["text"] == ""
    assert known["problem"]
    assert page.post("save", 409, text=NEW, based_on=known["sha256"])["problem"]
    assert page.path.read_bytes() == content


def test_a_folder_in_place_of_the_file_is_a_problem(tmp_path: Path) -> None:
    page = page_on(tmp_path, OLD)
    page.path.unlink()
    page.path.mkdir()
    assert page.get("disk")["problem"]
    page.post("save", 409, text=NEW, based_on=None)


def test_a_draft_survives_the_server_and_ends_with_saving(tmp_path: Path) -> None:
    page = page_on(tmp_path, OLD)
    first = page.get("file")["sha256"]
    assert page.get("file")["draft"] is None
    page.post("draft", text="WHEN A TH", based_on=first)
    again = Page(page.path)
    assert again.get("file")["draft"] == {"text": "WHEN A TH", "based_on": first}
    assert page.path.read_text(encoding="utf-8") == OLD
    assert (tmp_path / "drafts").stat().st_mode & 0o077 == 0
    again.post("save", text=NEW, based_on=first)
    assert Page(page.path).get("file")["draft"] is None
    assert os.listdir(tmp_path / "drafts") == []


@pytest.mark.parametrize("content", [b"", b"{", b"[]", b'{"text": 1, "based_on": null}', b"[" * 100_000])
def test_a_damaged_draft_is_none(content: bytes, tmp_path: Path) -> None:
    page = page_on(tmp_path, OLD)
    page.post("draft", text=NEW, based_on=None)
    (draft,) = (tmp_path / "drafts").iterdir()
    draft.write_bytes(content)
    assert page.get("file")["draft"] is None
    page.post("draft", text=NEW, based_on=None)
    assert page.get("file")["draft"] == {"text": NEW, "based_on": None}


def test_a_draft_that_cannot_be_kept_is_an_error(tmp_path: Path) -> None:
    page = page_on(tmp_path, OLD)
    (tmp_path / "drafts").write_text("no folder", encoding="utf-8")
    assert "cannot be stored" in page.post("draft", 400, text=NEW, based_on=None)["message"]


def test_what_could_not_be_read_again_is_not_written(tmp_path: Path) -> None:
    page = page_on(tmp_path, OLD)
    with size_limit(1024):
        assert "larger than 1 KiB" in page.post("draft", 400, text="x" * 1024, based_on=None)["message"]
        page.path.unlink()
        assert "larger than 1 KiB" in page.post("save", 400, text="x" * 1025, based_on=None)["message"]
        page.post("draft", text="é" * 400, based_on=None)
        assert page.get("file")["draft"]["text"] == "é" * 400
    assert not page.path.exists()


def test_a_full_disk_is_an_error_and_the_file_stays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = page_on(tmp_path, OLD)
    known = page.get("file")["sha256"]

    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr("os.replace", full)
    assert "No space left" in page.post("save", 400, text=NEW, based_on=known)["message"]
    assert "No space left" in page.post("draft", 400, text=NEW, based_on=known)["message"]
    assert page.path.read_text(encoding="utf-8") == OLD
    assert sorted(os.listdir(tmp_path)) == ["drafts", "rules.sleec"]


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="the file system has names in Unicode only")
def test_a_file_whose_name_is_not_text(tmp_path: Path) -> None:
    path = tmp_path / os.fsdecode(b"caf\xe9\n\x1b.sleec")
    path.write_text(OLD, encoding="utf-8")
    page = Page(path)
    known = page.get("file")
    assert known["text"] == OLD
    case = {"name": "one", "triggers": ["A"], "conditions": {}, "obligations": ["B"]}
    for name, fields in (("check", {}), ("cases/add", case), ("cases/run", {}), ("compare", {"old": OLD, "new": NEW})):
        assert page.post(name, text=OLD, **fields)
    assert page.get("cases")["cases"]
    assert page.post("save", 409, text=NEW, based_on="0")["text"] == OLD
    assert page.post("save", text=NEW, based_on=known["sha256"])
    assert path.read_text(encoding="utf-8") == NEW


def test_of_concurrent_saves_one_wins(tmp_path: Path) -> None:
    page = page_on(tmp_path, OLD)
    based_on = page.get("file")["sha256"]
    texts = [f"// {number}\n{OLD}" for number in range(8)]

    def save(text: str) -> int:
        answer = page.client.post("/api/save", json={"text": text, "based_on": based_on}, headers=page.headers)
        return answer.status_code

    with ThreadPoolExecutor(8) as pool:
        codes = list(pool.map(save, texts))
    assert sorted(codes) == [200, *[409] * 7]
    assert page.path.read_text(encoding="utf-8") == texts[codes.index(200)]
