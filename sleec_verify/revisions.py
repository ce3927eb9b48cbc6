"""Two versions of rulesets, from files, folders, or a git repository: what stands on each side, and under which path.

Git is asked through its executable; nothing in the repository or its index is changed.
"""

from __future__ import annotations

import os
import stat
import subprocess
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from sleec_runtime.errors import SleecError, UnreadableFile
from sleec_runtime.files import read_file
from sleec_runtime.language.source import read_source, source_of
from sleec_runtime.model import Source
from sleec_verify.folders import SUFFIX, rulesets_below

NOW = "the files as they are now"


class GitError(SleecError):
    """What git cannot do for us: there is no git, no repository, or no such revision."""


class OneSided(SleecError):
    """A ruleset that only one side has."""


class Place(NamedTuple):
    """Where one version is: a file (`name` is its path), or an object of the repository. `key` is the same for equal
    texts, where that is known without reading them."""

    name: str
    blob: str | None = None
    repository: Repository | None = None

    def named(self, digits: int) -> str | None:
        """What git calls, or would call, the content in so many digits; None where it cannot be read."""
        return self.blob or _blob_of(self.name, digits)

    def read(self) -> Source:
        """The text. Raises `UnreadableFile`."""
        if self.repository is None or self.blob is None:
            return read_source(self.name)
        return source_of(self.name, self.repository.content(self.blob))


class Versions(NamedTuple):
    """A ruleset on both sides; None on the side that has it not. `path` is what it is called."""

    path: str
    old: Place | None
    new: Place | None

    @property
    def unchanged(self) -> bool:
        """Whether both texts are the same, byte for byte, as far as that is seen without reading rules."""
        if self.old is None or self.new is None or self.old.blob is None:
            return False
        return self.old.blob == self.new.named(len(self.old.blob))

    def one_sided(self, old: str, new: str) -> OneSided | None:
        """What to say where only one of the sides, called `old` and `new`, has it."""
        if self.old is None:
            return OneSided(
                f"{self.path} is not in {old}: it was added, and there is nothing to compare it with",
                "--missing-as-empty compares it with no rules at all",
            )
        if self.new is None:
            return OneSided(
                f"{self.path} is not in {new}: it was deleted, and there is nothing to compare it with",
                "--missing-as-empty compares it with no rules at all",
            )
        return None


def of_paths(old: str, new: str) -> list[Versions]:
    """The rulesets of two files, or of two folders, in which those of one path below them belong together.

    Raises:
        UnreadableFile: a file and a folder, a folder without rulesets, or both are standard input.
    """
    if os.path.isdir(old) != os.path.isdir(new):
        for path in (old, new):
            if path != "-" and not os.path.lexists(path):
                raise UnreadableFile(f"there is no folder {path}", "check the spelling of its name")
        folder, file = (old, new) if os.path.isdir(old) else (new, old)
        raise UnreadableFile(f"{folder} is a folder, and {file} is not", "name two files, or two folders")
    if not os.path.isdir(old):
        if old == new == "-":
            raise UnreadableFile("standard input cannot be both sides", "name a file for one of them")
        return [Versions(new, Place(old), Place(new))]
    sides = [below(old), below(new)]
    paths = sorted({*sides[0], *sides[1]})
    if not paths:
        raise UnreadableFile(f"there is no {SUFFIX} file below {old} and {new}", "name other folders")
    return [
        Versions(
            path,
            Place(os.path.join(old, path)) if path in sides[0] else None,
            Place(os.path.join(new, path)) if path in sides[1] else None,
        )
        for path in paths
    ]


def below(folder: str) -> set[str]:
    """The paths, from `folder`, of the rulesets below it. Raises `UnreadableFile` for a folder that may not be read."""

    def refuse(error: OSError) -> None:
        raise UnreadableFile(f"the folder {os.fspath(error.filename)} cannot be read: {error.strerror}")

    return {os.path.relpath(path, folder) for path in rulesets_below(folder, refuse)}


def _blob_of(path: str, digits: int) -> str | None:
    """What git would call the content of a file; None where it cannot be read, which is told when it is read."""
    from hashlib import sha1, sha256

    try:
        data = read_file(path)
    except OSError:
        return None
    content = b"blob %d\0%s" % (len(data), data)
    return (sha1(content, usedforsecurity=False) if digits == 40 else sha256(content)).hexdigest()


# Git ------------------------------------------------------------------------------------------------------


