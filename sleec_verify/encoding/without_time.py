"""A ruleset without its constructs for time."""

from __future__ import annotations

from dataclasses import replace

from sleec_runtime.model import RELATIONS, Claim, Clause, Rule, Ruleset


def without_time(ruleset: Ruleset) -> Ruleset:
    """`ruleset` without responses with windows, concerns, purposes and relations."""
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
