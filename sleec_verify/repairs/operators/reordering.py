"""Defeater reordering: an exception changes places with one next to it."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from sleec_runtime.model import Ruleset
from sleec_verify.repairs.clause_names import rule_name
from sleec_verify.repairs.repair import Candidate
from sleec_verify.repairs.statement_edits import reordered
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import exception
from sleec_verify.wording.sentence import sentence


def orders(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """The exceptions of the finding, each in the place of the one before it or after it."""
    for label, number in finding.clauses:
        rule = ruleset.by_label[label]
        clause = list(rule.clauses())[number]
        for first, second in pairwise(rule.hedges):
            if clause is first or clause is second:
                title = sentence(
                    "swap {first} and {second} of {rule}",
                    first=exception(first),
                    second=exception(second),
                    rule=rule_name(ruleset, rule),
                )
                yield Candidate("defeater-reordering", title, reordered(ruleset, first, second), label)
