"""The identity of the rules of a node, which all nodes must share."""

from __future__ import annotations

from typing import NamedTuple

from sleec_runtime.dispatch.snapshot import Snapshot
from sleec_runtime.facade.host import Host
from sleec_runtime.model import Ruleset
from sleec_runtime.timed.checkpoint import identity


class Identity(NamedTuple):
    """The SHA-256 of the text of the rules, and their reading."""

    ruleset: str
    reading: str

    def __str__(self) -> str:
        return f"{self.ruleset[:12]} ({self.reading})"


class Identifier:
    """Computes the identity of rules once, until other rules replace them."""

    def __init__(self) -> None:
        self._known: tuple[Ruleset, Identity] | None = None

    def identity(self, context: Snapshot) -> Identity:
        """The identity of the rules of a context. Raises SnapshotRefused for rules that were not read from a text."""
        whole = context.index.whole
        if self._known is None or self._known[0] is not whole:
            found = identity(context.index, chains=False)
            self._known = whole, Identity(str(found["sha256"]), str(found["reading"]))
        return self._known[1]


def snapshot_of(sleec: Host) -> Snapshot:
    """The current context."""
    return sleec.hold(lambda snapshot: snapshot)
