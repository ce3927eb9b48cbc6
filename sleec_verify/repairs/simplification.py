"""Repairs that need no decision: the text says the same afterwards, or writes one name in one way."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from sleec_runtime.model import Ruleset
from sleec_verify.checks import run_checks
from sleec_verify.encoding.trace_scope import Untimed
from sleec_verify.repairs.operators import REMOVALS
from sleec_verify.repairs.repair import Repair
from sleec_verify.repairs.search import RepairSearch
from sleec_verify.results.finding import CheckResult

_CODES = frozenset((*REMOVALS, "SLEEC507", "SLEEC508", "SLEEC513"))
"""The findings that are repaired without a question, if the repair keeps the meaning."""

_ONE_NAME = "SLEEC525"
"""A variant of another name is a slip, because an author who means two names declares both."""


def simplifications(
    ruleset: Ruleset,
    results: Sequence[CheckResult],
    domain: str | None = None,
    untimed: Untimed = "at",
    chains: bool = True,
) -> Iterator[Repair]:
    """Repairs that change no meaning, or write one name in one way.

    Each is one of the rules after the repair before it, until there are no more. One at a time, because a repair may
    make another one wrong: of two equal rules, each is redundant as long as the other is there. The last of them goes
    first. `results` are those of `ruleset`, made with the same options. Each repair costs some checks.
    """
    while True:
        search = RepairSearch(ruleset, results, domain, untimed, chains)
        findings = [
            finding for result in results for finding in result.findings if finding.code in (*_CODES, _ONE_NAME)
        ]
        ordered = sorted(findings, key=lambda finding: finding.span, reverse=True)
        kept = (one for finding in ordered for one in search.repairs(finding) if _needs_no_decision(one))
        repair = next(kept, None)
        if repair is None:
            return
        yield repair
        ruleset = repair.repaired
        results = run_checks(ruleset, None, domain, untimed=untimed, chains=chains)


def _needs_no_decision(repair: Repair) -> bool:
    return repair.effect.keeps_meaning or repair.finding.code == _ONE_NAME
