"""What a repair changes: the comparison of the rules before and after it, in every situation.

A literal counts as due if a rule obliges it, also where the rules contradict each other. So a repair of a conflict
names every duty and prohibition that it removes, those of the conflict as well.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

from sleec_verify.changes.compare import compare
from sleec_verify.checks.conflict import CONFLICT
from sleec_verify.checks.vacuous import VACUOUS_CONFLICT
from sleec_verify.replay.required import Required, required_at_once
from sleec_verify.results.finding import Unknown

if TYPE_CHECKING:
    from sleec_runtime.model import Ruleset
    from sleec_verify.changes.compare import Difference, Extent
    from sleec_verify.encoding.scope import Scope
    from sleec_verify.results.finding import CheckResult, Finding

ABOUT_CONFLICTS = (CONFLICT.name, VACUOUS_CONFLICT.name)
"""The checks whose findings have the situation of a conflict."""


class Conflicts(NamedTuple):
    """The numbers of other conflicts that a repair resolves, and of those about the same obligations that remain
    between rules of the finding and others."""

    resolved: int
    remaining: int


@dataclass(frozen=True)
class Effect:
    """What a repair changes.

    `harm` is how much it takes away: the part of the situations of a rule in which a duty or prohibition is lost,
    summed over all that are lost. `situations` is the number of situations in which obligations or prohibitions differ,
    or which an assumption excludes. Both are None if they are unknown. `after_conflict` is None if the finding has no
    conflict at one instant.
    """

    difference: Difference
    harm: Fraction | None
    situations: int | None
    conflicts: Conflicts
    after_conflict: Required | None

    @property
    def keeps_meaning(self) -> bool:
        """Whether the same is required, forbidden and assumed in every situation."""
        return self.difference.relation == "equivalent"


def effect_of(
    finding: Finding,
    old: Ruleset,
    new: Ruleset,
    scope: Scope,
    before: Sequence[CheckResult],
    after: Sequence[CheckResult],
) -> Effect:
    """The effect of a repair of a finding that changes `old` to `new`. `before` and `after` are the results of their
    checks. Costs a comparison of both."""
    difference = compare(old, new, scope.domain, scope.untimed, over_time=False, in_conflicts=True)
    return Effect(
        difference,
        _harm(finding, old, difference),
        _situations(difference),
        _conflicts(finding, before, after),
        _after_conflict(finding, old, new),
    )


def _harm(finding: Finding, old: Ruleset, difference: Difference) -> Fraction | None:
    """What is lost, each time as a part of the situations of its rule. An assumption takes away what the clauses of the
    finding oblige."""
    if difference.undecided:
        return None
    lost = [(len(change.removed), change.extent) for change in difference.changes if change.removed]
    lost += [(1, one.extent) for one in difference.constraints if one.way == "removed"]
    obliged = sum(len(list(old.by_label[label].clauses())[number].obligations) for label, number in finding.clauses)
    lost += [(max(obliged, 1), one.extent) for one in difference.situations if one.way == "removed" and one.extent]
    parts = [(number, _part(extent)) for number, extent in lost]
    known: list[Fraction] = [part * number for number, part in parts if part is not None]
    return sum(known, Fraction(0)) if len(known) == len(parts) else None


def _part(extent: Extent) -> Fraction | None:
    """The affected part of the situations in which the triggers occur that tell them apart."""
    if extent.affected is None or not extent.possible:
        return None
    triggers = sum(any(kind == "trigger" for kind, _ in variable.names) for variable in extent.over)
    return min(Fraction(1), Fraction(extent.affected, extent.possible) * Fraction(2) ** triggers)


def _situations(difference: Difference) -> int | None:
    """The sum over all changes; a situation that several changes affect counts several times."""
    if difference.undecided:
        return None
    extents = [change.extent for change in difference.changes]
    extents += [one.extent for one in difference.constraints]
    extents += [one.extent for one in difference.situations if one.extent is not None]
    numbers = [extent.affected for extent in extents]
    return None if None in numbers else sum(number for number in numbers if number is not None)


def _conflicts(finding: Finding, before: Sequence[CheckResult], after: Sequence[CheckResult]) -> Conflicts:
    one, other = (_found(results) for results in (before, after))
    if one is None or other is None:
        return Conflicts(0, 0)
    resolved = len(one) - len(other) - (finding.check == CONFLICT.name)
    remaining = [
        conflict
        for conflict in other
        if not set(conflict.rules).isdisjoint(finding.rules)
        and not set(conflict.obligations).isdisjoint(finding.obligations)
    ]
    return Conflicts(max(resolved, 0), len(remaining) if finding.check == CONFLICT.name else 0)


def _found(results: Sequence[CheckResult]) -> Sequence[Finding] | None:
    """The conflicts that a check found; None if there may be others."""
    result = next((one for one in results if one.name == CONFLICT.name), None)
    if result is None or result.reason is not None or isinstance(result.verdict, Unknown):
        return None
    return result.findings


def _after_conflict(finding: Finding, old: Ruleset, new: Ruleset) -> Required | None:
    if finding.check not in ABOUT_CONFLICTS or finding.witness is None or finding.timeline is not None:
        return None
    context = finding.witness.context()
    domain = next(iter(finding.domains), None)
    if domain is not None:
        old, new = old.in_domain(domain), new.in_domain(domain)
    before, after = required_at_once(old, context), required_at_once(new, context)
    return after if before is not None and before.is_conflict else None
