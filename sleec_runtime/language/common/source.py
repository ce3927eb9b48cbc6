"""Reads a text of rules from a file or standard input, in any form that editors save."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

from sleec_runtime.errors import UnreadableFile
from sleec_runtime.model import Source
from sleec_runtime.support.files import read_file, read_stream

if TYPE_CHECKING:
    from pathlib import Path

STDIN = "-"
_BYTE_ORDER_MARK = "\ufeff"
_UTF16_MARKS = (b"\xff\xfe", b"\xfe\xff")


def read_source(path: str | Path) -> Source:
    """The text at `path`, or standard input for ``-``.

    A byte order mark and any kind of line break are accepted.

    Raises:
        UnreadableFile: the file is missing, not readable, too large, not a regular file or not UTF-8, or
            contains a NUL byte.
    """
    name, data = _read_bytes(path)
    return decode_source(name, data)


def decode_source(name: str, data: bytes) -> Source:
    """The text in these bytes; messages call it `name`.

    Raises:
        UnreadableFile: they are not UTF-8, or contain a NUL byte.
    """
    from hashlib import sha256

    return Source(name, _decode(data, name), sha256(data).hexdigest())


def normalize_line_breaks(text: str) -> str:
    """`text` without a byte order mark and with ``\\n`` for every lone ``\\r``, to count lines as editors do.

    ``\\r\\n`` stays: its ``\\n`` ends the line.
    """
    text = text.removeprefix(_BYTE_ORDER_MARK)
    if "\r" in text:
        import re

        text = re.sub(r"\r(?!\n)", "\n", text)
    return text


def _read_bytes(path: str | Path) -> tuple[str, bytes]:
    name = os.fspath(path)
    if name == STDIN:
        return "<stdin>", read_standard_input()
    try:
        return name, read_file(name)
    except FileNotFoundError:
        raise UnreadableFile(f"file {name} does not exist", "check the spelling of its name and folder") from None
    except IsADirectoryError:
        raise UnreadableFile(f"{name} is a folder, not a file", "give the path of a file in it") from None
    except PermissionError:
        raise UnreadableFile(f"no permission to read {name}", "change its permissions, or ask its owner") from None
    except (OSError, ValueError) as error:
        raise UnreadableFile(f"{name} cannot be read: {getattr(error, 'strerror', None) or error}") from None


def read_standard_input() -> bytes:
    """All of standard input.

    Raises:
        UnreadableFile: it is closed, too large, or cannot be read.
    """
    if sys.stdin is None:  # closed when Python was started
        raise UnreadableFile("standard input is closed", "give a file, or redirect one to standard input")
    try:
        return read_stream(sys.stdin.buffer)
    except OSError as error:
        raise UnreadableFile(f"standard input cannot be read: {error.strerror}") from None


def _decode(data: bytes, name: str) -> str:
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        if data.startswith(_UTF16_MARKS):
            raise UnreadableFile(f"{name} is saved as UTF-16, not as UTF-8", "save it again as UTF-8") from None
        line = data.count(b"\n", 0, error.start) + 1
        raise UnreadableFile(
            f"{name} is not UTF-8 text: line {line} contains the byte 0x{data[error.start]:02x}"
            f" (byte {error.start + 1} of the file)",
            "save it again as UTF-8, for example with 'Save as' in your editor",
        ) from None
    nul = text.find("\0")
    if nul >= 0:
        line = text.count("\n", 0, nul) + 1
        raise UnreadableFile(
            f"{name} is not a text of rules: line {line} contains a NUL byte",
            "it may be a word processor document; save it as plain text",
        )
    return normalize_line_breaks(text)
