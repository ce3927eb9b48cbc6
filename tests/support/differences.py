"""Comparisons of short rules."""

from __future__ import annotations

from sleec_runtime.language import parse
from sleec_verify.changes.compare import Difference, compare

CURTAINS = """\
RULE dress_assist
WHEN CurtainOpenRequest THEN OpenCurtains
UNLESS UserUndressed IN WHICH CASE RefuseRequest AND ExplainWhy
UNLESS UserDistressed IN WHICH CASE WarnUser AND OpenCurtains
"""


def differ(old: str, new: str) -> Difference:
    return compare(parse(old, "old"), parse(new, "new"))


def edit(old: str, *changes: str) -> Difference:
    """`changes` are texts and, behind each, what takes its place."""
    new = old
    for before, after in zip(changes[::2], changes[1::2]):
        assert before in new
        new = new.replace(before, after)
    return differ(old, new)


def gained(found: Difference) -> set[str]:
    return {str(o) for change in found.changes for o in change.added}


def lost(found: Difference) -> set[str]:
    return {str(o) for change in found.changes for o in change.removed}
