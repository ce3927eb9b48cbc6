"""Combines many questions into one formula, "some question has a model", and refutes it.

A question is a set of clauses with some assumed literals. One formula for each question would need thousands of files.
A conjunction of all questions would be refuted by a single unsatisfiable one.

So each set of clauses has its own variables and holds only if its *switch* is on. Each question has a *selector*, which
turns on the switch and makes the assumed literals true. The last clause says that some selector is on. The formula has
a model if and only if some question has one.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from sleec_verify.certificates.recorder import RecordedQuestion
from sleec_verify.encoding.refutation import refute

MOST_LITERALS = 1_000_000
"""The number of literals after which a new pair of files begins, because checkers keep a formula in memory. They take
less than half of the 16 MiB limit of a file (`sleec_runtime.support.files`)."""


class Disjunction:
    """The formula "some question has a model", built question by question. It is linear in their size."""

    def __init__(self, asked: Sequence[RecordedQuestion]) -> None:
        self._asked = asked
        self.variables = 0
        self.clauses: list[tuple[int, ...]] = []
        self.questions = 0
        self._parts: list[tuple[int, int, int]] = []
        """For each set of clauses: the offset of its variables, its switch, and the position of its first clause."""
        selectors: list[int] = []
        for one in asked:
            offset = self.variables
            switch = offset + _top(one) + 1
            self._parts.append((offset, switch, len(self.clauses)))
            self.clauses += ((*_moved(dict.fromkeys(clause), offset), -switch) for clause in one.clauses)
            for number, literals in enumerate(one.questions, 1):
                selector = switch + number
                selectors.append(selector)
                self.clauses.append((-selector, switch))
                self.clauses += ((-selector, literal) for literal in _moved(literals, offset))
            self.variables = switch + len(one.questions)
        self.questions = len(selectors)
        self._words = [what for one in asked for what in one.questions.values()]
        self.clauses.append(tuple(selectors))

    def dimacs(self, title: str) -> str:
        """The formula in DIMACS, with a comment that describes it."""
        rows = [" ".join(map(str, (*clause, 0))) for clause in self.clauses]
        said = f"c {title}\nc satisfiable if and only if one of the {self.questions} questions has a model\n"
        for number, what in enumerate(self._words, 1):
            if what:
                said += f"c question {number}: {what.encode('ascii', 'backslashreplace').decode()}\n"
        return f"{said}p cnf {self.variables} {len(rows)}\n" + "\n".join(rows) + "\n"

    def lrat(self) -> str:
        """A refutation in LRAT.

        Raises InvalidLemma if a question has a model, or if a lemma of the solver does not follow.
        """
        rows: list[str] = []
        next_number = len(self.clauses) + 1

        def add(literals: Iterable[int], hints: Iterable[int]) -> int:
            nonlocal next_number
            rows.append(" ".join(map(str, (next_number, *literals, 0, *hints, 0))))
            next_number += 1
            return next_number - 1

        refuted = []
        for one, (offset, switch, first) in zip(self._asked, self._parts):
            steps, answers = refute(one.clauses, list(one.questions))
            size = len(one.clauses)
            # Clauses are numbered from 1 in LRAT, from 0 here.
            numbers = list(range(first + 1, first + size + 1))
            for step in steps:
                numbers.append(add((*_moved(step.literals, offset), -switch), (numbers[hint] for hint in step.hints)))
            place = first + size + 1
            for number, (literals, answer) in enumerate(zip(one.questions, answers), 1):
                chosen = [place, *(place + 1 + literals.index(literal) for literal in answer.literals)]
                refuted.append(add((-switch - number,), (*chosen, *(numbers[hint] for hint in answer.hints))))
                place += 1 + len(literals)
        add((), (*refuted, len(self.clauses)))
        return "\n".join(rows) + "\n"


def disjunctions(asked: Iterable[RecordedQuestion]) -> Iterator[Disjunction]:
    """The formulas for all questions: as few as their size allows, and one if there are no questions."""
    part: list[RecordedQuestion] = []
    size = 0
    for one in asked:
        literals = sum(map(len, one.clauses))
        if part and size + literals > MOST_LITERALS:
            yield Disjunction(part)
            part, size = [], 0
        part.append(one)
        size += literals
    yield Disjunction(part)


def _moved(literals: Iterable[int], offset: int) -> Iterator[int]:
    return (literal + offset if literal > 0 else literal - offset for literal in literals)


def _top(one: RecordedQuestion) -> int:
    return max((abs(literal) for row in (*one.clauses, *one.questions) for literal in row), default=0)
