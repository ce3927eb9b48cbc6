"""Files that must not be read to their end: pipes, devices, and files beyond the limit."""

from __future__ import annotations

import io
import os
from pathlib import Path

import pytest

from sleec_runtime.support.files import read_file, read_stream, size_limit


def test_a_regular_file_is_read(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"abc")
    assert read_file(tmp_path / "file") == b"abc"


def test_a_link_to_a_regular_file_is_read(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"abc")
    (tmp_path / "link").symlink_to("file")
    assert read_file(tmp_path / "link") == b"abc"


@pytest.mark.parametrize("device", ["/dev/zero", "/dev/full"])
def test_a_link_to_an_endless_device_is_refused(tmp_path: Path, device: str) -> None:
    (tmp_path / "link").symlink_to(device)
    with pytest.raises(OSError, match="it is not a regular file"):
        read_file(tmp_path / "link")


def test_a_pipe_is_refused_without_waiting(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(OSError, match="it is not a regular file"):
        read_file(tmp_path / "pipe")


def test_a_sparse_file_beyond_the_limit_is_refused(tmp_path: Path) -> None:
    with open(tmp_path / "file", "wb") as file:
        file.truncate(40 * 2**30)
    with pytest.raises(OSError, match="it is larger than 16 MiB"):
        read_file(tmp_path / "file")


@pytest.mark.parametrize(("limit", "words"), [(3, "3 bytes"), (2048, "2 KiB"), (0, "0 bytes")])
def test_the_limit_is_the_last_size_accepted(limit: int, words: str) -> None:
    class Endless(io.RawIOBase):
        def read(self, size: int = -1) -> bytes:
            assert size >= 0, "an endless stream is never read whole"
            return b"x" * size

    with size_limit(limit):
        assert read_stream(io.BytesIO(b"x" * limit)) == b"x" * limit
        with pytest.raises(OSError, match=f"it is larger than {words}"):
            read_stream(Endless())  # type: ignore[arg-type]


def test_the_limit_ends_with_its_block(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"abc")
    with size_limit(2), pytest.raises(OSError, match="2 bytes"):
        read_file(tmp_path / "file")
    assert read_file(tmp_path / "file") == b"abc"
