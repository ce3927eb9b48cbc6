"""All kinds of finding of `check`, `conform` and `audit`, by code."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from sleec_verify.audit import kinds as audit
from sleec_verify.checks import CHECKS, FindingKind
from sleec_verify.conformance import structure


class Entry(NamedTuple):
    """A kind of finding, its check, and what its examples consist of."""

    check: str
    question: str
    kind: FindingKind
    example: str


def by_code() -> Mapping[str, Entry]:
    """The kinds in the order of their codes."""
    entries = [Entry(check.name, check.question, kind, "Rules") for check in CHECKS.values() for kind in check.kinds]
    entries += [Entry(structure.NAME, structure.QUESTION, k, "Rules and code") for k in structure.KINDS.values()]
    entries += [Entry(audit.NAME, audit.QUESTION, kind, "Rules and log") for kind in audit.KINDS.values()]
    return {entry.kind.code: entry for entry in sorted(entries, key=lambda entry: entry.kind.code)}


def questions() -> Mapping[str, str]:
    """The question of each check, by the name of the check."""
    return {entry.check: entry.question for entry in by_code().values()}
