"""The rulesets of a folder, and which links in it are followed."""

from __future__ import annotations

import os
from collections.abc import Callable

SUFFIX = ".sleec"
GIT = ".git"


def is_ruleset(path: str) -> bool:
    """Whether a file has the suffix of rulesets. Case does not count, because some file systems ignore it."""
    return path.lower().endswith(SUFFIX)


def beside(path: str, suffix: str) -> str:
    """The path with this suffix in place of that of rulesets: ``ward.cases.toml`` for ``ward.sleec``."""
    return (path[: -len(SUFFIX)] if is_ruleset(path) else path) + suffix


def rulesets_below(folder: str, refused: Callable[[OSError], None], skipped: Callable[[str], None]) -> list[str]:
    """The paths of the rulesets at or below `folder`, sorted.

    `refused` is called for each folder that is not readable, and `skipped` for each link that does not lead to a
    ruleset below `folder`, because naming a folder does not ask for other files. Git's own files are left out: a branch
    may be called fix.sleec without being a ruleset.
    """
    found = []
    for parent, folders, names in os.walk(folder, onerror=refused):
        folders[:] = [name for name in folders if name != GIT]
        for path in (os.path.join(parent, name) for name in names if is_ruleset(name)):
            if not os.path.islink(path) or (leads_below(path, folder) and is_ruleset(os.path.realpath(path))):
                found.append(path)
            else:
                skipped(path)
    return sorted(found)


def files_at(path: str) -> list[str]:
    """The file at `path`, or the files below it if it is a folder; none if there is nothing."""
    if not os.path.isdir(path):
        return [path] if os.path.lexists(path) else []
    return [os.path.join(parent, name) for parent, _, names in os.walk(path) for name in names]


def leads_below(path: str, folder: str) -> bool:
    """Whether `path`, after following its links, is at or below `folder`, and is not one of git's own files."""
    target = os.path.realpath(path)
    parts = os.path.relpath(target, os.path.realpath(folder)).split(os.sep)
    return parts[0] != os.pardir and GIT not in map(str.lower, parts)
