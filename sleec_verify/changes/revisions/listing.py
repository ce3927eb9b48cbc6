"""The rulesets of a commit and of the working tree, with those that a link or a submodule contains.

A robot loads a ruleset through links and from submodules. So a ruleset does not disappear if a change replaces its
file or folder by one of these. Links inside the repository are followed, but in a folder behind a link, no further ones
to folders, and no link to a folder that contains the link. A submodule is listed if it is checked out.
"""

from __future__ import annotations

import os
import posixpath
import stat
from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

from sleec_runtime.errors import UnreadableFile
from sleec_runtime.support.files import check_size
from sleec_verify.changes.revisions import git
from sleec_verify.changes.revisions.git import GitError
from sleec_verify.changes.revisions.versions import UnreadSubmodule, Version
from sleec_verify.files.folders import is_ruleset, leads_below

LINK, SUBMODULE, FILE = "120000", "160000", "100"
"""The modes of git for links and submodules, and how those of files start."""

MOST_LINKS = 40
"""The number of links to links that are followed, as in Linux."""


class Entry(NamedTuple):
    """An entry of a tree or of the index: its path, mode and object. `left_out`: of a sparse checkout."""

    name: str
    mode: str
    blob: str | None
    left_out: bool = False


def entries_of_commit(folder: str, commit: str, path: str, *options: str) -> Iterator[Entry]:
    """The entries of a commit at a path of the repository in `folder`. Raises `GitError`."""
    where = [] if path == "." else ["--", path]
    done = git.run("-C", folder, "ls-tree", "-z", "--full-tree", *options, commit, *where)
    if done.returncode:
        raise GitError(f"git cannot list the files of {commit}: {git.complaint(done)}")
    for entry in filter(None, done.stdout.split(b"\0")):
        about, _, name = entry.partition(b"\t")
        mode, _, blob = about.decode().split()
        yield Entry(os.fsdecode(name), mode, blob)


def entries_now(folder: str, path: str) -> Iterator[Entry]:
    """What git would commit at a path of the repository in `folder`: the index, and new files that it does not ignore.

    Raises:
        GitError: git cannot list it.
    """
    listing = ("ls-files", "-z", "-t", "--stage", "--cached", "--others", "--exclude-standard", "--", path)
    done = git.run("-C", folder, *listing)
    if done.returncode:
        raise GitError(f"git cannot list {path}: {git.complaint(done)}")
    for entry in filter(None, done.stdout.split(b"\0")):
        status, _, rest = entry.partition(b" ")
        if status == b"?":
            yield Entry(os.fsdecode(rest), "", None)
        else:
            about, _, name = rest.partition(b"\t")
            mode, blob, _ = about.decode().split()
            yield Entry(os.fsdecode(name), mode, blob, status == b"S")


def content_of(folder: str) -> Callable[[str], bytes]:
    """A function that reads an object of the repository in `folder`.

    It raises `GitError` if the object is missing, as in a partial clone, because nothing is fetched; and `OSError` if
    it is larger than the limit.
    """

    def cat(what: str, blob: str) -> bytes:
        done = git.run("-C", folder, "cat-file", what, blob)
        if done.returncode:
            raise GitError(
                f"git cannot read the object {blob}: {git.complaint(done)}",
                "a partial clone does not have all files: clone without --filter",
            )
        return done.stdout

    def content(blob: str) -> bytes:
        check_size(int(cat("-s", blob)))
        return cat("blob", blob)

    return content


class CommitListing(NamedTuple):
    """The rulesets of a commit, which messages call `name`, in the repository in `folder`."""

    folder: str
    name: str
    commit: str

    def rulesets(self, path: str) -> dict[str, Version]:
        """The rulesets at or below a path, and the file at exactly that path.

        Raises:
            GitError: git cannot list or read it.
        """
        found: dict[str, Version] = {}
        links: dict[str, str | None] | None = None
        for entry in self._entries(path):
            if entry.mode == LINK:
                if links is None:
                    links = {one.name: one.blob for one in self._entries(".") if one.mode == LINK}
                found |= self._behind(entry, links)
            elif entry.mode == SUBMODULE:
                found |= self._in_submodule(entry)
            elif entry.name == path or is_ruleset(entry.name):
                found[entry.name] = self._version(entry.name, entry)
        return found

    def _entries(self, path: str) -> Iterator[Entry]:
        return entries_of_commit(self.folder, self.commit, path, "-r")

    def _version(self, name: str, entry: Entry) -> Version:
        return Version(f"{self.name}:{name}", entry.blob, content_of(self.folder))

    def _behind(self, link: Entry, links: Mapping[str, str | None]) -> dict[str, Version]:
        target = self._resolved(link.name, links)
        if target is None or _contains(target, link.name):
            return {}
        below = ((one, link.name + one.name[len(target) :]) for one in self._entries(target))
        files = ((one, name) for one, name in below if one.mode.startswith(FILE))
        return {name: self._version(name, one) for one, name in files if is_ruleset(one.name) and is_ruleset(name)}

    def _resolved(self, path: str, links: Mapping[str, str | None]) -> str | None:
        """The path without `links` in it; None if it leaves the repository, or has too many of them. `links` are the
        objects of all links of the commit."""
        for _ in range(MOST_LINKS):
            link = next((one for one in (*_parents(path), path) if one in links), None)
            if link is None:
                return path
            written = os.fsdecode(content_of(self.folder)(links[link] or ""))
            path = posixpath.normpath(posixpath.join(posixpath.dirname(link), written) + path[len(link) :])
            if path == ".." or path.startswith(("../", "/")):
                return None
        return None

    def _in_submodule(self, entry: Entry) -> dict[str, Version]:
        assert entry.blob is not None, "an entry of a commit has an object"
        folder = os.path.join(self.folder, entry.name)
        called = f"{self.name}:{entry.name}"
        if not is_repository(folder):
            return _unread(entry, called)
        try:
            inside = CommitListing(folder, called, entry.blob).rulesets(".")
        except GitError:
            return _unread(entry, called)
        return {f"{entry.name}/{name}": version._replace(name=f"{called}/{name}") for name, version in inside.items()}