class Repository:
    """The repository of the current folder."""

    def __init__(self) -> None:
        """Raises `GitError` where there is no git, or no repository with files."""
        done = _git("rev-parse", "--show-toplevel")
        if done.returncode:
            if b"dubious ownership" in done.stderr:
                raise GitError(
                    "git does not trust this repository: its folder belongs to somebody else",
                    'as in a container; if you do: git config --global --add safe.directory "$PWD"',
                )
            if not _git("rev-parse", "--git-dir").returncode:
                raise GitError("this folder is inside what git keeps for itself", "go to a folder with the files")
            raise GitError("this folder is in no git repository", "go to the folder of the rulesets, or name two files")
        self.folder = os.path.realpath(os.fsdecode(done.stdout).rstrip("\n"))

    def commit(self, revision: str) -> str:
        """The commit that a revision means. Raises `GitError`."""
        done = None
        if revision and not revision.startswith("-"):
            done = _git("rev-parse", "--verify", "--quiet", f"{revision}^{{commit}}")
        if done is None or done.returncode:
            raise GitError(f"there is no revision {revision or '(empty)'} in this repository", self._hint(revision))
        return done.stdout.decode().strip()

    def _hint(self, revision: str) -> str:
        from sleec_runtime.language.suggest import nearest

        if _git("rev-list", "--max-count=1", "--all", "HEAD", "--").returncode:
            return "nothing has been committed yet; a first commit has nothing to be compared with"
        if not revision or revision.startswith("-") or not revision.isprintable():
            return "name a branch, a tag or a commit"
        if ":" in revision:
            return "name a commit, and the file behind it: --git {} {}".format(*revision.split(":", 1))
        if any(mark in revision for mark in ("~", "^", "@{")):
            return "in CI, fetch the whole history"
        done = _git("for-each-ref", "--format=%(refname:short)")
        names = done.stdout.decode("utf-8", "replace").split()
        # A clone has branches of others under the name of where it got them, too.
        near = next((name for name in names if name.endswith(f"/{revision}")), nearest(revision, names))
        if near is not None:
            return f"did you mean {near}?"
        branch = revision.removeprefix("origin/")
        if not branch or _git("check-ref-format", "--branch", branch).returncode:
            return "name a branch, a tag or a commit"
        return f"in CI, fetch it first (git fetch origin {branch}), and name it origin/{branch}"

    def merge_base(self, one: str, other: str) -> str:
        """The newest commit that two revisions have in common. Raises `GitError`."""
        done = None if one.startswith("-") or not one else _git("merge-base", one, other)
        if done is None or done.returncode:
            # Only now does it matter whether one of them is no revision.
            self.commit(one)
            self.commit(other)
            raise GitError(
                f"{one} and {other} have no commit in common", "in CI, fetch the whole history: git fetch --unshallow"
            )
        return done.stdout.decode().strip()

    def range(self, written: str) -> tuple[tuple[str, str], tuple[str, str | None]]:
        """What ``REV``, ``OLD..NEW`` and ``OLD...NEW`` (from what they have in common) mean: for each side how to call
        it, and its commit; None for the files as they are now. An empty end is HEAD. Raises `GitError`."""
        dots = "..." if "..." in written else ".." if ".." in written else None
        if dots is None:
            return (written, self.commit(written)), (NOW, None)
        first, _, last = written.partition(dots)
        first, last = first or "HEAD", last or "HEAD"
        old, new = self.commit(first), self.commit(last)
        if dots == "...":
            old = self.merge_base(first, last)
            first = old[:10]
        return (first, old), (last, new)

    def inside(self, path: str) -> str:
        """A path as the repository has it. Raises `GitError` for one outside of it."""
        found = os.path.relpath(os.path.realpath(path), self.folder)
        if found.split(os.sep)[0] == os.pardir:
            raise GitError(f"{path} is not in the repository {self.folder}", "name a path below it")
        return found.replace(os.sep, "/")

    def files(self, commit: str, path: str) -> dict[str, str]:
        """The files at or below a path in a commit, with their objects."""
        arguments = [] if path == "." else ["--", path]
        done = _git("ls-tree", "-r", "-z", "--full-tree", commit, *arguments)
        if done.returncode:
            raise GitError(f"git cannot list {path} in {commit}: {_said(done)}")
        found = {}
        for entry in filter(None, done.stdout.split(b"\0")):
            about, _, name = entry.partition(b"\t")
            mode, _, blob = about.split()
            if mode.startswith(b"100"):  # no links, no submodules
                found[os.fsdecode(name)] = blob.decode()
        return {name: blob for name, blob in found.items() if name == path or name.endswith(SUFFIX)}

    def content(self, blob: str) -> bytes:
        """The bytes of an object. Raises `GitError` where it is missing, as in a partial clone without network."""
        done = _git("cat-file", "blob", blob)
        if done.returncode:
            raise GitError(f"git cannot read the object {blob}: {_said(done)}")
        return done.stdout

    def versions(self, old: tuple[str, str], new: tuple[str, str | None], paths: Sequence[str]) -> list[Versions]:
        """The rulesets at or below `paths` on two sides, as `range` gives them.

        Raises:
            GitError, UnreadableFile: a path that neither side has, or none with rulesets.
        """
        found: dict[str, Versions] = {}
        for path in paths:
            inside = self.inside(path)
            before = self.files(old[1], inside)
            after = self._now(path, inside) if new[1] is None else self._in_commit(new[0], new[1], inside)
            if not before and not after:
                raise UnreadableFile(
                    f"there is no {SUFFIX} file at or below {path}, neither in {old[0]} nor in {new[0]}",
                    "check the spelling of its name and folder",
                )
            for name in sorted({*before, *after}):
                place = Place(f"{old[0]}:{name}", before[name], self) if name in before else None
                found.setdefault(name, Versions(name, place, after.get(name)))
        return list(found.values())

    def now(self, paths: Sequence[str]) -> dict[str, Place]:
        """The rulesets at or below `paths` as they are now.

        Raises:
            GitError, UnreadableFile: a path without rulesets.
        """
        found: dict[str, Place] = {}
        for path in paths:
            there = self._now(path, self.inside(path))
            if not there:
                raise UnreadableFile(f"there is no {SUFFIX} file at or below {path}", "check the spelling of its name")
            found |= there
        return found

    def touched(self, commit: str) -> set[str]:
        """The paths of all files that git keeps and that are not as in a commit, those that are gone included."""
        arguments = ("diff", "--name-only", "-z", "--no-renames", "--no-ext-diff", "--ignore-submodules", commit)
        done = _git("-C", self.folder, *arguments, "--")
        if done.returncode:
            raise GitError(f"git cannot compare the files with {commit}: {_said(done)}")
        return {os.fsdecode(name) for name in done.stdout.split(b"\0") if name}

    def _in_commit(self, called: str, commit: str, path: str) -> dict[str, Place]:
        return {name: Place(f"{called}:{name}", blob, self) for name, blob in self.files(commit, path).items()}

    def _now(self, path: str, inside: str) -> dict[str, Place]:
        """What stands there: for a folder what git would commit of it, so nothing that it ignores, no link, and nothing
        of another repository in it, such as a submodule. A file that is named is taken as it is.

        Raises:
            GitError, UnreadableFile: git cannot list it, or a folder may not be read.
        """
        if os.path.lexists(path) and not os.path.isdir(path):
            return {inside: Place(path)}
        listing = ("ls-files", "-z", "-t", "--stage", "--cached", "--others", "--exclude-standard", "--", inside)
        done = _git("-C", self.folder, "--literal-pathspecs", *listing)
        if done.returncode:
            raise GitError(f"git cannot list {path}: {_said(done)}")
        found = {}
        for entry in filter(None, done.stdout.split(b"\0")):
            status, _, rest = entry.partition(b" ")
            about, _, raw = (b"", b"", rest) if status == b"?" else rest.partition(b"\t")
            name = os.fsdecode(raw)
            if name.endswith(SUFFIX):
                shown = os.path.normpath(os.path.join(path, os.path.relpath(name, inside)))
                if _is_file(shown):
                    found[name] = Place(shown)
                elif status == b"S":  # left out of a sparse checkout: it is as it is in the index
                    found[name] = Place(shown, about.split()[1].decode(), self)
        return found


def _is_file(path: str) -> bool:
    """Whether there is a file, not a link to one. Raises `UnreadableFile` where that may not be known."""
    try:
        return stat.S_ISREG(os.lstat(path).st_mode)
    except PermissionError:
        folder = os.path.dirname(path)
        raise UnreadableFile(f"the folder {folder} cannot be read: Permission denied") from None
    except OSError:
        return False


def _git(*arguments: str) -> subprocess.CompletedProcess[bytes]:
    environment = {**os.environ, "LC_ALL": "C", "GIT_OPTIONAL_LOCKS": "0", "GIT_TERMINAL_PROMPT": "0"}
    try:
        return subprocess.run(
            ["git", *arguments], stdin=subprocess.DEVNULL, capture_output=True, check=False, env=environment
        )
    except FileNotFoundError:
        raise GitError("there is no git on this machine", "install it, or name two files or folders") from None
    except (OSError, ValueError) as error:
        raise GitError(f"git cannot be run: {error}") from None


def _said(done: subprocess.CompletedProcess[bytes]) -> str:
    lines: Iterable[str] = done.stderr.decode("utf-8", "replace").strip().splitlines()
    return next(iter(lines), "it does not say why")
