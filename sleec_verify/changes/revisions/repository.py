"""The rulesets of a git repository: those of a commit, and those in the working tree.

Git is asked through its executable; nothing in the repository or its index is changed.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Mapping, Sequence

from sleec_runtime.errors import UnreadableFile
from sleec_verify.changes.revisions import git
from sleec_verify.changes.revisions.git import GitError
from sleec_verify.changes.revisions.listing import (
    FILE,
    CommitListing,
    CurrentListing,
    content_of,
    entries_of_commit,
)
from sleec_verify.changes.revisions.versions import Version, Versions
from sleec_verify.files.folders import GIT, SUFFIX, files_at, leads_below


class Repository:
    """The repository of the current folder."""

    def __init__(self, skipped: Callable[[str], None]) -> None:
        """`skipped` is called for each link in the working tree that does not lead to a ruleset of the repository.

        Raises:
            GitError: there is no git, or no repository with files.
        """
        self._skipped = skipped
        done = git.run("rev-parse", "--absolute-git-dir", "--show-toplevel")
        kept, _, folder = os.fsdecode(done.stdout).rstrip("\n").partition("\n")
        # A bare repository in the working tree may be part of a change; git before 2.38 takes it for the current one.
        if b"safe.bareRepository" in done.stderr or (kept and leads_below(os.curdir, kept)):
            raise GitError("the current folder is inside a git directory", "change to a folder of the working tree")
        if b"dubious ownership" in done.stderr:
            raise GitError(
                "git does not trust this repository: its folder belongs to another user",
                'as in a container; if you trust it: git config --global --add safe.directory "$PWD"',
            )
        if done.returncode:
            raise GitError(
                "this folder is not in a git repository", "change to the folder of the rulesets, or name two files"
            )
        self.folder = os.path.realpath(folder)

    def position(self, path: str) -> str | None:
        """The path relative to the top of the repository; None outside of it, and for git's own files.

        A link in the working tree remains a link. A link in place of a folder must not lead to the rules of another
        folder.
        """
        return next(iter(self._positions(path)), None)

    def _positions(self, path: str) -> list[str]:
        """The positions of the path itself, and of the target of its links."""
        ways = (os.path.join(os.path.realpath(os.curdir), path), os.path.realpath(path))
        found = (os.path.relpath(os.path.normpath(way), self.folder).split(os.sep) for way in ways)
        inside = (parts for parts in found if parts[0] != os.pardir and GIT not in map(str.lower, parts))
        return list(dict.fromkeys("/".join(parts) for parts in inside))

    def here(self, path: str) -> str:
        """The path of a file or folder of the working tree, relative to the current folder.

        Raises:
            GitError: a link leads out of the working tree.
        """
        shown = os.path.relpath(os.path.join(self.folder, path))
        if not leads_below(shown, self.folder):
            raise GitError(f"{shown} points outside the repository", "replace the link by the file")
        return _as_file(shown)

    def entry(self, commit: str, path: str) -> tuple[str, str] | None:
        """The mode and the object of a path in a commit; None if there is none."""
        found = (one for one in entries_of_commit(self.folder, commit, path) if one.name == path)
        return next(((one.mode, one.blob) for one in found if one.blob is not None), None)

    def content(self, blob: str) -> bytes:
        """The bytes of an object. Raises as `content_of` does."""
        return content_of(self.folder)(blob)

    def versions(
        self,
        old: tuple[str, str],
        new: tuple[str, str | None],
        paths: Sequence[str],
        also: Collection[str] = (),
    ) -> list[Versions]:
        """The rulesets at or below `paths` on two sides, as `revision_range` gives them; and those that git lists at or
        below the positions `also`, if there are any.

        Raises:
            GitError, UnreadableFile: one of `paths` that neither side has, or none with rulesets.
        """
        found: dict[str, Versions] = {}

        def add(before: Mapping[str, Version], after: Mapping[str, Version]) -> None:
            for name in sorted({*before, *after}):
                found.setdefault(name, Versions(name, before.get(name), after.get(name)))

        for path in paths:
            for inside in self._inside(path):
                before = self._in_commit(*old, inside)
                if before:
                    break
            after = self._now(path, inside) if new[1] is None else self._in_commit(new[0], new[1], inside)
            if not before and not after:
                raise UnreadableFile(
                    f"there is no {SUFFIX} file at or below {path}, neither in {old[0]} nor in {new[0]}",
                    "check its name and folder",
                )
            add(before, after)
        for inside in sorted(also):
            add(self._in_commit(*old, inside), self._listed(inside))
        return list(found.values())

    def now(self, paths: Sequence[str]) -> dict[str, Version]:
        """The current rulesets at or below `paths`.

        Raises:
            GitError, UnreadableFile: a path without rulesets.
        """
        found: dict[str, Version] = {}
        for path in paths:
            there = self._now(path, self._inside(path)[-1])
            if not there:
                raise UnreadableFile(f"there is no {SUFFIX} file at or below {path}", "check its name")
            found |= there
        return found

    def paths(self, commit: str) -> set[str]:
        """The paths of all files of a commit."""
        return {one.name for one in entries_of_commit(self.folder, commit, ".", "-r")}

    def touched(self, commit: str, paths: Collection[str]) -> set[str]:
        """Those of `paths`, files or folders of the repository, that differ from a commit, or contain a difference."""
        entries = entries_of_commit(self.folder, commit, ".", "-r")
        before = {one.name: one.blob for one in entries if one.mode.startswith(FILE)}
        files = [file for path in paths for file in files_at(os.path.join(self.folder, path))]
        now = {os.path.relpath(file, self.folder): Version(file).named(len(commit)) for file in files}
        changed = [name for name in before.keys() | now.keys() if before.get(name) != now.get(name)]
        return {path for name in changed for path in _with_parents(name)} & {*paths}

    def _in_commit(self, called: str, commit: str, path: str) -> dict[str, Version]:
        return CommitListing(self.folder, called, commit).rulesets(path)

    def _inside(self, path: str) -> list[str]:
        """The positions of a path, at least one. Raises `GitError` if there is none."""
        found = self._positions(path)
        if not found:
            raise GitError(f"{path} is not in the working tree of {self.folder}", "name a path below it")
        return found

    def _now(self, path: str, inside: str) -> dict[str, Version]:
        """The current rulesets at or below a path. A named file is used as it is, unless it is a link that leads
        out of the working tree."""
        if not leads_below(path, self.folder):
            self._skipped(path)
            return {}
        if os.path.lexists(path) and not os.path.isdir(path):
            return {inside: Version(_as_file(path))}
        return self._listed(inside)

    def _listed(self, inside: str) -> dict[str, Version]:
        return CurrentListing(self.folder, self.folder, self._skipped).rulesets(inside)


def _as_file(path: str) -> str:
    """A path that never stands for standard input."""
    return os.path.join(os.curdir, path) if path == "-" else path


def _with_parents(name: str) -> list[str]:
    parts = name.split("/")
    return ["/".join(parts[:number]) for number in range(1, len(parts) + 1)]
