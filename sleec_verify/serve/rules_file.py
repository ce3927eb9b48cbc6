"""The file whose rules the page shows: read, compared with the disk, and saved without loss of changes by others."""

from __future__ import annotations

from hashlib import sha256
from threading import Lock
from typing import NamedTuple

from sleec_runtime.errors import SleecError
from sleec_runtime.language.common.source import decode_source
from sleec_runtime.support.files import check_size, read_file
from sleec_verify.files.placement import write_new, write_whole
from sleec_verify.repairs.rules_file import require_writable

_BYTE_ORDER_MARK = "\ufeff"


class DiskState(NamedTuple):
    """What is on disk. The lines of `text` end with ``\\n``, as in an editor. `problem` says why there is no text. If
    there is neither a problem nor a text, the file does not exist."""

    text: str | None
    sha256: str | None
    problem: str | None = None


class ChangedOnDisk(SleecError):
    """The file is not the one on which a text is based. `state` is what is there now."""

    def __init__(self, path: str, state: DiskState) -> None:
        super().__init__(f"{path} changed on disk", "compare the versions, and choose one")
        self.state = state


class ServedFile:
    """One file, for several pages. Each text is based on the file with a digest (`sha256`), or on no file."""

    def __init__(self, path: str) -> None:
        self.path = path
        self._lock = Lock()

    def state(self) -> DiskState:
        """What is on disk now."""
        return self._read()[0]

    def _read(self) -> tuple[DiskState, bytes]:
        """The state, and the bytes to which it belongs; none without a file."""
        try:
            content = read_file(self.path)
        except FileNotFoundError:
            return DiskState(None, None), b""
        except OSError as error:
            return DiskState(None, None, f"{self.path} cannot be read: {error.strerror}"), b""
        digest = sha256(content).hexdigest()
        try:
            text = decode_source(self.path, content).text
        except SleecError as error:
            return DiskState(None, digest, error.message), content
        return DiskState(text.replace("\r\n", "\n"), digest), content

    def save(self, text: str, based_on: str | None) -> str:
        """Write `text`, atomically, and return the digest. The file keeps its byte order mark, its line breaks, its
        permissions, and its links.

        Raises:
            ChangedOnDisk: the file is not the one with the digest `based_on`; None means that there is no file.
            SleecError: the file is read-only or cannot be written.
        """
        with self._lock:
            now, before = self._read()
            if now.sha256 != based_on or (now.text is None and now.problem is not None):
                raise ChangedOnDisk(self.path, now)
            require_writable(self.path)
            content = _as_before(text, before).encode()
            _require_size(content, self.path)
            if based_on is None:
                write_new(self.path, content)
            else:
                write_whole(self.path, content)
            return sha256(content).hexdigest()


def _as_before(text: str, content: bytes) -> str:
    """`text` with the byte order mark of a content, and with the line breaks that most of its lines have."""
    mark = _BYTE_ORDER_MARK if content.startswith(_BYTE_ORDER_MARK.encode()) else ""
    text = text.replace("\r\n", "\n")
    if 2 * content.count(b"\r\n") > content.count(b"\n"):
        text = text.replace("\n", "\r\n")
    elif b"\r" in content and b"\n" not in content:
        text = text.replace("\n", "\r")
    return mark + text


def _require_size(content: bytes, path: str) -> None:
    try:
        check_size(len(content))
    except OSError as error:
        raise SleecError(f"{path} cannot be written: {error.strerror}", "the file was not changed") from None
