"""What people read in a name, and what to write instead."""

from __future__ import annotations

from typing import NamedTuple

from sleec_runtime.model import DeclaredKind

KINDS: tuple[DeclaredKind, ...] = ("trigger", "condition", "obligation")
"""What names stand for. Measures count as conditions."""

NEGATION, MODAL, COMPARISON, OPPOSITE, FOREIGN_KEYWORD, SIMILAR, SLIP = range(7)
"""The kinds of misreading, in the order of their codes."""


class Misreading(NamedTuple):
    """A name that people read differently than the rules do.

    `instead` is the text to write for the name at each of its places; None if only the author knows it. `other` is a
    name that is confused with it.
    """

    kind: int
    name: str
    message: str
    help: str
    instead: str | None = None
    other: str | None = None
