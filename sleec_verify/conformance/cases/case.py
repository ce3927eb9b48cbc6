"""One test case: a situation and what is due in it, as in a cases file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from sleec_runtime.errors import SleecError
from sleec_runtime.model import Context, Value


class CasesError(SleecError):
    """An invalid file of cases: malformed, or with names that its ruleset does not have."""


@dataclass(frozen=True)
class Case:
    """What is due if these triggers occur and these values hold (all others are false).

    If `prohibitions` is None, they are not tested. `conflict`: the rules conflict, and nothing is due. `reaches` are
    the goals of a selected case.
    """

    name: str
    triggers: tuple[str, ...]
    conditions: Mapping[str, Value]
    obligations: tuple[str, ...] = ()
    prohibitions: tuple[str, ...] | None = None
    conflict: bool = False
    domain: str | None = None
    reaches: tuple[str, ...] = ()

    def context(self) -> Context:
        return Context(frozenset(self.triggers), dict(self.conditions))
