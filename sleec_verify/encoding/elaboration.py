"""Elaborates a solver's lemmas (DRUP) into a refutation with hints (LRAT).

A solver's proof only lists the lemmas that it learnt. Each lemma follows from the clauses before it by unit
propagation. The elaborator goes back from the last lemma and finds these clauses again. It drops lemmas that no answer
needs. Its result is not trusted: a checker follows the hints of the refutation.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

_ASSUMED = -1
"""The reason of an assumed literal, instead of a clause."""


class InvalidLemma(Exception):
    """A lemma that does not follow by unit propagation, or a question that the lemmas do not refute."""


class ProofStep(NamedTuple):
    """A derived clause. `hints` are the numbers of clauses in the order in which they become units. The last one is
    false. Clauses are numbered from 0, first those of the formula and then those of the steps."""

    literals: tuple[int, ...]
    hints: tuple[int, ...]


class LearntClause(NamedTuple):
    """A lemma. If `forgotten`, the solver deletes an earlier lemma."""

    literals: tuple[int, ...]
    forgotten: bool = False


class Answer(NamedTuple):
    """The evidence that `literals` cannot all be true: `hints` lead from them to a conflict."""

    literals: tuple[int, ...]
    hints: tuple[int, ...]


class Elaboration(NamedTuple):
    """The steps, and an answer for each question."""

    steps: list[ProofStep]
    answers: list[Answer]


class _Found(NamedTuple):
    """A conflict: the clauses that lead to it, the literals that are always true, and the assumed ones."""

    hints: list[int]
    units: set[int]
    assumed: list[int]


class Elaborator:
    """The clauses of one formula, and lemmas that a solver learnt from them.

    `open_questions` returns the questions that unit propagation alone does not refute. Pass lemmas for them to `learn`.
    Then `elaborate` returns the refutation. Time and memory are those of one unit propagation for each needed lemma.
    """

    def __init__(self, clauses: Sequence[Sequence[int]], questions: Sequence[Sequence[int]]) -> None:
        self._clauses = [list(dict.fromkeys(clause)) for clause in clauses]
        self._questions = questions
        self._formula = len(clauses)
        top = max((abs(literal) for clause in (*clauses, *questions) for literal in clause), default=0)
        # Both are indexed by literals: a negative one counts from the end.
        self._value = [0] * (2 * top + 1)
        self._watches: list[list[int]] = [[] for _ in range(2 * top + 1)]
        self._reason = [_ASSUMED] * (top + 1)
        self._trail: list[int] = []
        self._settled: dict[int, None] = {}
        """The variables with a fixed value, in the order of assignment."""
        self._learnt: list[tuple[int, int | None]] = []
        """The number of each lemma with the length of the trail before it. None if the lemma is deleted."""
        self._numbers: dict[tuple[int, ...], list[int]] = {}
        self._broken: int | None = None
        """A clause that is always false, if there is one."""
        self._forgotten = len(clauses)
        self._answers: dict[int, _Found] = {}
        for number in range(self._formula):
            self._attach(number)
        self._settle()

    # Propagation ----------------------------------------------------------------------------------------------

    def _attach(self, number: int) -> None:
        """Watch two literals of a clause that are not false. If there are not two, record the unit or the conflict."""
        clause, value = self._clauses[number], self._value
        front = 0
        for place, literal in enumerate(clause):
            if value[literal] != -1:
                clause[front], clause[place] = literal, clause[front]
                front += 1
                if front == 2:
                    break
        if front == 0:
            if self._broken is None:
                self._broken = number
        elif front == 1 and not value[clause[0]]:
            self._make_true(clause[0], number)
        for literal in clause[:2] if len(clause) > 1 else ():
            self._watches[literal].append(number)

    def _make_true(self, literal: int, reason: int) -> None:
        self._value[literal], self._value[-literal] = 1, -1
        self._reason[abs(literal)] = reason
        self._trail.append(literal)

    def _propagate(self, head: int) -> int | None:
        """Propagate the trail from `head` on. Returns a clause that is false then, or None."""
        clauses, value, watches, trail, reason = self._clauses, self._value, self._watches, self._trail, self._reason
        forgotten = self._forgotten
        while head < len(trail):
            falsified = -trail[head]
            head += 1
            watching = watches[falsified]
            kept = 0
            for place, number in enumerate(watching):
                if number >= forgotten:
                    continue
                clause = clauses[number]
                if clause[0] == falsified:
                    clause[0], clause[1] = clause[1], falsified
                first = clause[0]
                if value[first] != 1:
                    for other in range(2, len(clause)):
                        literal = clause[other]
                        if value[literal] != -1:
                            clause[1], clause[other] = literal, falsified
                            watches[literal].append(number)
                            break
                    else:
                        watching[kept] = number
                        kept += 1
                        if value[first] == -1:
                            watching[kept:] = watching[place + 1 :]
                            return number
                        value[first], value[-first] = 1, -1
                        reason[abs(first)] = number
                        trail.append(first)
                    continue
                watching[kept] = number
                kept += 1
            del watching[kept:]
        return None

    def _undo(self, length: int) -> None:
        for literal in self._trail[length:]:
            self._value[literal] = self._value[-literal] = 0
        del self._trail[length:]

    def _settle(self) -> None:
        """Propagate the literals that are always true."""
        if self._broken is None:
            self._broken = self._propagate(len(self._settled))
        for literal in self._trail[len(self._settled) :]:
            self._settled[abs(literal)] = None

    def _refute(self, literals: Iterable[int]) -> _Found | None:
        """The conflict that follows from these literals, or None if propagation finds none."""
        if self._broken is not None:
            return self._explained(self._broken)
        length = len(self._trail)
        try:
            for literal in literals:
                if self._value[literal] == -1:
                    if abs(literal) in self._settled:
                        return _Found([], {abs(literal)}, [literal])
                    return _Found([], set(), [literal, -literal])
                if not self._value[literal]:
                    self._make_true(literal, _ASSUMED)
            conflict = self._propagate(length)
            return None if conflict is None else self._explained(conflict)
        finally:
            self._undo(length)

    def _explained(self, conflict: int) -> _Found:
        """The causes of a conflict, from the last literal back."""
        clauses, reason = self._clauses, self._reason
        seen = set(map(abs, clauses[conflict]))
        hints, assumed = [conflict], []
        for literal in reversed(self._trail[len(self._settled) :]):
            if abs(literal) in seen:
                because = reason[abs(literal)]
                if because == _ASSUMED:
                    assumed.append(literal)
                else:
                    hints.append(because)
                    seen.update(map(abs, clauses[because]))
        return _Found(hints[::-1], {variable for variable in seen if variable in self._settled}, assumed)

    # Questions and lemmas -------------------------------------------------------------------------------------

    def open_questions(self) -> list[int]:
        """The positions of the questions that propagation does not refute."""
        for place, literals in enumerate(self._questions):
            if place not in self._answers:
                found = self._refute(literals)
                if found is not None:
                    self._answers[place] = found
        return [place for place in range(len(self._questions)) if place not in self._answers]

    def learn(self, lemmas: Iterable[LearntClause]) -> None:
        """Add lemmas. Each must follow by propagation from the formula and the lemmas before it."""
        for lemma in lemmas:
            if self._broken is not None:
                return
            literals = sorted(set(lemma.literals))
            if lemma.forgotten:
                self._let_go(self._numbers.get(tuple(literals), []))
            elif not any(-literal in literals for literal in literals):
                number = len(self._clauses)
                self._learnt.append((number, len(self._trail)))
                self._numbers.setdefault(tuple(literals), []).append(number)
                self._clauses.append(literals)
                self._forgotten = number + 1
                self._attach(number)
                self._settle()

    def _let_go(self, numbers: list[int]) -> None:
        """Stop propagating with one of these lemmas, unless it is the reason of a literal on the trail. Clauses of the
        formula are never deleted."""
        clause = self._clauses[numbers[-1]] if numbers else []
        if len(clause) > 1 and self._reason[abs(clause[0])] != numbers[-1]:
            number = numbers.pop()
            for literal in clause[:2]:
                self._watches[literal].remove(number)
            self._learnt.append((number, None))

    def _take_back(self, number: int) -> None:
        """Propagate again with a lemma that is deleted later."""
        clause = self._clauses[number]
        # What became false last is what becomes open first.
        clause.sort(key=lambda literal: 1 if self._value[literal] == -1 else 0)
        if self._value[clause[1]] == -1:
            clause[1:] = sorted(clause[1:], key=lambda literal: -self._trail.index(-literal))
        for literal in clause[:2]:
            self._watches[literal].append(number)

    def elaborate(self) -> Elaboration:
        """The refutation of every question. The elaborator cannot be used afterwards.

        Raises InvalidLemma for a lemma that does not follow, and for a question that is not refuted.
        """
        if self.open_questions():
            raise InvalidLemma("the lemmas do not refute the question")
        needed: set[int] = set()
        used: set[int] = set()
        for found in self._answers.values():
            self._note(found, needed, used)
        made: list[tuple[int, ProofStep]] = []
        for number, length in reversed(self._learnt):
            if length is None:
                self._take_back(number)
                continue
            made += self._settled_since(length, needed, used)
            # If anything is false in any case, the last lemma made it so.
            self._broken = None
            self._forgotten = number
            if number in used:
                lemma = self._clauses[number]
                refuted = self._refute([-literal for literal in lemma])
                if refuted is None:
                    raise InvalidLemma("a lemma does not follow from what came before")
                self._note(refuted, needed, used)
                made.append((number, ProofStep(tuple(lemma), _hints_of_lemma(refuted, lemma))))
        made += self._settled_since(0, needed, used)
        return self._numbered(made[::-1])

    def _note(self, found: _Found, needed: set[int], used: set[int]) -> None:
        needed |= found.units
        used.update(hint for hint in found.hints if hint >= self._formula)

    def _settled_since(self, length: int, needed: set[int], used: set[int]) -> list[tuple[int, ProofStep]]:
        """The steps for the needed literals that are always true since the trail had this length, the last first. They
        are removed from the trail."""
        made = []
        for literal in reversed(self._trail[length:]):
            variable = abs(literal)
            if variable in needed:
                because = self._reason[variable]
                others = [abs(other) for other in self._clauses[because] if other != literal]
                needed.update(others)
                if because >= self._formula:
                    used.add(because)
                made.append((-variable, ProofStep((literal,), (*(-other for other in others), because))))
            del self._settled[variable]
        self._undo(length)
        return made

    def _numbered(self, made: Iterable[tuple[int, ProofStep]]) -> Elaboration:
        """Number the steps in their order, and write the numbers into the hints."""
        numbers: dict[int, int] = {}
        steps: list[ProofStep] = []

        def numbered(hints: Iterable[int]) -> tuple[int, ...]:
            return tuple(numbers.get(hint, hint) for hint in hints)

        for name, (literals, hints) in made:
            if len(hints) == 1:
                # A part of what it says is a clause already, which serves as well wherever this one would.
                numbers[name] = numbered(hints)[0]
            else:
                steps.append(ProofStep(literals, numbered(hints)))
                numbers[name] = self._formula + len(steps) - 1
        found = [self._answers[place] for place in range(len(self._questions))]
        answers = [Answer(tuple(one.assumed), numbered([*_named(one.units), *one.hints])) for one in found]
        return Elaboration(steps, answers)


def _named(units: Iterable[int]) -> list[int]:
    """The provisional hints for literals that are always true: negative, unlike the numbers of clauses."""
    return [-variable for variable in sorted(units)]


def _hints_of_lemma(found: _Found, lemma: Sequence[int]) -> tuple[int, ...]:
    # Its literals are assumed to be false; one that is false in any case needs no further reason. Where one is true in
    # any case, that alone is the conflict.
    assumed = set(map(abs, lemma)) if found.hints else set()
    return (*_named(found.units - assumed), *found.hints)
