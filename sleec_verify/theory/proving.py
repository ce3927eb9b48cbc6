"""Verdicts, from the rules on by what is proved: that no context conflicts, and that no rule depends on the reading.

For each the oracle makes the theory's clauses and judges the steps that refute them (`to_refute` and `certified`,
`reading_to_refute` and `certified_reading` in `proofs/oracle/Certified.v`). What is found here (by a solver, and by
`sleec_verify.certificates.elaboration`) is not trusted.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Literal

from sleec_runtime.model import Ruleset
from sleec_verify.calculations import calculations, named
from sleec_verify.certificates.elaboration import NotFollowing
from sleec_verify.certificates.refutation import refute
from sleec_verify.theory.boolean import Boolean
from sleec_verify.theory.numbered import Numbered
from sleec_verify.theory.oracle import NotRefuted, answers
from sleec_verify.timed.scope import speaks_of_traces

What = Literal["conflict", "reading"]
"""The check whose verdict is proved."""

WHATS: tuple[What, ...] = ("conflict", "reading")

_WORDS: dict[What, str] = {"conflict": "", "reading": "-of-reading"}

Step = tuple[int, tuple[int, ...], tuple[int, ...]]
"""The number of a clause, its literals, and the clauses that it follows from."""


def not_modelled(ruleset: Ruleset) -> str | None:
    """Why the theory does not speak of a ruleset, or None."""
    if speaks_of_traces(ruleset):
        return "the theory has no times, and nothing that is done happens in it"
    if calculated := calculations(ruleset):
        return f"the theory does not calculate, as in {named(calculated)}"
    compared = {name for name in Boolean(ruleset).compared if ruleset.measures[name].kind == "integer"}
    if compared:
        return f"whole numbers are compared with one another ({', '.join(sorted(compared))})"
    return None


def steps_for(program: Path, numbered: Numbered, what: What = "conflict", seconds: float | None = None) -> list[Step]:
    """A refutation of the theory's clauses. Raises NotRefuted where they have a model, NoAnswer as `answers` does."""
    words = answers(program, [numbered.line, f"clauses{_WORDS[what]}"], seconds)[1].split()
    clauses: list[tuple[int, ...]] = []
    clause: list[int] = []
    for word in words:
        if word == "0":
            clauses.append(tuple(clause))
            clause = []
        else:
            clause.append(int(word))
    # The first clause of each says that one of some questions is answered yes. Most are refuted one by one at once.
    questions = [(literal,) for literal in dict.fromkeys(clauses[0])]
    try:
        found, refuted = refute(clauses, questions)
    except NotFollowing:
        raise NotRefuted("the clauses that the theory makes of the rules are not refuted") from None
    # Clauses are numbered from 1 there, from 0 here. A clause that says a literal twice, as `c AND c` gives, is no unit
    # to the checker; without the second it follows from it at once.
    numbers = list(range(1, len(clauses) + 1))
    steps: list[Step] = []

    def add(literals: tuple[int, ...], hints: Iterable[int]) -> int:
        steps.append((len(clauses) + len(steps) + 1, literals, tuple(hints)))
        return steps[-1][0]

    for place, literals in enumerate(clauses):
        once = tuple(dict.fromkeys(literals))
        if once != literals:
            numbers[place] = add(once, [place + 1])
    for step in found:
        numbers.append(add(step.literals, (numbers[hint] for hint in step.hints)))
    no = []
    for (asked,), answer in zip(questions, refuted):
        hints = [numbers[hint] for hint in answer.hints]
        if not answer.literals:
            # The clauses are refuted whatever is asked, as by assumptions that nothing satisfies.
            add((), hints)
            return steps
        no.append(add((-asked,), hints))
    add((), (*no, numbers[0]))
    return steps


def prove(program: Path, ruleset: Ruleset, what: What = "conflict", seconds: float | None = None) -> None:
    """Have it proved of a ruleset, as it is in one domain, that no context conflicts, or that no rule obliges something
    else under the other reading in a context that can be.

    Raises NotRefuted where it is not, NoAnswer where the oracle gives none, in `seconds` for each of two questions.
    """
    numbered = Numbered(Boolean(ruleset).ruleset)
    words = (
        f"a {number} {' '.join(map(str, (*literals, 0, *hints, 0)))}"
        for number, literals, hints in steps_for(program, numbered, what, seconds)
    )
    if answers(program, [numbered.line, f"refuted{_WORDS[what]} {' '.join(words)}"], seconds)[1] != "yes":
        raise NotRefuted("what was found to refute the clauses of the theory does not")
