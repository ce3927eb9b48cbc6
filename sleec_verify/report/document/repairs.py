"""The repairs that a report shows, as far as a limit of steps allows."""

from __future__ import annotations

from sleec_verify.checks import Progress
from sleec_verify.encoding.budget import limited_to_steps
from sleec_verify.encoding.scope import Scope
from sleec_verify.repairs.numbering import FindingRepairs, numbered_repairs
from sleec_verify.repairs.operators import OPERATORS
from sleec_verify.repairs.search import RepairSearch
from sleec_verify.report.outcome import CheckedRuleset
from sleec_verify.wording.sentence import sentence

_ENDED = sentence("the search ended at its limit; `sleec-verify check --fixes` searches longer")


def limit(rules: int) -> int:
    """The steps for all repairs of a ruleset: about four seconds for at most 15 rules, and a tenth of a second for 160
    and more. A repair costs a check of all rules, and a report may take three times as long as a check."""
    return max(20_000, min(2_000_000, 500_000_000 // max(rules, 1) ** 2))


def repairs_to_show(
    outcome: CheckedRuleset, scope: Scope, progress: Progress | None = None
) -> tuple[FindingRepairs, ...]:
    """The repairs of each finding that an operator may repair, in the order of the text."""
    findings = [one for one in outcome.deduplicated if one.code in OPERATORS]
    with limited_to_steps(limit(len(outcome.ruleset.rules)), _ENDED):
        search = RepairSearch(outcome.ruleset, outcome.results, scope)
        searched = {id(found.finding): found for found in numbered_repairs(findings, search, progress)}
    return tuple(searched[id(finding)] for finding in findings)
