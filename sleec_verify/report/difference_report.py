"""All that `diff` shows: each ruleset on both sides, and the assertions."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from sleec_verify.changes.compare import relation

if TYPE_CHECKING:
    from sleec_runtime.errors import SleecError
    from sleec_verify.changes.assertions.assertion import AssertionResult
    from sleec_verify.changes.compare import (
        Difference,
        Relation,
    )


class RulesetDifference(NamedTuple):
    """One ruleset on both sides: the difference, or the errors of a side."""

    path: str
    difference: Difference | None
    errors: tuple[SleecError, ...] = ()


class DifferenceReport(NamedTuple):
    """The results: each compared ruleset, the number of files with equal texts, and the assertions."""

    compared: tuple[RulesetDifference, ...]
    unchanged: int = 0
    asked: tuple[AssertionResult, ...] = ()

    @property
    def differences(self) -> list[Difference]:
        return [one.difference for one in self.compared if one.difference is not None]

    @property
    def relation(self) -> Relation:
        """The relation of all rulesets together."""
        found = self.differences
        unusable = any(one.errors for one in self.compared)
        return relation(
            any(one.more for one in found),
            any(one.less for one in found),
            any(one.conflict_ways for one in found),
            unusable or any(one.undecided for one in found),
        )
