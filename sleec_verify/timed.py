"""Rulesets with times, concerns, purposes or relations: which checks cannot decide them yet, and why.

What does not depend on time is still decided exactly; nothing else is answered as if the times were not there.
"""

from __future__ import annotations

from dataclasses import replace

from sleec_runtime.model import Clause, Rule, Ruleset
from sleec_runtime.model_time import RELATIONS, Claim, ClaimKind, Construct, claims, constructs
from sleec_verify.finding import CheckResult, Finding, Proved, Unknown, Verdict

_NEEDS_TIME = frozenset({"conflict", "vacuous-conflict", "redundant-rule", "redundant-hedge"})
_NEEDS_RELATIONS = frozenset({"dead-rule", "dead-hedge", "reading"})
_FINDS_ALL_THE_SAME = frozenset({"dead-rule", "dead-hedge"})
"""What is found without the relations is found with them: they only rule situations out."""

_CLAIM_CHECKS: tuple[ClaimKind, ...] = ("concern", "purpose")


def undecided(ruleset: Ruleset, check: str) -> str | None:
    """Why `check` cannot be decided for `ruleset`; None if it can."""
    if check not in _NEEDS_TIME and check not in _NEEDS_RELATIONS:
        return None
    found = list(constructs(ruleset))
    if check in _NEEDS_RELATIONS:
        relations = {s.span for s in ruleset.statements if isinstance(s, RELATIONS)}
        found = [construct for construct in found if construct.span in relations]
    return f"{_named(ruleset, found)}: not analysed yet" if found else None


def may_find(check: str) -> bool:
    """Whether the findings of an undecided check stay true."""
    return check in _FINDS_ALL_THE_SAME


def undecided_verdict(why: str, decided: Verdict | None) -> Unknown:
    findings: tuple[Finding, ...] = () if decided is None or isinstance(decided, Proved) else decided.findings
    return Unknown(why, findings)


def claim_checks(ruleset: Ruleset) -> list[str]:
    """The checks for the concerns and purposes that a ruleset has."""
    return [kind for kind in _CLAIM_CHECKS if claims(ruleset, kind)]


def claim_results(ruleset: Ruleset, wanted: set[str]) -> list[CheckResult]:
    """The verdicts on the concerns and purposes that a ruleset has."""
    results = []
    for kind in _CLAIM_CHECKS:
        found = claims(ruleset, kind)
        if found and kind in wanted:
            named = [Construct(f"the {kind} {claim.label}", claim.span) for claim in found]
            results.append(CheckResult(kind, Unknown(f"{_named(ruleset, named)}: not analysed yet"), 0.0))
    return results


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


def _named(ruleset: Ruleset, found: list[Construct]) -> str:
    said = [f"{construct.name} in line {ruleset.source.place(construct.span).line}" for construct in found[:4]]
    more = len(found) - len(said)
    return ", ".join(said) + (f" and {more:,} more" if more else "")
