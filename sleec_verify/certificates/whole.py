"""Conflict-freeness as one formula for a domain, in the place of a question for each cause.

The check looks for causes, so it asks of one set of clauses after the other. That nothing can conflict is told by fewer
questions, one for each smallest set of obligations that cannot all be due (`sleec_verify.clashes`): in some situation,
does each of them follow from some clause that decides there? They share the clauses of all the rules that oblige any of
them.
"""

from __future__ import annotations

from sleec_verify.checks.base import literals_of
from sleec_verify.checks.conflict import all_clashes
from sleec_verify.cone import Cones
from sleec_verify.question import Question


def conflict_free(cones: Cones) -> bool:
    """Whether no situation conflicts. Linear in the rules that oblige part of a clash, but for the solver."""
    found = all_clashes(cones)
    at_odds = {literal for clash in found for literal in clash.literals}
    rules = [position for position, clauses in enumerate(cones.clauses) if not at_odds.isdisjoint(literals_of(clauses))]
    with Question(cones) as question:
        due = question.due(rules, at_odds)
        questions = []
        for clash in found:
            literals = [due[literal] for literal in sorted(clash.literals, key=str)]
            if clash.labels:
                literals.append(question.encoder.literal(clash.situation))
            questions.append(literals)
        # All are asked, so that all are recorded.
        answers = [question.ask(*literals) for literals in questions]
        return not any(answers)
