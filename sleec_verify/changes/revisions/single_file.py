"""Single files of a repository: those of a commit, or those of the working tree."""

from __future__ import annotations

import os
import posixpath
from typing import NamedTuple

from sleec_runtime.errors import UnreadableFile
from sleec_runtime.support.files import read_file
from sleec_verify.changes.revisions.git import GitError
from sleec_verify.changes.revisions.listing import FILE, LINK, MOST_LINKS
from sleec_verify.changes.revisions.repository import Repository
from sleec_verify.files.folders import leads_below


class Tree(NamedTuple):
    """The files of `commit`, which messages call `name`; those of the working tree where it is None."""

    repository: Repository
    name: str = ""
    commit: str | None = None

    def called(self, path: str) -> str:
        """What messages call a path of the repository on this side."""
        if self.commit is not None:
            return f"{self.name}:{path}"
        return os.path.relpath(os.path.join(self.repository.folder, path))

    def read(self, path: str) -> bytes | None:
        """The content of a path of the repository; None if there is no file. Links inside the repository are followed.

        Raises:
            GitError: a link points outside the repository.
            UnreadableFile: the file cannot be read.
        """
        return self._read_now(path) if self.commit is None else self._read_committed(path, self.commit)

    def _read_now(self, path: str) -> bytes | None:
        target = os.path.join(self.repository.folder, path)
        if not os.path.lexists(target) or os.path.isdir(target):
            return None
        if not leads_below(target, self.repository.folder):
            raise self._leads_out(path)
        try:
            return read_file(target)
        except OSError as error:
            raise self._unreadable(path, error) from None

    def _read_committed(self, path: str, commit: str) -> bytes | None:
        for _ in range(MOST_LINKS):
            mode, blob = self.repository.entry(commit, path) or ("", "")
            if not mode.startswith((FILE, LINK)):
                return None
            try:
                content = self.repository.content(blob)
            except OSError as error:
                raise self._unreadable(path, error) from None
            if mode != LINK:
                return content
            target = posixpath.normpath(posixpath.join(posixpath.dirname(path), os.fsdecode(content)))
            if target.startswith(("../", "/")):
                raise self._leads_out(path)
            path = target
        raise self._leads_out(path)

    def _unreadable(self, path: str, error: OSError) -> UnreadableFile:
        return UnreadableFile(f"{self.called(path)} cannot be read: {error.strerror}")

    def _leads_out(self, path: str) -> GitError:
        return GitError(f"{self.called(path)} points outside the repository", "replace the link by the file")
