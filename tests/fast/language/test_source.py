"""Files as they are: missing, foreign, broken, or read from standard input."""

from __future__ import annotations

import hashlib
import io
import sys
from pathlib import Path

import pytest

from sleec_runtime.errors import LanguageError, UnreadableFile
from sleec_runtime.language import load, read_source
from sleec_runtime.model import Place, Source, Span

RULE = "WHEN A THEN B\n"


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"WHEN A\nTHEN \xff", "line 2 contains the byte 0xff (byte 13 of the file)"),
        ("WHEN A THEN é".encode("latin-1"), "is not UTF-8 text: line 1 contains the byte 0xe9"),
        (RULE.encode("utf-16"), "is saved as UTF-16"),
        (b"WHEN A\n\nTHEN \x00B", "line 3 contains a NUL byte"),
    ],
)
def test_files_that_are_no_text(tmp_path: Path, data: bytes, message: str) -> None:
    path = tmp_path / "rules.sleec"
    path.write_bytes(data)
    with pytest.raises(UnreadableFile) as caught:
        load(path)
    assert message in caught.value.message
    assert caught.value.hint


def test_files_that_are_not_there(tmp_path: Path) -> None:
    with pytest.raises(UnreadableFile, match=r"file .* does not exist"):
        load(tmp_path / "missing.sleec")
    with pytest.raises(UnreadableFile, match="is a folder"):
        load(tmp_path)
    with pytest.raises(UnreadableFile, match="cannot be read"):
        load("a\0b")
    with pytest.raises(UnreadableFile, match="cannot be read"):
        load(tmp_path / ("x" * 5000))


def test_forbidden_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise PermissionError

    monkeypatch.setattr("builtins.open", refuse)
    with pytest.raises(UnreadableFile, match="no permission to read"):
        load(tmp_path / "secret.sleec")


@pytest.mark.parametrize("data", [b"", b"\xef\xbb\xbf", b" \n\n", b"// only a comment"])
def test_files_without_rules(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "empty.sleec"
    path.write_bytes(data)
    with pytest.raises(LanguageError, match="there are no rules in this text"):
        load(path)


def test_what_a_source_knows(tmp_path: Path) -> None:
    path = tmp_path / "rules.sleec"
    path.write_bytes(b"\xef\xbb\xbf" + RULE.encode())
    source = read_source(path)
    assert (source.path, source.text) == (str(path), RULE)
    assert source.sha256 == hashlib.sha256(path.read_bytes()).hexdigest()


def test_standard_input(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(RULE.encode())))
    ruleset = load("-")
    assert ruleset.source.path == "<stdin>"
    assert len(ruleset.rules) == 1


def test_a_part_of_a_file_has_the_lines_of_the_file() -> None:
    part = Source("log", "ab\ncd", first_line=7)
    assert part.place(Span(1, 4)) == Place(7, 2, 8, 2)
    assert [part.line(number) for number in (7, 8)] == ["ab", "cd"]
