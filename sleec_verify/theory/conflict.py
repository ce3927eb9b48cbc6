"""That no context conflicts, from the rules to the verdict by what is proved: the theory's clauses, refuted.

The clauses are those of `conflict_clauses` in `proofs/theory/ConflictClauses.v`, made by the oracle; `certified` judges
the steps that refute them. What is found here (by a solver, and by `sleec_verify.certificates.elaboration`) is not
trusted.
"""

from __future__ import annotations

from pathlib import Path

from sleec_runtime.model import Ruleset
from sleec_verify.certificates.elaboration import NotFollowing
from sleec_verify.certificates.refutation import refute
from sleec_verify.theory.boolean import Boolean
from sleec_verify.theory.numbered import Numbered
from sleec_verify.theory.oracle import NotRefuted, answers
from sleec_verify.timed.scope import speaks_of_traces

Step = tuple[int, tuple[int, ...], tuple[int, ...]]
"""The number of a clause, its literals, and the clauses that it follows from."""


def not_modelled(ruleset: Ruleset) -> str | None:
    """Why the theory does not speak of a ruleset, or None."""
    if speaks_of_traces(ruleset):
        return "the theory has no times, and nothing that is done happens in it"
    compared = {name for name in Boolean(ruleset).compared if ruleset.measures[name].kind == "integer"}
    if compared:
        return f"whole numbers are compared with one another ({', '.join(sorted(compared))})"
    return None


def steps_for(program: Path, numbered: Numbered, seconds: float | None = None) -> list[Step]:
    """A refutation of the theory's clauses. Raises NotRefuted where they have a model, NoAnswer as `answers` does."""
    words = answers(program, [numbered.line, "clauses"], seconds)[1].split()
    clauses: list[tuple[int, ...]] = []
    clause: list[int] = []
    for word in words:
        if word == "0":
            clauses.append(tuple(clause))
            clause = []
        else:
            clause.append(int(word))
    try:
        found, (answer,) = refute(clauses, [()])
    except NotFollowing:
        raise NotRefuted("the clauses that the theory makes of the rules are not refuted") from None
    # Clauses are numbered from 1 there, from 0 here.
    first = len(clauses) + 1
    steps = [(first + place, step.literals, tuple(hint + 1 for hint in step.hints)) for place, step in enumerate(found)]
    return [*steps, (first + len(found), (), tuple(hint + 1 for hint in answer.hints))]


def never_conflicts(program: Path, ruleset: Ruleset, seconds: float | None = None) -> None:
    """Have it proved of a ruleset, as it is in one domain, that no context conflicts.

    Raises NotRefuted where it is not, NoAnswer where the oracle gives none, in `seconds` for each of two questions.
    """
    numbered = Numbered(Boolean(ruleset).ruleset)
    words = (
        f"a {number} {' '.join(map(str, (*literals, 0, *hints, 0)))}"
        for number, literals, hints in steps_for(program, numbered, seconds)
    )
    if answers(program, [numbered.line, f"refuted {' '.join(words)}"], seconds)[1] != "yes":
        raise NotRefuted("what was found to refute the clauses of the theory does not")
