"""The rulesets of a folder."""

from __future__ import annotations

import os
from collections.abc import Callable

SUFFIX = ".sleec"


def rulesets_below(folder: str, refused: Callable[[OSError], None]) -> list[str]:
    """The paths of the rulesets at or below `folder`, sorted. `refused` is told of each folder that may not be read.

    What git keeps for itself is left out: a branch may be called fix.sleec, and is no ruleset.
    """
    found = []
    for parent, folders, names in os.walk(folder, onerror=refused):
        folders[:] = [name for name in folders if name != ".git"]
        found += [os.path.join(parent, name) for name in names if name.endswith(SUFFIX)]
    return sorted(found)


def files_at(path: str) -> list[str]:
    """The file at `path`, or those below it if it is a folder; none if there is nothing."""
    if not os.path.isdir(path):
        return [path] if os.path.lexists(path) else []
    return [os.path.join(parent, name) for parent, _, names in os.walk(path) for name in names]