class CurrentListing(NamedTuple):
    """The rulesets of the working tree of the repository in `folder`. `skipped` is called for each link that does not
    lead to a ruleset below `top`."""

    folder: str
    top: str
    skipped: Callable[[str], None]

    def rulesets(self, path: str) -> dict[str, Version]:
        """The rulesets that git would commit at or below a path, and those that a link or a submodule there contains:
        nothing that git ignores, and nothing of another repository in it.

        Raises:
            GitError, UnreadableFile: git cannot list it, or a folder may not be read.
        """
        found: dict[str, Version] = {}
        for entry in entries_now(self.folder, path):
            whole = os.path.join(self.folder, entry.name)
            shown = os.path.relpath(whole)
            if entry.mode == SUBMODULE:
                found |= self._in_submodule(entry)
            elif os.path.islink(whole) and os.path.isdir(whole):
                found |= self._behind(entry, shown)
            elif not is_ruleset(entry.name):
                continue
            elif not self._leads_to_ruleset(shown):
                self.skipped(shown)
            elif _is_file(shown):
                found[entry.name] = Version(shown)
            elif entry.left_out:  # use the version in the index
                found[entry.name] = Version(shown, entry.blob, content_of(self.folder))
        return found

    def _leads_to_ruleset(self, shown: str) -> bool:
        return leads_below(shown, self.top) and is_ruleset(os.path.realpath(shown))

    def _behind(self, link: Entry, shown: str) -> dict[str, Version]:
        """The rulesets of the folder that a link leads to."""
        if not leads_below(shown, self.top):
            return {}
        target = os.path.relpath(os.path.realpath(shown), self.folder)
        found: dict[str, Version] = {}
        if _contains(target, link.name):
            return found
        for entry in entries_now(self.folder, target):
            name = link.name + entry.name[len(target) :]
            file = os.path.relpath(os.path.join(self.folder, name))
            if is_ruleset(name) and self._leads_to_ruleset(file) and _is_file(file):
                found[name] = Version(file)
        return found

    def _in_submodule(self, entry: Entry) -> dict[str, Version]:
        folder = os.path.join(self.folder, entry.name)
        if not is_repository(folder):
            return _unread(entry, os.path.relpath(folder))
        inside = self._replace(folder=folder).rulesets(".")
        return {f"{entry.name}/{name}": version for name, version in inside.items()}


def _parents(path: str) -> Iterator[str]:
    """The folders of a path, the outermost first."""
    return (path[:end] for end, character in enumerate(path) if character == "/")


def _contains(folder: str, path: str) -> bool:
    return folder == "." or path.startswith(f"{folder}/")


def is_repository(folder: str) -> bool:
    """Whether a folder is the top of a repository of its own, as that of a checked-out submodule is."""
    if not os.path.isdir(folder):
        return False
    done = git.run("-C", folder, "rev-parse", "--show-toplevel")
    return not done.returncode and os.fsdecode(done.stdout).rstrip("\n") == os.path.realpath(folder)


def _unread(submodule: Entry, called: str) -> dict[str, Version]:
    """One version in place of the rulesets of a submodule, which cannot be read. It is the same for the same commit."""

    def refuse(_: str) -> bytes:
        raise UnreadSubmodule(
            f"the rulesets of the submodule {called} cannot be read",
            "check the submodule out with its history: git submodule update --init",
        )

    return {submodule.name: Version(called, submodule.blob, refuse)}


def _is_file(path: str) -> bool:
    """Whether the path is a file. Raises `UnreadableFile` if this is unknown."""
    try:
        return stat.S_ISREG(os.stat(path).st_mode)
    except PermissionError:
        folder = os.path.dirname(path)
        raise UnreadableFile(f"the folder {folder} cannot be read: Permission denied") from None
    except OSError:
        return False
