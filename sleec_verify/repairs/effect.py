"""What a repair changes: the comparison of the rules before and after it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from sleec_verify.changes.compare import compare

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.changes.compare import Difference
    from sleec_verify.encoding.scope import Scope


@dataclass(frozen=True)
class Effect:
    """The comparison of the rules before and after a repair.

    `situations` is the number of situations without a conflict in which obligations differ, or which an assumption
    excludes; None if it is unknown.
    """

    difference: Difference
    situations: int | None

    @property
    def keeps_meaning(self) -> bool:
        return self.difference.relation == "equivalent"


def effect_of(old: Ruleset, new: Ruleset, scope: Scope) -> Effect:
    """The effect of a repair that changes `old` to `new`. Costs a comparison of both."""
    # The checks of the changed text have shown which conflicts remain.
    difference = compare(old, new, scope.domain, scope.untimed, over_time=False)
    return Effect(difference, _situations(difference))


def _situations(difference: Difference) -> int | None:
    """The sum over all changes; a situation that several changes affect counts several times."""
    if difference.undecided:
        return None
    extents = [change.extent for change in difference.changes]
    extents += [one.extent for one in difference.situations if one.extent is not None]
    numbers = [extent.affected for extent in extents]
    return None if None in numbers else sum(number for number in numbers if number is not None)
