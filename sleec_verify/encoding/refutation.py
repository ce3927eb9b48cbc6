"""Refutations of questions, each step of which follows by unit propagation (RUP).

Goldberg and Novikov, "Verification of Proofs of Unsatisfiability for CNF Formulas" (2003).
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Sequence
from threading import current_thread, main_thread

from sleec_verify.encoding.elaboration import Elaboration, Elaborator, LearntClause


def refute(clauses: Sequence[Sequence[int]], questions: Sequence[Sequence[int]]) -> Elaboration:
    """The refutation of all questions. Most need only unit propagation. For the others, a solver learns lemmas, which
    are then elaborated.

    Raises InvalidLemma if a question has a model, or if a lemma does not follow.
    """
    elaborator = Elaborator(clauses, questions)
    unanswered = elaborator.open_questions()
    if unanswered:
        elaborator.learn(learnt_clauses(clauses, [questions[place] for place in unanswered]))
    return elaborator.elaborate()


def learnt_clauses(clauses: Iterable[Sequence[int]], questions: Iterable[Sequence[int]]) -> list[LearntClause]:
    """The lemmas that Glucose learns while it refutes these questions, in its order. This uses the C interface of
    python-sat, as `sleec_verify.encoding.solver` does."""
    import pysolvers

    interruptible = int(current_thread() is main_thread())
    with tempfile.TemporaryFile() as file:
        solver = pysolvers.glucose41_new()
        try:
            stream = pysolvers.glucose41_tracepr(solver, file)
            for clause in clauses:
                pysolvers.glucose41_add_cl(solver, list(clause))
            for literals in questions:
                try:
                    # What it learns under assumptions follows from the clauses alone. Each is assumed once: Glucose
                    # writes past its arrays where there are more assumptions than variables.
                    pysolvers.glucose41_solve(solver, list(dict.fromkeys(literals)), interruptible)
                except pysolvers.error:
                    raise KeyboardInterrupt from None
            pysolvers.flushpr(stream)
        finally:
            pysolvers.glucose41_del(solver)
        file.seek(0)
        # Where it comes to an end it writes the empty clause, which does not follow if literals were assumed; where it
        # does, propagation finds it.
        lemmas = (LearntClause(tuple(map(int, row.lstrip(b"d").split()))[:-1], row.startswith(b"d")) for row in file)
        return [lemma for lemma in lemmas if lemma.literals]
