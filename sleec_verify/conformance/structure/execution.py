"""What a variant executes, as values."""

from __future__ import annotations

import ast
from dataclasses import dataclass, field
from typing import NamedTuple

from sleec_verify.conformance.structure.target import PythonFile


class Call(NamedTuple):
    """A call of what implements an obligation. `why` says why it may not be executed exactly once; None if it is."""

    obligation: str
    node: ast.AST
    file: PythonFile
    why: str | None


class Doubt(NamedTuple):
    """A place that cannot be decided without running the program."""

    node: ast.AST
    file: PythonFile
    why: str


@dataclass
class Execution:
    """What one variant does. `unfollowed` are calls of inherited or imported code that is not in the target;
    `triggers` are those that it triggers for certain while nothing has changed, so far as is seen (`changed`)."""

    calls: list[Call] = field(default_factory=list)
    doubts: list[Doubt] = field(default_factory=list)
    proceeds: list[tuple[ast.AST, PythonFile]] = field(default_factory=list)
    unfollowed: list[str] = field(default_factory=list)
    triggers: list[tuple[str, ast.AST, PythonFile]] = field(default_factory=list)
    changed: bool = False

    def then(self, other: Execution) -> Execution:
        """This, and then the other."""
        return Execution(
            self.calls + other.calls,
            self.doubts + other.doubts,
            self.proceeds + other.proceeds,
            self.unfollowed + other.unfollowed,
            self.triggers + ([] if self.changed else other.triggers),
            self.changed or other.changed,
        )

    @property
    def executed(self) -> list[str]:
        """The obligations that are executed for certain, in order."""
        return [call.obligation for call in self.calls if call.why is None]
