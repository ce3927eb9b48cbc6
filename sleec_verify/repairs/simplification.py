"""Repairs that need no decision: the text says the same afterwards, or writes one name in one way."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from sleec_runtime.model import Ruleset, literals
from sleec_verify.checks import run_checks
from sleec_verify.checks.misread_names import MISREAD_NAME
from sleec_verify.encoding.scope import WHOLE, Scope
from sleec_verify.repairs.numbering import FindingRepairs, NumberedRepair
from sleec_verify.repairs.operators import REMOVALS
from sleec_verify.repairs.repair import Repair
from sleec_verify.repairs.search import RepairSearch
from sleec_verify.results.finding import CheckResult, Finding
from sleec_verify.results.suppressions import suppressions

_CODES = frozenset((*REMOVALS, "SLEEC507", "SLEEC508", "SLEEC513"))
"""The findings that are repaired without a question, if the repair keeps the meaning and the text still asks for the
same."""

OFFERED = frozenset(REMOVALS)
"""The findings whose repairs a person decides on, if the text would no longer ask for something."""

_REMOVALS = ("rule-removal", "defeater-removal")

_ONE_NAME = "SLEEC525"
"""A variant by an article, case or number is a slip, because an author who means two names declares both. In the DSL,
both have a definition, so there the author decides."""


def simplifications(ruleset: Ruleset, results: Sequence[CheckResult], scope: Scope = WHOLE) -> Iterator[Repair]:
    """Repairs that change no meaning, or write one name in one way.

    Each is one of the rules after the repair before it, until there are no more. One at a time, because a repair may
    make another one wrong: of two equal rules, each is redundant as long as the other is there. The last of them goes
    first. A finding that a comment allows stays. `results` are those of `ruleset` in `scope`. Each
    repair costs some checks.
    """
    while True:
        search = RepairSearch(ruleset, results, scope)
        findings = _open(ruleset, [f for result in results for f in result.findings if f.code in (*_CODES, _ONE_NAME)])
        has_misread_names = any(result.findings for result in results if result.name == MISREAD_NAME.name)
        needed = _declared(ruleset) if has_misread_names else frozenset[str]()
        ordered = sorted(findings, key=lambda finding: finding.span, reverse=True)
        found = (one for finding in ordered for one in search.repairs(finding) if _needs_no_decision(one, needed))
        # A rule that becomes redundant may have a comment that allows this.
        allowing = len(suppressions(ruleset)[0])
        kept = (one for one in found if len(suppressions(one.repaired)[0]) >= allowing)
        repair = next(kept, None)
        if repair is None:
            return
        yield repair
        ruleset = repair.repaired
        results = run_checks(ruleset, None, scope.domain, untimed=scope.untimed, chains=scope.chains)


def offered(
    ruleset: Ruleset, results: Sequence[CheckResult], searched: Iterable[FindingRepairs]
) -> Iterator[tuple[Finding, NumberedRepair]]:
    """The removals of what has no effect that a person decides on, because the text would no longer ask for something.

    `searched` are findings with codes that are `OFFERED`, and their repairs. A finding that a comment allows is none.
    """
    findings = _open(ruleset, [finding for result in results for finding in result.findings])
    places = {(finding.code, finding.span) for finding in findings}
    for found in searched:
        removals = (one for one in found.repairs if one.repair.candidate.operator in _REMOVALS)
        removal = next(removals, None)
        is_open = (found.finding.code, found.finding.span) in places
        if removal is not None and is_open and not _asks_for_the_same(removal.repair):
            yield found.finding, removal


def _open(ruleset: Ruleset, findings: Sequence[Finding]) -> list[Finding]:
    """The findings without those that a comment allows, at their place or in any line of their rule. A rule that may
    stay without effect is not removed for the sake of another finding."""
    allowing = suppressions(ruleset)[0]
    allowed = [f for f in findings if any(one.covers(ruleset, _of_whole_rule(ruleset, f)) for one in allowing)]
    kept = {rule for finding in allowed if finding.code in REMOVALS for rule in finding.rules}
    return [
        finding
        for finding in findings
        if finding not in allowed and not (finding.code in REMOVALS and kept.intersection(finding.rules))
    ]


def _of_whole_rule(ruleset: Ruleset, finding: Finding) -> Finding:
    rules = tuple((ruleset.by_label[label].span, "its rule") for label in finding.rules[:1])
    return replace(finding, related=(*finding.related, *rules))


def _declared(ruleset: Ruleset) -> frozenset[str]:
    """The declared names. One that no rule uses may be the one that the author meant by a misread name."""
    measures = (name for name, measure in ruleset.measures.items() if measure.declared)
    return frozenset[str]().union(*ruleset.declared.values(), measures, ruleset.constants)


def _needs_no_decision(repair: Repair, needed: frozenset[str]) -> bool:
    if repair.finding.code == _ONE_NAME:
        return repair.repaired.syntax != "dsl"
    return (
        repair.effect.keeps_meaning
        and needed <= _declared(repair.repaired)
        and (repair.finding.code not in OFFERED or _asks_for_the_same(repair))
    )


def _asks_for_the_same(repair: Repair) -> bool:
    """Whether no rule is removed, and each rule still names every literal that it obliged, in some clause.

    What has no effect may be a mistake: an exception that never applies, or a rule that another one makes redundant.
    """
    after = [{o for clause in rule.clauses() for o in literals(clause)} for rule in repair.repaired.rules]
    before = [{o for clause in rule.clauses() for o in literals(clause)} for rule in repair.effect.difference.old.rules]
    return len(before) == len(after) and all(one <= other for one, other in zip(before, after))
