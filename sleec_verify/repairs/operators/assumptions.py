"""Repairs of a conflict by an assumption: its situation cannot occur (SLEEC-PATCH, 2026)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeGuard

from sleec_runtime.model import Atom, Formula, Not, Ruleset, leaves
from sleec_verify.encoding.equation import conjunction, guard
from sleec_verify.repairs.operators.conditions import conjuncts
from sleec_verify.repairs.repair import Candidate
from sleec_verify.repairs.statement_edits import formula_text
from sleec_verify.repairs.statement_insertion import with_relation, with_rule_after
from sleec_verify.results.finding import Finding
from sleec_verify.wording.phrases import quoted
from sleec_verify.wording.sentence import sentence


def assumptions(ruleset: Ruleset, finding: Finding) -> Iterator[Candidate]:
    """No situation has the conditions of all clauses of the conflict. Structured English writes an ASSUME, and the DSL
    a relation of conditions, or of two events.

    Events that rules require do not count, because the robot causes them. No event or condition alone is excluded.
    """
    clauses = [(ruleset.by_label[label], number) for label, number in finding.clauses]
    parts = dict.fromkeys(
        part
        for rule, number in clauses
        for part in conjuncts(guard(rule, ruleset.reading, number))
        if not (_is_event(part) and part.name in ruleset.obligations)
    )
    if ruleset.syntax == "english" and len(parts) > 1:
        line = f"ASSUME {formula_text(ruleset, Not(conjunction(list(parts))))}"
        yield Candidate(
            "assumption", sentence("add {line}", line=quoted(line)), with_rule_after(ruleset, ruleset.rules[-1], [line])
        )
    elif ruleset.syntax == "dsl":
        events = [part.name for part in parts if _is_event(part)]
        conditions = [part for part in parts if not any(_is_event(leaf) for leaf in leaves(part))]
        if len(conditions) > 1 and len(conditions) + len(events) == len(parts):
            line = f"measure invariant {formula_text(ruleset, Not(conjunction(conditions)))}"
        elif len(events) == len(parts) == 2:
            line = f"mutualExclusive {events[0]} {events[1]}"
        else:
            return
        yield Candidate(
            "assumption", sentence("add the relation {line}", line=quoted(line)), with_relation(ruleset, line)
        )


def _is_event(formula: Formula) -> TypeGuard[Atom]:
    return isinstance(formula, Atom) and formula.kind == "trigger"
