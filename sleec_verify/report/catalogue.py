"""Every kind of finding by its code, of `check` and of `conform`, for those who list or explain them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from sleec_verify.checks import CHECKS, FindingKind
from sleec_verify.conformance import structure


class Entry(NamedTuple):
    """A kind of finding, the check that makes it, and what its examples are."""

    check: str
    question: str
    kind: FindingKind
    example: str


def by_code() -> Mapping[str, Entry]:
    """The kinds in the order of their codes."""
    entries = [Entry(check.name, check.question, kind, "Rules") for check in CHECKS.values() for kind in check.kinds]
    entries += [Entry(structure.NAME, structure.QUESTION, k, "Rules and code") for k in structure.KINDS.values()]
    return {entry.kind.code: entry for entry in sorted(entries, key=lambda entry: entry.kind.code)}


def questions() -> Mapping[str, str]:
    """What each check asks, by its name."""
    return {entry.check: entry.question for entry in by_code().values()}
