"""The repairs that a report shows, as far as a limit of steps allows."""

from __future__ import annotations

from sleec_verify.checks import Progress
from sleec_verify.encoding.budget import limited_to_steps
from sleec_verify.encoding.scope import Scope
from sleec_verify.repairs.numbering import FindingRepairs, numbered_repairs
from sleec_verify.repairs.operators import OPERATORS
from sleec_verify.repairs.search import RepairSearch
from sleec_verify.report.outcome import CheckedRuleset
from sleec_verify.results.finding import SEVERITIES
from sleec_verify.wording.sentence import sentence

_ENDED = sentence("the search ended at its limit; `sleec-verify check --fixes` searches without it")
_NOT_SEARCHED = sentence("the search ended before this finding; `sleec-verify check --fixes` searches without a limit")


def limit(rules: int) -> int:
    """The steps for all repairs of a ruleset: about four seconds for at most 15 rules, and a tenth of a second for 160
    and more. A repair costs a check of all rules, and a report may take three times as long as a check."""
    return max(20_000, min(2_000_000, 500_000_000 // max(rules, 1) ** 2))


def repairs_to_show(
    outcome: CheckedRuleset, scope: Scope, progress: Progress | None = None
) -> tuple[FindingRepairs, ...]:
    """The repairs of each finding that an operator may repair, in the order of the text. Errors come first in the
    search."""
    findings = [one for one in outcome.deduplicated if one.code in OPERATORS]
    order = sorted(range(len(findings)), key=lambda number: SEVERITIES.index(findings[number].severity))
    found: dict[int, FindingRepairs] = {}
    with limited_to_steps(limit(len(outcome.ruleset.rules)), _ENDED) as budget:
        search = RepairSearch(outcome.ruleset, outcome.results, scope)
        repairs = numbered_repairs([findings[number] for number in order], search, progress)
        for number in order:
            if budget.is_spent():
                break
            found[number] = next(repairs)
    return tuple(
        found.get(number, FindingRepairs(finding, (), _NOT_SEARCHED)) for number, finding in enumerate(findings)
    )
