"""Repairs of a purpose that the rules block: a rule gives way where the purpose applies.

This is the operator *relaxation of the rule that blocks a purpose* of SLEEC-PATCH (2026).
"""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import Claim, Obligation, Rule, Ruleset, claims
from sleec_verify.repairs.clause_names import clause_name
from sleec_verify.repairs.operators.claim_cases import giving_way, where
from sleec_verify.repairs.operators.removal import without_claim
from sleec_verify.repairs.repair import Candidate
from sleec_verify.repairs.statement_edits import exception_text, formula_text
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence


def relaxations(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """A condition or an exception with the situation of the purpose in a rule that blocks it. A purpose that no rule
    blocks contradicts itself; it is removed."""
    for purpose in claims(ruleset, "purpose"):
        if purpose.label in finding.obligations:
            for label in finding.rules:
                yield from _of(ruleset, ruleset.by_label[label], purpose)
            if not finding.rules:
                yield without_claim(ruleset, purpose)


def _of(ruleset: Ruleset, rule: Rule, purpose: Claim) -> Iterator[Candidate]:
    wanted = [one for response in purpose.responses for one in response.obligations]
    for number, clause in enumerate(rule.clauses()):
        condition = where(ruleset, rule, number, purpose)
        if condition is None:
            continue
        blocked = [one for one in wanted if any(_contradicts(one, other) for other in clause.obligations)]
        for response in blocked:
            text = quoted(exception_text(ruleset, condition, [response]))
            title = sentence("add to {clause}: {text}", clause=clause_name(ruleset, rule, number), text=text)
            edits = giving_way(ruleset, rule, number, purpose, response)
            yield Candidate("defeater-introduction", title, edits, rule.label)
        if clause.obligations:
            where_it_applies = quoted(formula_text(ruleset, condition))
            title = sentence(
                "let {clause} give way where {condition}",
                clause=clause_name(ruleset, rule, number),
                condition=where_it_applies,
            )
            yield Candidate("trigger-strengthening", title, giving_way(ruleset, rule, number, purpose), rule.label)


def _contradicts(one: Obligation, other: Obligation) -> bool:
    return one.name == other.name and one.negated != other.negated
