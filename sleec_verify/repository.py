"""The rulesets of a git repository: those of a commit, and those in the working tree.

Git is asked through its executable; nothing in the repository or its index is changed.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Callable, Collection, Sequence

from sleec_runtime.errors import UnreadableFile
from sleec_runtime.files import check_size
from sleec_verify import git
from sleec_verify.folders import SUFFIX, files_at, leads_below
from sleec_verify.git import GitError
from sleec_verify.revisions import Place, Versions

NOW = "the files as they are now"


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
        if b"safe.bareRepository" in done.stderr or (kept and leads_below(os.curdir, kept, "")):
            raise GitError("the current folder is inside a git directory", "go to a folder of the working tree")
        if b"dubious ownership" in done.stderr:
            raise GitError(
                "git does not trust this repository: its folder belongs to somebody else",
                'as in a container; if you do: git config --global --add safe.directory "$PWD"',
            )
        if done.returncode:
            raise GitError("this folder is in no git repository", "go to the folder of the rulesets, or name two files")
        self.folder = os.path.realpath(folder)

    def commit(self, revision: str) -> str:
        """The commit that a revision means. Raises `GitError`."""
        found = self._commit(revision)
        if found is None:
            raise GitError(f"there is no revision {revision or '(empty)'} in this repository", self._hint(revision))
        return found

    def _commit(self, revision: str) -> str | None:
        if not revision or revision.startswith(("-", "^")):
            return None
        # In two steps: behind `:/text`, `^{commit}` would be part of the text.
        done = git.run("rev-parse", "--verify", "--quiet", revision)
        if not done.returncode:
            done = git.run("rev-parse", "--verify", "--quiet", f"{done.stdout.decode().strip()}^{{commit}}")
        return None if done.returncode else done.stdout.decode().strip()

    def _hint(self, revision: str) -> str:
        from sleec_runtime.language.suggest import nearest

        if git.run("rev-list", "--max-count=1", "--all", "HEAD", "--").returncode:
            return "nothing has been committed yet; a first commit has nothing to be compared with"
        if not revision or revision.startswith("-") or not revision.isprintable():
            return "name a branch, a tag or a commit"
        if revision.startswith(":/"):
            return "no commit that HEAD or a branch reaches has a message with this text"
        if ":" in revision:
            return "name a commit, and the file behind it: --git {} {}".format(*revision.split(":", 1))
        if any(mark in revision for mark in ("~", "^", "@{")):
            return "in CI, fetch the whole history"
        done = git.run("for-each-ref", "--format=%(refname:short)")
        names = done.stdout.decode("utf-8", "replace").split()
        # A clone has branches of others under the name of where it got them, too.
        near = next((name for name in names if name.endswith(f"/{revision}")), nearest(revision, names))
        if near is not None:
            return f"did you mean {near}?"
        branch = revision.removeprefix("origin/")
        if not branch or git.run("check-ref-format", "--branch", branch).returncode:
            return "name a branch, a tag or a commit"
        return f"in CI, fetch it first (git fetch origin {branch}), and name it origin/{branch}"

    def merge_base(self, one: str, other: str) -> str:
        """The newest commit that two revisions have in common. Raises `GitError`."""
        done = git.run("merge-base", self.commit(one), self.commit(other))
        if done.returncode:
            raise GitError(
                f"{one} and {other} have no commit in common", "in CI, fetch the whole history: git fetch --unshallow"
            )
        return done.stdout.decode().strip()

    def range(self, written: str) -> tuple[tuple[str, str], tuple[str, str | None]]:
        """What ``REV``, ``OLD..NEW`` and ``OLD...NEW`` (from what they have in common) mean: for each side how to call
        it, and its commit; None for the files as they are now. An empty end is HEAD. Raises `GitError`."""
        dots = "..." if "..." in written else ".." if ".." in written else None
        whole = self._commit(written) if dots is not None else self.commit(written)
        if dots is None or whole is not None:  # the text behind `:/` may have dots
            assert whole is not None, "it is a commit"
            return (written, whole), (NOW, None)
        first, _, last = written.partition(dots)
        first, last = first or "HEAD", last or "HEAD"
        old, new = self.commit(first), self.commit(last)
        if dots == "...":
            old = self.merge_base(first, last)
            first = old[:10]
        return (first, old), (last, new)

    def inside(self, path: str) -> str:
        """A path as the repository has it. Raises `GitError` for one outside of it, or that git keeps for itself."""
        if not leads_below(path, self.folder, ""):
            raise GitError(f"{path} is not in the working tree of {self.folder}", "name a path below it")
        return os.path.relpath(os.path.realpath(path), self.folder).replace(os.sep, "/")

    def files(self, commit: str, path: str) -> dict[str, str]:
        """The rulesets at or below a path in a commit, and the file of that very path, with their objects."""
        return {name: blob for name, blob in self._tree(commit, path).items() if name == path or name.endswith(SUFFIX)}

    def _tree(self, commit: str, path: str) -> dict[str, str]:
        """The files at or below a path in a commit, without links and submodules."""
        arguments = [] if path == "." else ["--", path]
        done = git.run("ls-tree", "-r", "-z", "--full-tree", commit, *arguments)
        if done.returncode:
            raise GitError(f"git cannot list {path} in {commit}: {git.complaint(done)}")
        found = {}
        for entry in filter(None, done.stdout.split(b"\0")):
            about, _, name = entry.partition(b"\t")
            mode, _, blob = about.split()
            if mode.startswith(b"100"):
                found[os.fsdecode(name)] = blob.decode()
        return found

    def content(self, blob: str) -> bytes:
        """The bytes of an object.

        Raises:
            GitError: it is missing, as in a partial clone: nothing is fetched.
            OSError: it is larger than the limit.
        """
        check_size(int(self._cat("-s", blob)))
        return self._cat("blob", blob)

    def _cat(self, what: str, blob: str) -> bytes:
        done = git.run("cat-file", what, blob)
        if done.returncode:
            raise GitError(
                f"git cannot read the object {blob}: {git.complaint(done)}",
                "a partial clone does not have all files: clone without --filter",
            )
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

    def touched(self, commit: str, paths: Collection[str]) -> set[str]:
        """Those of `paths`, files or folders of the repository, at or below which something is not as in a commit."""
        before = self._tree(commit, ".")
        files = [file for path in paths for file in files_at(os.path.join(self.folder, path))]
        now = {os.path.relpath(file, self.folder): Place(file).named(len(commit)) for file in files}
        changed = [name for name in before.keys() | now.keys() if before.get(name) != now.get(name)]
        return {path for name in changed for path in _with_parents(name)} & {*paths}

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
        done = git.run("-C", self.folder, *listing)
        if done.returncode:
            raise GitError(f"git cannot list {path}: {git.complaint(done)}")
        found = {}
        for entry in filter(None, done.stdout.split(b"\0")):
            status, _, rest = entry.partition(b" ")
            about, _, raw = (b"", b"", rest) if status == b"?" else rest.partition(b"\t")
            name = os.fsdecode(raw)
            if name.endswith(SUFFIX):
                shown = os.path.normpath(os.path.join(path, os.path.relpath(name, inside)))
                if not leads_below(shown, self.folder, SUFFIX):
                    self._skipped(shown)
                elif _is_file(shown):
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


def _with_parents(name: str) -> list[str]:
    parts = name.split("/")
    return ["/".join(parts[:number]) for number in range(1, len(parts) + 1)]
