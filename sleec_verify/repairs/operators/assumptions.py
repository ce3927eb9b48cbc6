"""Repairs of a conflict by an assumption: its situation cannot occur (SLEEC-PATCH, 2026)."""

from __future__ import annotations

from collections.abc import Iterator

from sleec_runtime.model import Atom, Formula, Not, Ruleset
from sleec_verify.encoding.equation import conjunction, guard
from sleec_verify.repairs.operators.claim_cases import parts_of
from sleec_verify.repairs.repair import Candidate
from sleec_verify.repairs.statement_edits import formula_text
from sleec_verify.repairs.statement_insertion import with_rule_after
from sleec_verify.results.finding import Finding
from sleec_verify.results.phrases import quoted


def assumptions(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """Structured English: no situation has the conditions of all clauses of the conflict.

    Events that rules require do not count, and a single trigger is not excluded.
    """
    if ruleset.syntax == "dsl":
        return
    clauses = [(ruleset.by_label[label], number) for label, number in finding.clauses]
    parts: dict[Formula, None] = {}
    for rule, number in clauses:
        for part in parts_of(guard(rule, ruleset.reading, number)):
            if not (isinstance(part, Atom) and part.kind == "trigger" and part.name in ruleset.obligations):
                parts.setdefault(part)
    if len(parts) > 1:
        line = f"ASSUME {formula_text(ruleset, Not(conjunction(list(parts))))}"
        edits = with_rule_after(ruleset, ruleset.rules[-1], [line])
        yield Candidate("assumption", f"add {quoted(line)}", edits)
