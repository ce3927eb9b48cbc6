"""Reading of regular files, with a limit on their size.

This module reads all files that users name. So no command waits forever on a pipe or a device, and none runs out of
memory on a huge file.
"""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING, BinaryIO

if TYPE_CHECKING:
    from pathlib import Path

DEFAULT_MAX_SIZE = 16 * 1024 * 1024
"""Bytes. The largest published ruleset has 12 kB, and one of 100,000 rules about 10 MB."""

_CHUNK = 1024 * 1024

_max_size: ContextVar[int] = ContextVar("max_size", default=DEFAULT_MAX_SIZE)


@contextmanager
def size_limit(max_size: int) -> Iterator[None]:
    """Within the block, `read_file` and `read_stream` accept up to `max_size` bytes."""
    token = _max_size.set(max_size)
    try:
        yield
    finally:
        _max_size.reset(token)


def read_file(path: str | Path) -> bytes:
    """The content of a regular file.

    Raises:
        OSError: the file cannot be read, is not a regular file, or is larger than the limit. `strerror` says which.
        ValueError: `path` holds a NUL character.
    """
    with open(path, "rb", opener=_open_without_waiting) as file:
        status = os.fstat(file.fileno())
        if not stat.S_ISREG(status.st_mode):
            raise OSError(errno.EINVAL, "it is not a regular file", os.fspath(path))
        # Before anything is read. `read_stream` checks again, because the file may grow.
        check_size(status.st_size)
        return read_stream(file)


def read_stream(stream: BinaryIO) -> bytes:
    """The rest of a stream, such as standard input.

    Raises:
        OSError: the stream cannot be read, or is larger than the limit.
    """
    limit = _max_size.get()
    data = bytearray()
    # `read(n)` reserves n bytes at once, which may fail for a large limit.
    while len(data) <= limit and (chunk := stream.read(min(_CHUNK, limit + 1 - len(data)))):
        data += chunk
    check_size(len(data))
    return bytes(data)


def check_size(size: int) -> None:
    """Raises an error for a content of more bytes than the limit.

    Raises:
        OSError: with the limit.
    """
    limit = _max_size.get()
    if size > limit:
        raise OSError(errno.EFBIG, f"it is larger than {_in_words(limit)} (raise the limit with --max-size)")


def _open_without_waiting(path: str, flags: int) -> int:
    # Without this flag, opening a pipe for reading waits for a writer.
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


def _in_words(size: int) -> str:
    for unit, bytes_each in (("GiB", 2**30), ("MiB", 2**20), ("KiB", 2**10)):
        if size % bytes_each == 0 and size:
            return f"{size // bytes_each} {unit}"
    return f"{size} bytes"
