"""The situations in which responses that are required together are inconsistent."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from sleec_runtime.model import Clause, Formula, Obligation, Or
from sleec_verify.encoding.equation import conjunction
from sleec_verify.query.inconsistent_sets import InconsistentSet, InconsistentSets


def clashes(
    guards: Iterable[tuple[Formula, Clause]], inconsistent: InconsistentSets
) -> list[tuple[InconsistentSet, Formula]]:
    """The inconsistent sets of responses without windows, each with the situations in which all of it is due.

    `guards` are the situations in which each clause decides.
    """
    due: dict[Obligation, list[Formula]] = {}
    for guard, clause in guards:
        for one in clause.obligations:
            if one.timing is None:
                due.setdefault(one, []).append(guard)
    found = []
    for clash in inconsistent.among(due):
        if clash.literals:
            together = [_any_of(due[literal]) for literal in sorted(clash.literals, key=str)]
            found.append((clash, conjunction([*together, clash.situation])))
    return found


def _any_of(formulas: Sequence[Formula]) -> Formula:
    return formulas[0] if len(formulas) == 1 else Or(tuple(formulas))
