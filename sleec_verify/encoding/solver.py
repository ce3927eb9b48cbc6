"""A SAT solver behind four calls, so that another can take its place. The one in use is python-sat's.

A solver says yes, no, or None where it gave up: unknown is an answer, never an exception swallowed.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from threading import current_thread, main_thread
from types import TracebackType
from typing import Protocol

import pysolvers

from sleec_verify.encoding.budget import Budget, Undecided, current, spend

__all__ = ["CONFLICT_BUDGET", "MiniSat", "Recorder", "Solver", "Undecided"]

CONFLICT_BUDGET = 500_000
"""Conflicts after which a question is given up. Questions about rules that people write need a few dozen."""

SLICE = 100_000
"""Propagated literals after which a solver at work first looks at the clock, if there is a timeout. It is twice as many
each time, as a solver loses its course at each look."""

PER_SECOND = 1_000_000
"""Propagated literals that no machine takes much longer for than a second."""

PER_CONFLICT, PER_LITERAL, PER_CLAUSE, PER_QUESTION = 8, 0.1, 1.5, 30
"""Steps of a budget for a conflict, for a propagated literal, for a clause that is built and added, and for a
question."""


class Solver(Protocol):
    """What the verifier needs of a solver. Literals are non-zero integers, a negative one is a negation."""

    def add(self, clauses: Collection[Sequence[int]]) -> None: ...

    def solve(self, assumptions: Sequence[int] = ()) -> bool | None:
        """Whether the clauses and assumptions have a model; None if that was not decided."""
        ...

    def holds(self, literal: int) -> bool:
        """Whether a literal is true in the model that the last `solve` found."""
        ...

    def core(self) -> list[int]:
        """Assumptions that suffice for the last `solve` to have failed."""
        ...

    def propagate(self, assumptions: Sequence[int]) -> tuple[bool, list[int]]:
        """Unit propagation alone: whether it met no contradiction, and the literals that the assumptions make true."""
        ...

    def __enter__(self) -> Solver: ...

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None
    ) -> None: ...


class Recorder(Protocol):
    """What is told of every question that a check asks, once it is answered. A list of clauses stands for itself: it
    is the same question's as long as it is the same list."""

    def refuted(self, clauses: Sequence[Sequence[int]], literals: Sequence[int]) -> None:
        """No model of the clauses makes all these literals true."""
        ...

    def satisfied(
        self, clauses: Sequence[Sequence[int]], literals: Sequence[int], holds: Callable[[int], bool]
    ) -> None:
        """`holds` tells what is true in a model of the clauses that makes all these literals true."""
        ...


class MiniSat:
    """MiniSat 2.2 by python-sat: the quickest to set up and to take down, and most questions are small.

    python-sat's module of C functions is called directly: its class for each of its twenty solvers takes longer to
    import than eight rules take to check, and as long to call as a small question takes to answer.
    """

    def __init__(self, clauses: Collection[Sequence[int]] = (), budget: int | None = None) -> None:
        self._solver = pysolvers.minisat22_new()
        self._most_conflicts = CONFLICT_BUDGET if budget is None else budget
        pysolvers.minisat22_cbudget(self._solver, self._most_conflicts)
        self._conflicts = self._literals = 0
        # Signals reach the main thread only, and only there may the solver set its handler.
        self._interruptible = int(current_thread() is main_thread())
        self._model: list[int] = []
        self.add(clauses)

    def add(self, clauses: Collection[Sequence[int]]) -> None:
        add, solver = pysolvers.minisat22_add_cl, self._solver
        for clause in clauses:
            add(solver, clause)
        spend(PER_CLAUSE * len(clauses))

    def solve(self, assumptions: Sequence[int] = ()) -> bool | None:
        budget = current()
        answer = self._solve(assumptions) if budget is None else self._solve_within(budget, assumptions)
        if answer:
            self._model = pysolvers.minisat22_model(self._solver) or []
        return answer

    def _solve(self, assumptions: Sequence[int]) -> bool | None:
        try:
            answer: bool | None = pysolvers.minisat22_solve_lim(self._solver, assumptions, self._interruptible, 0)
        except pysolvers.error:
            # The solver's own handler took the Ctrl-C.
            raise KeyboardInterrupt from None
        return answer

    def _solve_within(self, budget: Budget, assumptions: Sequence[int]) -> bool | None:
        """Solve, or raise OutOfBudget when the budget is spent."""
        solver, slice_ = self._solver, SLICE
        budget.spend(PER_QUESTION)
        while True:
            conflicts, literals = self._most_conflicts - self._conflicts, slice_
            if budget.is_timed:
                literals = min(slice_, int(budget.seconds() * PER_SECOND))
            else:
                conflicts = min(conflicts, int(budget.steps / PER_CONFLICT))
                literals = int(budget.steps / PER_LITERAL)
            # One at least, as 0 is no limit.
            pysolvers.minisat22_cbudget(solver, conflicts + 1)
            pysolvers.minisat22_pbudget(solver, literals + 1)
            answer = self._solve(assumptions)
            done = pysolvers.minisat22_acc_stats(solver)
            conflicts, literals = done["conflicts"], done["propagations"]
            cost = PER_CONFLICT * (conflicts - self._conflicts) + PER_LITERAL * (literals - self._literals)
            self._conflicts, self._literals = conflicts, literals
            budget.spend(cost)
            if answer is not None or conflicts >= self._most_conflicts:
                return answer
            slice_ *= 2

    def holds(self, literal: int) -> bool:
        variable = abs(literal)
        # A variable that stands in no clause has no value; false serves.
        true = variable <= len(self._model) and self._model[variable - 1] > 0
        return true == (literal > 0)

    def core(self) -> list[int]:
        return pysolvers.minisat22_core(self._solver) or []

    def propagate(self, assumptions: Sequence[int]) -> tuple[bool, list[int]]:
        consistent, literals = pysolvers.minisat22_propagate(self._solver, assumptions, 0, self._interruptible)
        return consistent, literals or []

    def __enter__(self) -> MiniSat:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.close()

    def __del__(self) -> None:
        self.close()

    def close(self) -> None:
        """Give back the memory. Nothing can be asked afterwards."""
        if self._solver is not None:
            pysolvers.minisat22_del(self._solver)
            self._solver = None
