"""Logs as JSON lines: one observation or message in each line (docs/audit.md)."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

from sleec_runtime.audit.observation import LONGEST_LINE, LostMessages, MalformedValues, Reported, read_line
from sleec_runtime.errors import MalformedObservation, UnreadableLog
from sleec_runtime.support.messages import represent
from sleec_verify.audit.readers.reader import Item, Position, Unreadable


class JsonLines:
    """The log in the file at `path`. A position is a list: the number of bytes before it, and that of lines."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._size = 0

    def read(self, start: Position = None) -> Iterator[tuple[Position, Item]]:
        """See `Reader.read`. Empty lines are skipped.

        If the first line is unreadable, the log has another form. A last line without a line break may be half written:
        if it is unreadable, its position is that of the item before it.
        """
        try:
            with open(self.path, "rb", opener=_open_without_waiting) as file:
                if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                    raise UnreadableLog(f"{self.path} is not a regular file")
                self._size = os.fstat(file.fileno()).st_size
                offset, number = self._resume(file, start)
                position = start
                while line := file.readline(LONGEST_LINE + 1):
                    offset, number = offset + len(line), number + 1
                    if len(line) > LONGEST_LINE:
                        offset += _skip_rest(file, line)
                    item = self._item(line, number)
                    if isinstance(item, Unreadable) and not line.endswith(b"\n") and len(line) <= LONGEST_LINE:
                        yield position, item
                        break
                    if item is not None:
                        position = [offset, number]
                        yield position, item
                if os.fstat(file.fileno()).st_size < offset:
                    raise UnreadableLog(f"{self.path} became shorter while it was read", "audit a copy of it")
        except FileNotFoundError:
            raise UnreadableLog(f"file {self.path} does not exist", "check its name and folder") from None
        except OSError as problem:
            raise UnreadableLog(f"{self.path} cannot be read: {problem.strerror}") from None

    def fraction(self, position: Position) -> float:
        """See `Reader.fraction`."""
        return min(1.0, _numbers(position)[0] / self._size) if self._size else 1.0

    def _resume(self, file: BinaryIO, start: Position) -> tuple[int, int]:
        offset, number = _numbers(start)
        if offset:
            file.seek(offset - 1)
            last = file.read(1)
            # The last line may have had no line break when the position was saved.
            rest = b"" if last == b"\n" else file.readline(LONGEST_LINE)
            if not last or rest.strip():
                raise UnreadableLog(f"{self.path} has changed since the position was saved", "audit it from the start")
            offset += len(rest)
        return offset, number

    def _item(self, line: bytes, number: int) -> Item | None:
        is_of_this_form = False
        rest: Reported | None = None
        if len(line) > LONGEST_LINE:
            message, hint = f"it is longer than {LONGEST_LINE // 2**20} MiB", None
        elif line.isspace():
            return None
        else:
            try:
                return read_line(line)
            except MalformedObservation as error:
                message, hint = error.message, error.hint
                is_of_this_form = isinstance(error, (LostMessages, MalformedValues))
                rest = error.rest if isinstance(error, MalformedValues) else None
        if number == 1 and not is_of_this_form:
            raise UnreadableLog(f"{self.path} is not a log of JSON lines: in line 1, {message}", hint)
        return Unreadable(f"line {number}", message, hint, number, rest)


def _numbers(position: Position) -> tuple[int, int]:
    if position is None:
        return 0, 0
    if isinstance(position, list) and len(position) == 2:
        offset, number = position
        if isinstance(offset, int) and isinstance(number, int) and min(offset, number) >= 0:
            return offset, number
    raise UnreadableLog(f"{represent(position)} is not a position in a log of JSON lines")


def _skip_rest(file: BinaryIO, line: bytes) -> int:
    """Reads to the end of a long line, and returns the number of bytes."""
    skipped = 0
    while not line.endswith(b"\n") and (line := file.readline(LONGEST_LINE)):
        skipped += len(line)
    return skipped


def _open_without_waiting(path: str, flags: int) -> int:
    # Without this flag, opening a pipe for reading waits for a writer.
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))
