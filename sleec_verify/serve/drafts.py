"""Drafts: texts that are not saved yet, in the user's state folder, so that they survive a killed server."""

from __future__ import annotations

import json
import os
from contextlib import suppress
from typing import NamedTuple

from sleec_runtime.errors import SleecError
from sleec_runtime.support.files import check_size, read_file
from sleec_verify.serve.state_folder import keep, state_path


class Draft(NamedTuple):
    """A text, and the digest of the file on which it is based; None if there was no file."""

    text: str
    based_on: str | None


class DraftStore:
    """The draft for one file, in a folder that its user alone can read."""

    def __init__(self, path: str, folder: str | None = None) -> None:
        """`path` is the file. Without a `folder`, drafts are in the user's state folder."""
        self._draft = state_path(path, "drafts", folder)

    def read(self) -> Draft | None:
        """The draft; None if there is none, or if its file has another content."""
        try:
            found = json.loads(read_file(self._draft))
            text, based_on = found["text"], found["based_on"]
        except (OSError, ValueError, KeyError, TypeError, RecursionError):
            return None
        if not isinstance(text, str) or not (based_on is None or isinstance(based_on, str)):
            return None
        return Draft(text, based_on)

    def keep(self, draft: Draft) -> None:
        """Store the draft, atomically.

        Raises:
            SleecError: it cannot be stored.
        """
        try:
            content = json.dumps(draft._asdict(), ensure_ascii=False).encode()
            check_size(len(content))  # `read` refuses larger ones
            keep(self._draft, content)
        except OSError as error:
            folder = os.path.dirname(self._draft)
            raise SleecError(f"the draft cannot be stored in {folder}: {error.strerror}", "save the file") from None

    def forget(self) -> None:
        """Remove the draft."""
        with suppress(OSError):
            os.unlink(self._draft)
