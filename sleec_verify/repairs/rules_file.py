"""A file with rules whose text is edited: everything else keeps its bytes."""

from __future__ import annotations

import os
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass, replace
from hashlib import sha256
from typing import TYPE_CHECKING

from sleec_runtime.errors import SleecError
from sleec_runtime.language.common.source import decode_source
from sleec_runtime.support.files import read_file
from sleec_verify.files.placement import write_whole
from sleec_verify.repairs.edit import TextEdit, edited

if TYPE_CHECKING:
    from sleec_runtime.model import Source

_BYTE_ORDER_MARK = "\ufeff"


class FileChanged(SleecError):
    """A file that is no longer the one that was checked."""


class ReadOnlyFile(SleecError):
    """A file without permission to write it."""


@dataclass(frozen=True)
class RulesFile:
    """The content of a file, edited or not. `sha256` is the digest of the bytes that were checked."""

    path: str
    sha256: str
    content: bytes

    @classmethod
    def of(cls, source: Source) -> RulesFile:
        """The file from which `source` was read.

        Raises:
            FileChanged: it has other bytes now.
            SleecError: it cannot be read.
        """
        assert source.sha256 is not None, "the text is from a file"
        return cls(source.path, source.sha256, _read(source.path, source.sha256))

    @property
    def text(self) -> str:
        """The text as the parser reads it: without a byte order mark, and with ``\\n`` for every lone ``\\r``."""
        return decode_source(self.path, self.content).text

    def edited(self, edits: Iterable[TextEdit]) -> RulesFile:
        """The file with edits of its `text`. All other bytes stay."""
        text = self.content.decode("utf-8")
        mark = _BYTE_ORDER_MARK if text.startswith(_BYTE_ORDER_MARK) else ""
        text = text[len(mark) :]
        if "\r" in text and "\n" not in text:
            edits = (edit._replace(text=edit.text.replace("\n", "\r")) for edit in edits)
        return replace(self, content=f"{mark}{edited(text, edits)}".encode())

    def write(self) -> RulesFile:
        """Replace the file by the edited one, atomically, and return it with its new digest. A link stays a link, and
        the permissions do not change.

        Raises:
            FileChanged: the file is not the one that was checked.
            ReadOnlyFile, SleecError: it cannot be written.
        """
        require_writable(self.path)
        _read(self.path, self.sha256)
        write_whole(self.path, self.content)
        return replace(self, sha256=sha256(self.content).hexdigest())


def require_writable(path: str) -> None:
    """Raises `ReadOnlyFile` if the file at `path` may not be written."""
    # The owner of a folder can replace a read-only file in it, and root can write every file.
    with suppress(FileNotFoundError):
        if not os.stat(path).st_mode & 0o222 or not os.access(path, os.W_OK):
            raise ReadOnlyFile(f"{path} is read-only", "the file was not changed; change its permissions first")


def _read(path: str, expected: str) -> bytes:
    try:
        content = read_file(path)
    except OSError as error:
        raise SleecError(f"{path} cannot be read: {error.strerror}", "the file was not changed") from None
    if sha256(content).hexdigest() != expected:
        raise FileChanged(f"{path} was changed since the check", "nothing was written; check it again")
    return content
