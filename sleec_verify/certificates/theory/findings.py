"""What checks found, as the oracle is asked about it (`finding` in `proofs/oracle/Findings.v`).

A finding names what is to suffice for it: other rules, constraints. These are hints. With wrong ones the oracle's
formula has a model, and nothing is proved.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from sleec_runtime.model import Rule
from sleec_verify.certificates.theory.numbering import Numbering
from sleec_verify.checks.dead import DEAD_RULE
from sleec_verify.query.cone import rules_of_same_obligation
from sleec_verify.query.prime_implicates import constraints_on_situations
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.results.finding import Finding

AT_ONCE = 200
"""Findings of one formula. The oracle's stack holds some hundred thousand clauses."""


def questions(
    check: str, findings: Sequence[Finding], domain: str, index: RulesetIndex, numbered: Numbering
) -> Iterator[str]:
    """What the oracle is asked about the findings of a check in one domain, whose rules `index` and `numbered` are
    about: whether one of them is false. Nothing, if it has none there."""
    asked = [FOUND[check](one, domain, index, numbered) for one in findings if not domain or domain in one.domains]
    if check == "vacuous-conflict":
        # It passes over the rules that nothing triggers.
        asked += [_dead_rule(one, domain, index, numbered) for one in DEAD_RULE.run(index)]
    for start in range(0, len(asked), AT_ONCE):
        part = asked[start : start + AT_ONCE]
        yield f"findings {len(part)} {' '.join(part)}"


def _rule(finding: Finding, index: RulesetIndex) -> Rule:
    return index.ruleset.by_label[finding.rules[0]]


def _dead_rule(finding: Finding, domain: str, index: RulesetIndex, numbered: Numbering) -> str:
    return f"dead-rule {numbered.rule(finding.rules[0])}"


def _dead_hedge(finding: Finding, domain: str, index: RulesetIndex, numbered: Numbering) -> str:
    return f"dead-hedge {_hedge(finding, index, numbered)}"


def _redundant_rule(finding: Finding, domain: str, index: RulesetIndex, numbered: Numbering) -> str:
    # The finding names those that suffice in the first of its domains.
    named = domain in finding.domains[:1] or not domain
    cover = finding.rules[1:] if named else _rivals(finding, index)
    return f"redundant-rule {numbered.rule(finding.rules[0])} {_listed(map(numbered.rule, cover))}"


def _redundant_hedge(finding: Finding, domain: str, index: RulesetIndex, numbered: Numbering) -> str:
    cover = map(numbered.rule, _rivals(finding, index))
    return f"redundant-hedge {_hedge(finding, index, numbered)} {_listed(cover)}"


def _vacuous_conflict(finding: Finding, domain: str, index: RulesetIndex, numbered: Numbering) -> str:
    rules = (index.ruleset.by_label[label] for label in finding.rules)
    due = {obligation.name for rule in rules for clause in rule.clauses() for obligation in clause.obligations}
    about = {id(constraint) for constraint in (*index.constraints_about(due), *constraints_on_situations(index))}
    kept = (place for place, constraint in enumerate(index.ruleset.constraints) if id(constraint) in about)
    number, *meeting = map(numbered.rule, finding.rules)
    return f"vacuous-conflict {number} {_listed(meeting)} {_listed(kept)}"


def _assumptions(finding: Finding, domain: str, index: RulesetIndex, numbered: Numbering) -> str:
    return "assumptions"


def _hedge(finding: Finding, index: RulesetIndex, numbered: Numbering) -> str:
    rule = _rule(finding, index)
    # Where a default with a chain of its own is written as a first hedge, it has a number.
    number = finding.clauses[0].clause + bool(rule.default.hedges and rule.hedges)
    return f"{numbered.rule(rule.label)} {number}"


def _rivals(finding: Finding, index: RulesetIndex) -> Iterator[str]:
    position = index.rules.index(_rule(finding, index))
    return (index.rules[other].label for other in rules_of_same_obligation(index, position))


def _listed(numbers: Iterable[int]) -> str:
    known = list(numbers)
    return " ".join(map(str, (len(known), *known)))


FOUND: Mapping[str, Callable[[Finding, str, RulesetIndex, Numbering], str]] = {
    "vacuous-conflict": _vacuous_conflict,
    "assumptions": _assumptions,
    "dead-rule": _dead_rule,
    "dead-hedge": _dead_hedge,
    "redundant-rule": _redundant_rule,
    "redundant-hedge": _redundant_hedge,
}
"""For each check that the theory covers, a finding in the format of the oracle."""
