"""Verdicts, from the rules on by what is proved: that no context conflicts, that no rule depends on the reading, and
that what was found is so.

For each the oracle makes the theory's clauses and judges the steps that refute them (`ask` in
`proofs/oracle/Findings.v`). What is found here (by a solver, and by `sleec_verify.encoding.elaboration`) is not
trusted.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from types import TracebackType

from sleec_runtime.model import Ruleset
from sleec_verify.certificates.theory.boolean import Boolean
from sleec_verify.certificates.theory.numbering import Numbering
from sleec_verify.certificates.theory.oracle import NoAnswer, NotRefuted, Oracle
from sleec_verify.encoding.calculations import calculations, named
from sleec_verify.encoding.elaboration import InvalidLemma
from sleec_verify.encoding.refutation import refute
from sleec_verify.encoding.trace_scope import has_chains, speaks_of_traces

ProofStep = tuple[int, tuple[int, ...], tuple[int, ...]]
"""The number of a clause, its literals, and the clauses that it follows from."""


def not_modelled(ruleset: Ruleset, chains: bool = True) -> str | None:
    """Why the theory does not cover a ruleset, or None. `chains` is whether responses trigger rules."""
    if speaks_of_traces(ruleset) or (chains and has_chains(ruleset)):
        return "the theory covers neither time nor consequences of responses"
    if calculated := calculations(ruleset):
        return f"the theory does not cover calculations such as {named(calculated)}"
    whole = {name for name, measure in ruleset.measures.items() if measure.kind == "integer"}
    compared = sorted(whole & Boolean(ruleset).compared) if whole else []
    return f"whole numbers are compared with each other ({', '.join(compared)})" if compared else None


class Theory:
    """The proved facts about a ruleset in one domain. One oracle answers all questions. After a question without an
    answer, a new oracle starts."""

    def __init__(self, program: Path, ruleset: Ruleset, seconds: float | None = None) -> None:
        """`seconds` is how long the oracle may take for a formula, and for judging its refutation."""
        self.numbered = Numbering(Boolean(ruleset).ruleset)
        self._program = program
        self._seconds = seconds
        self._oracle: Oracle | None = None

    def prove(self, question: str) -> None:
        """Have it proved that the answer to a question is no: `conflict`, that no context conflicts; `reading`, that no
        rule obliges something else under the other reading in a context that can be; what
        `sleec_verify.certificates.theory.findings.questions` makes, that no finding is false.

        Raises NotRefuted where it is not, NoAnswer where the oracle gives none.
        """
        steps = self.steps_for(question)
        said = " ".join(f"a {number} {_joined(clause)}0 {_joined(hints)}0" for number, clause, hints in steps)
        if self._ask(f"refuted {said}") != "yes":
            raise NotRefuted("what was found to refute the clauses of the theory does not")

    def steps_for(self, question: str) -> list[ProofStep]:
        """A refutation of the theory's clauses. Raises NotRefuted where they have a model, NoAnswer as `prove` does."""
        return _refutation(_clauses(self._ask(f"formula {question}")))

    def _ask(self, question: str) -> str:
        try:
            if self._oracle is None:
                self._oracle = Oracle(self._program, self._seconds)
                self._oracle.ask(self.numbered.line)
            return self._oracle.ask(question)
        except NoAnswer:
            self.close()
            raise

    def close(self) -> None:
        """End the oracle, if there is one at work."""
        if self._oracle is not None:
            self._oracle.close()
            self._oracle = None

    def __enter__(self) -> Theory:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.close()


def _clauses(text: str) -> list[tuple[int, ...]]:
    numbers = list(map(int, text.split()))
    clauses = []
    start = 0
    while start < len(numbers):
        end = numbers.index(0, start)
        clauses.append(tuple(numbers[start:end]))
        start = end + 1
    return clauses


def _refutation(clauses: list[tuple[int, ...]]) -> list[ProofStep]:
    if not clauses:
        raise NotRefuted("there is not in the rules what is asked about")
    if not clauses[0]:
        # There is nothing to ask.
        return [(len(clauses) + 1, (), (1,))]
    # The first clause says that one of some questions is answered yes. Most are refuted one by one at once.
    questions = [(literal,) for literal in dict.fromkeys(clauses[0])]
    try:
        found, refuted = refute(clauses, questions)
    except InvalidLemma:
        raise NotRefuted("the clauses that the theory makes of the rules are not refuted") from None
    # Clauses are numbered from 1 there, from 0 here. A clause that says a literal twice, as `c AND c` gives, is no unit
    # to the checker; without the second it follows from it at once.
    numbers = list(range(1, len(clauses) + 1))
    steps: list[ProofStep] = []

    def add(literals: tuple[int, ...], hints: Iterable[int]) -> int:
        steps.append((len(clauses) + len(steps) + 1, literals, tuple(hints)))
        return steps[-1][0]

    for place, literals in enumerate(clauses):
        if len(set(literals)) < len(literals):
            numbers[place] = add(tuple(dict.fromkeys(literals)), [place + 1])
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


def _joined(numbers: Iterable[int]) -> str:
    return "".join(f"{number} " for number in numbers)
