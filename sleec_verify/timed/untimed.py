"""A ruleset as far as it does not speak of time."""

from __future__ import annotations

from dataclasses import replace

from sleec_runtime.model import Clause, Rule, Ruleset
from sleec_runtime.model_time import RELATIONS, Claim


def untimed(ruleset: Ruleset) -> Ruleset:
    """`ruleset` without what speaks of time: responses with times, concerns, purposes, relations."""
    return replace(
        ruleset,
        statements=tuple(
            replace(s, default=_untimed(s.default), hedges=tuple(map(_untimed, s.hedges))) if isinstance(s, Rule) else s
            for s in ruleset.statements
            if not isinstance(s, (Claim, *RELATIONS))
        ),
    )


def _untimed(clause: Clause) -> Clause:
    return replace(
        clause,
        obligations=tuple(o for o in clause.obligations if o.timing is None),
        hedges=tuple(map(_untimed, clause.hedges)),
    )
