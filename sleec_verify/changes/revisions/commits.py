"""The meaning of revisions, in the repository of the current folder.

Git reads a short name by a list of rules (gitrevisions(7)), in which a tag comes before a branch, and a branch before
an abbreviated hash. So a person who may create tags or branches could choose the commit that a name means. Here a name
has one meaning, or it is rejected. Git always reads a full hash as a hash.
"""

from __future__ import annotations

import re

from sleec_verify.changes.revisions import git
from sleec_verify.changes.revisions.git import GitError

NOW = "the current files"

Named = tuple[str, str]
"""The name of a commit in messages, and the commit."""


_NAME_END = re.compile(r"[~^:]|@\{")
"""The end of the name in a revision such as ``main~2``."""

_PSEUDO_REF = re.compile(r"@|[A-Z_]+")
_HASH = re.compile(r"[0-9a-f]{40}|[0-9a-f]{64}", re.IGNORECASE)
_ABBREVIATED = re.compile(r"[0-9a-f]{4,63}", re.IGNORECASE)
_PLACES = ("refs/tags/{}", "refs/heads/{}", "refs/remotes/{}", "refs/remotes/{}/HEAD", "refs/{}")


def commit(revision: str) -> str:
    """The commit of a revision. Raises `GitError`, also for a name with more than one meaning."""
    found = _commit(revision)
    if found is None:
        raise GitError(f"there is no revision {revision or '(empty)'} in this repository", _hint(revision))
    return found


def _commit(revision: str) -> str | None:
    if not revision or revision.startswith(("-", "^")):
        return None
    revision = _with_full_name(revision)
    # After `:/text`, which always names a commit, `^{commit}` would be part of the text.
    kind = "" if revision.startswith(":/") else "^{commit}"
    done = git.run("rev-parse", "--verify", "--quiet", f"{revision}{kind}")
    return None if done.returncode else done.stdout.decode().strip()


def _with_full_name(revision: str) -> str:
    """The revision with the full name of its tag or branch. Raises `GitError` if the name has more than one meaning."""
    end = _NAME_END.search(revision)
    name = revision[: end.start()] if end else revision
    if not name or name.startswith("refs/") or _PSEUDO_REF.fullmatch(name) or _HASH.fullmatch(name):
        return revision
    places = [place.format(name) for place in _PLACES]
    listed = git.run("for-each-ref", "--format=%(refname)", "--", *places)
    meanings = [found for found in listed.stdout.decode("utf-8", "replace").split() if found in places]
    if _ABBREVIATED.fullmatch(name):
        meanings += git.run("rev-parse", f"--disambiguate={name}").stdout.decode().split()
    if len(meanings) > 1:
        raise GitError(
            f"{name} has more than one meaning: {', '.join(meanings)}",
            f"write {meanings[0]} in full, or another of them",
        )
    # Git reads `@{upstream}` only after the short name of a branch.
    is_ref = len(meanings) == 1 and meanings[0].startswith("refs/") and not revision[len(name) :].startswith("@{")
    return f"{meanings[0]}{revision[len(name) :]}" if is_ref else revision


def _hint(revision: str) -> str:
    from sleec_runtime.support.suggestions import nearest

    if git.run("rev-list", "--max-count=1", "--all", "HEAD", "--").returncode:
        return "the repository has no commits; there is nothing to compare with"
    if not revision or revision.startswith("-") or not revision.isprintable():
        return "name a branch, a tag or a commit"
    if revision.startswith(":/"):
        return "no commit message in the history of HEAD or of a branch contains this text"
    if ":" in revision:
        return "name a commit and then the file: --git {} {}".format(*revision.split(":", 1))
    if any(mark in revision for mark in ("~", "^", "@{")):
        return "in CI, fetch the whole history"
    done = git.run("for-each-ref", "--format=%(refname:short)")
    names = done.stdout.decode("utf-8", "replace").split()
    # A clone also has the branches of its remotes, under their names.
    near = next((name for name in names if name.endswith(f"/{revision}")), nearest(revision, names))
    if near is not None:
        return f"did you mean {near}?"
    branch = revision.removeprefix("origin/")
    if not branch or git.run("check-ref-format", "--branch", branch).returncode:
        return "name a branch, a tag or a commit"
    return f"in CI, fetch it first (git fetch origin {branch}), and name it origin/{branch}"


def merge_base(one: Named, other: Named) -> str:
    """The newest common commit of two commits. Raises `GitError`."""
    done = git.run("merge-base", one[1], other[1])
    if done.returncode:
        raise GitError(
            f"{one[0]} and {other[0]} have no common commit",
            "in CI, fetch the whole history: git fetch --unshallow",
        )
    return done.stdout.decode().strip()


def revision_range(written: str) -> tuple[Named, tuple[str, str | None]]:
    """The sides of ``REV``, ``OLD..NEW`` and ``OLD...NEW`` (from the newest common commit): for each its name, and
    its commit; None for the current files. An empty end is HEAD. Raises `GitError`."""
    dots = "..." if "..." in written else ".." if ".." in written else None
    whole = _commit(written) if dots is not None else commit(written)
    if dots is None or whole is not None:  # the text behind `:/` may have dots
        assert whole is not None, "it is a commit"
        return (written, whole), (NOW, None)
    first, _, last = written.partition(dots)
    first, last = first or "HEAD", last or "HEAD"
    old, new = commit(first), commit(last)
    if dots == "...":
        old = merge_base((first, old), (last, new))
        first = old[:10]
    return (first, old), (last, new)
