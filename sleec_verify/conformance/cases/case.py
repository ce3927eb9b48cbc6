"""One situation and what is to be done in it, as a cases file has it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from sleec_runtime.errors import SleecError
from sleec_runtime.model import Context, Value


class CasesError(SleecError):
    """A file of cases that cannot be used: malformed, or at odds with the names of its ruleset."""


@dataclass(frozen=True)
class Case:
    """When these occur and this is given (all else is false), this is obliged.

    `prohibitions` None says nothing of them. `conflict`: the rules cannot all be obeyed, and nothing is due. `reaches`
    are the goals that a chosen case was chosen for.
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
