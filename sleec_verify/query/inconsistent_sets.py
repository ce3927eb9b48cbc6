"""The minimal inconsistent sets of literals: obligations that cannot all be due.

What is due in a context is a set of literals. The context conflicts if these, the context and the constraints have no
common model over O (a "for all" over obligations inside an "exists" over contexts). The due literals are units. So it
is enough to know every minimal set of literals that the constraints exclude, each with the situations in which they do.
Then "is there a conflicting context" is one question of satisfiability for each set.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

from sleec_runtime.model import Exclusive, Formula, Never, Obligation
from sleec_verify.encoding.budget import spend
from sleec_verify.encoding.equation import conjunction

Constraint = Exclusive | Never


@dataclass(frozen=True)
class InconsistentSet:
    """Literals that cannot all be due if the situation makes all the `labels` true.

    `origins` are the constraints that exclude them. A name and its own negation have none.
    """

    literals: frozenset[Obligation]
    labels: frozenset[Formula] = frozenset()
    origins: tuple[Constraint, ...] = ()

    @property
    def situation(self) -> Formula:
        """The situations in which the literals are inconsistent, as one formula over triggers, conditions and
        measures."""
        return conjunction(sorted(self.labels, key=repr))


@dataclass(frozen=True)
class Exclusion:
    """Literals of which no two can be due together: an EXCLUSIVE of many names, without a list of its pairs."""

    literals: tuple[Obligation, ...]
    origin: Exclusive

    def clash(self, one: Obligation, other: Obligation) -> InconsistentSet:
        """The inconsistent set of two of its literals."""
        return InconsistentSet(frozenset((one, other)), origins=(self.origin,))


class InconsistentSets:
    """The minimal inconsistent sets of literals: those that are `listed`, and all pairs of each of the `exclusions`."""

    def __init__(self, listed: Sequence[InconsistentSet], exclusions: Sequence[Exclusion] = ()) -> None:
        self.listed = listed
        self.exclusions = exclusions

    def __bool__(self) -> bool:
        return bool(self.listed or self.exclusions)

    def __iter__(self) -> Iterator[InconsistentSet]:
        """Every set. Quadratic in the size of an exclusion."""
        yield from self.listed
        for exclusion in self.exclusions:
            for one, other in combinations(exclusion.literals, 2):
                spend(1)
                yield exclusion.clash(one, other)

    def literals(self) -> set[Obligation]:
        """The literals of all sets."""
        held = [*(clash.literals for clash in self.listed), *(set(exclusion.literals) for exclusion in self.exclusions)]
        return set().union(*held)

    @cached_property
    def _by_literal(self) -> dict[Obligation | None, list[InconsistentSet]]:
        """The sets by their smallest literals."""
        index: dict[Obligation | None, list[InconsistentSet]] = {}
        for clash in self.listed:
            index.setdefault(min(clash.literals, default=None, key=str), []).append(clash)
        return index

    @cached_property
    def _excluded(self) -> list[frozenset[Obligation]]:
        return [frozenset(exclusion.literals) for exclusion in self.exclusions]

    def among(self, literals: Collection[Obligation]) -> InconsistentSets:
        """The sets that consist of these literals. O(the literals, and the sets whose smallest literal is one of
        them)."""
        # Sorted, so that the same rules give the same clauses.
        ordered = sorted(set(literals), key=str)
        known = set(ordered)
        listed = [c for one in (None, *ordered) for c in self._by_literal.get(one, ()) if c.literals <= known]
        exclusions = []
        for exclusion, excluded in zip(self.exclusions, self._excluded):
            within = tuple(literal for literal in ordered if literal in excluded)
            if len(within) > 1:
                exclusions.append(Exclusion(within, exclusion.origin))
        return InconsistentSets(listed, exclusions)


def opposite(literal: Obligation) -> Obligation:
    return Obligation(literal.name, not literal.negated)
