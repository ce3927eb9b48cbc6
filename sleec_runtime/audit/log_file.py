"""Log files that a running robot writes: JSON lines, each complete before the next begins."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from sleec_runtime.errors import UnwritableLog


class LogFile:
    """Appends lines to the file at `path`.

    It does not overwrite a file: if there is one, `append` continues it. Each line is written at once, so a process
    that is killed leaves at most its last line incomplete. A line that was not completed is unreadable, and does not
    spoil the next one.

    Raises UnwritableLog.
    """

    def __init__(self, path: str | os.PathLike[str], append: bool = False) -> None:
        self.path = Path(path)
        flags = os.O_RDWR | os.O_APPEND | os.O_CREAT | (0 if append else os.O_EXCL)
        # Without O_NONBLOCK, opening a pipe waits for a reader. O_BINARY is for Windows.
        flags |= getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
        try:
            self._file = os.open(self.path, flags, 0o644)
        except FileExistsError:
            raise UnwritableLog(f"{self.path} exists", "choose another name, or append to it") from None
        except (OSError, ValueError) as error:
            raise UnwritableLog(f"{self.path} cannot be written: {getattr(error, 'strerror', error)}") from None
        if not stat.S_ISREG(os.fstat(self._file).st_mode):
            os.close(self._file)
            raise UnwritableLog(f"{self.path} is not a regular file")
        self._is_line_open = self._ends_within_a_line()

    def write(self, line: str) -> None:
        """Appends a line. Raises OSError, such as for a full disk."""
        data = memoryview(b"\n" * self._is_line_open + line.encode() + b"\n")
        while data:
            count = os.write(self._file, data)
            data = data[count:]
            self._is_line_open = len(data) > 0

    def close(self) -> None:
        """Closes the file."""
        os.close(self._file)

    def _ends_within_a_line(self) -> bool:
        size = os.fstat(self._file).st_size
        if not size:
            return False
        os.lseek(self._file, size - 1, os.SEEK_SET)
        return os.read(self._file, 1) != b"\n"
