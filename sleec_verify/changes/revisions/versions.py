"""Two versions of rulesets: the text of each side, and its path."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import NamedTuple

from sleec_runtime.errors import SleecError, UnreadableFile
from sleec_runtime.language.common.source import decode_source, read_source
from sleec_runtime.model import Source
from sleec_runtime.support.files import read_file
from sleec_verify.files.folders import SUFFIX, rulesets_below


class MissingSide(SleecError):
    """A ruleset that only one side has."""


class UnreadSubmodule(SleecError):
    """A submodule whose rulesets cannot be read, because it is not checked out or lacks a commit."""


class Version(NamedTuple):
    """The location of one version: a file (`name` is its path), or an object (`blob`) of a repository, which
    `content` reads."""

    name: str
    blob: str | None = None
    content: Callable[[str], bytes] | None = None

    def named(self, digits: int) -> str | None:
        """Git's name for the content, with this number of digits; None if it cannot be read."""
        return self.blob or _blob_of(self.name, digits)

    def read(self) -> Source:
        """The text. Raises `UnreadableFile`."""
        if self.content is None or self.blob is None:
            return read_source(self.name)
        try:
            return decode_source(self.name, self.content(self.blob))
        except OSError as error:
            raise UnreadableFile(f"{self.name} cannot be read: {error.strerror}") from None


class Versions(NamedTuple):
    """A ruleset on both sides; None for a side without it. `path` is its name."""

    path: str
    old: Version | None
    new: Version | None

    @property
    def unchanged(self) -> bool:
        """Whether both texts have the same bytes, as far as this is known without parsing."""
        if self.old is None or self.new is None or self.old.blob is None:
            return False
        return self.old.blob == self.new.named(len(self.old.blob))

    def one_sided(self, old: str, new: str) -> MissingSide | None:
        """The message if only one of the sides, called `old` and `new`, has it."""
        if self.old is None:
            return MissingSide(
                f"{self.path} was added: it is not in {old}",
                "use --missing-as-empty to compare it with an empty ruleset",
            )
        if self.new is None:
            return MissingSide(
                f"{self.path} was deleted: it is not in {new}",
                "use --missing-as-empty to compare it with an empty ruleset",
            )
        return None


def of_paths(old: str, new: str, skipped: Callable[[str], None]) -> list[Versions]:
    """The rulesets of two files, or of two folders, paired by their paths below the folders. `skipped` is called for
    each link that is not followed.

    Raises:
        UnreadableFile: a file and a folder, a folder without rulesets, or both are standard input.
    """
    if os.path.isdir(old) != os.path.isdir(new):
        for path in (old, new):
            if path != "-" and not os.path.lexists(path):
                raise UnreadableFile(f"folder {path} does not exist", "check its name")
        folder, file = (old, new) if os.path.isdir(old) else (new, old)
        raise UnreadableFile(f"{folder} is a folder, but {file} is not", "name two files, or two folders")
    if not os.path.isdir(old):
        if old == new == "-":
            raise UnreadableFile("standard input cannot be both sides", "use a file for one of them")
        return [Versions(new, Version(old), Version(new))]
    sides = [_below(old, skipped), _below(new, skipped)]
    paths = sorted({*sides[0], *sides[1]})
    if not paths:
        raise UnreadableFile(f"there is no {SUFFIX} file below {old} and {new}", "name other folders")
    return [
        Versions(
            path,
            Version(os.path.join(old, path)) if path in sides[0] else None,
            Version(os.path.join(new, path)) if path in sides[1] else None,
        )
        for path in paths
    ]


def _below(folder: str, skipped: Callable[[str], None]) -> set[str]:
    """The paths of the rulesets below a folder, relative to `folder`. Raises `UnreadableFile` for an unreadable
    folder."""

    def refuse(error: OSError) -> None:
        raise UnreadableFile(f"the folder {os.fspath(error.filename)} cannot be read: {error.strerror}")

    return {os.path.relpath(path, folder) for path in rulesets_below(folder, refuse, skipped)}


def _blob_of(path: str, digits: int) -> str | None:
    """Git's name for the content of a file; None if it cannot be read, which is reported when it is read."""
    from hashlib import sha1, sha256

    try:
        data = read_file(path)
    except OSError:
        return None
    content = b"blob %d\0%s" % (len(data), data)
    return (sha1(content, usedforsecurity=False) if digits == 40 else sha256(content)).hexdigest()
