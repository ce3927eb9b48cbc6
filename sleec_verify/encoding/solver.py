"""A SAT solver behind a small interface. The implementation is MiniSat of python-sat.

An answer is yes, no, or None if the solver gave up.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from threading import current_thread, main_thread
from types import TracebackType
from typing import NamedTuple, Protocol
from weakref import ReferenceType, ref

import pysolvers

from sleec_verify.encoding.budget import Budget, Undecided, current, spend
from sleec_verify.results.conflict_freedom import FreeComponent
from sleec_verify.results.found_trace import FoundTrace

__all__ = ["CONFLICT_BUDGET", "MiniSat", "Recorder", "Refutation", "Solver", "Undecided", "released"]

CONFLICT_BUDGET = 500_000
"""The maximal number of conflicts of a question. Questions about rules that people write need a few dozen."""

SLICE = 100_000
"""Propagated literals before the first check of the clock, if there is a timeout. The number doubles each time,
because each check disturbs the search."""

PER_SECOND = 1_000_000
"""Propagated literals that no machine needs much longer than a second for."""

PER_CONFLICT, PER_LITERAL, PER_CLAUSE, PER_QUESTION = 8, 0.1, 1.5, 30
"""Budget steps for a conflict, for a propagated literal, for a clause that is built and added, and for a question."""


class Solver(Protocol):
    """The interface of a solver. Literals are non-zero integers, and a negative one is a negation."""

    def add(self, clauses: Collection[Sequence[int]]) -> None: ...

    def solve(self, assumptions: Sequence[int] = ()) -> bool | None:
        """Whether the clauses and assumptions have a model; None if undecided."""
        ...

    def holds(self, literal: int) -> bool:
        """Whether a literal is true in the model of the last `solve`."""
        ...

    def core(self) -> list[int]:
        """Assumptions that are sufficient for the last `solve` to be unsatisfiable."""
        ...

    def propagate(self, assumptions: Sequence[int]) -> tuple[bool, list[int]]:
        """Unit propagation: whether it found no contradiction, and the literals that the assumptions make true."""
        ...

    def __enter__(self) -> Solver: ...

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None
    ) -> None: ...


class Refutation(NamedTuple):
    """No model of `clauses` makes all `literals` true."""

    clauses: Sequence[Sequence[int]]
    literals: Sequence[int]


class Recorder(Protocol):
    """Receives the questions of a check that decide it, after their answers. The identity of a list of clauses
    identifies the formula."""

    def refuted(self, clauses: Sequence[Sequence[int]], literals: Sequence[int], what: str = "") -> None:
        """No model of the clauses makes all these literals true. `what` is what this shows, in words."""
        ...

    def satisfied(
        self, clauses: Sequence[Sequence[int]], literals: Sequence[int], holds: Callable[[int], bool]
    ) -> None:
        """`holds` tells what is true in a model of the clauses that makes all these literals true: a situation."""
        ...

    def examine(self, clauses: Sequence[Sequence[int]], literals: Sequence[int], holds: Callable[[int], bool]) -> None:
        """The same, for a step of a search."""
        ...

    def found(self, trace: FoundTrace) -> None:
        """A question was answered with yes by this trace."""
        ...

    def conflict_free(self, component: FreeComponent) -> None:
        """No situation of these rules is without one of these templates."""
        ...


_made: ContextVar[list[ReferenceType[MiniSat]] | None] = ContextVar("made", default=None)


@contextmanager
def released() -> Iterator[None]:
    """Free the memory of all solvers that the block makes, at its end. They cannot be used afterwards.

    Questions about traces refer to themselves, so their solvers would stay until a garbage collection, which knows
    nothing of their size.
    """
    made: list[ReferenceType[MiniSat]] = []
    token = _made.set(made)
    try:
        yield
    finally:
        _made.reset(token)
        for reference in made:
            solver = reference()
            if solver is not None:
                solver.close()


class MiniSat:
    """MiniSat 2.2 of python-sat, which is the fastest to create and to close, and most questions are small.

    The module of C functions of python-sat is called directly. Its class for its twenty solvers takes longer to import
    than a check of eight rules, and as long to call as a small question.
    """

    def __init__(self, clauses: Collection[Sequence[int]] = (), budget: int | None = None) -> None:
        self._solver = pysolvers.minisat22_new()
        self._most_conflicts = CONFLICT_BUDGET if budget is None else budget
        pysolvers.minisat22_cbudget(self._solver, self._most_conflicts)
        self._conflicts = self._literals = 0
        # Signals reach only the main thread, and only there the solver may set its handler.
        self._interruptible = int(current_thread() is main_thread())
        self._model: list[int] = []
        made = _made.get()
        if made is not None:
            made.append(ref(self))
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
        """Solve, or raise `OutOfBudget` if the budget is spent."""
        solver, slice_ = self._solver, SLICE
        budget.spend(PER_QUESTION)
        while True:
            conflicts, literals = self._most_conflicts - self._conflicts, slice_
            if budget.is_timed:
                literals = min(slice_, int(budget.seconds() * PER_SECOND))
            else:
                conflicts = min(conflicts, int(budget.steps / PER_CONFLICT))
                literals = int(budget.steps / PER_LITERAL)
            # At least 1, because 0 means no limit.
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
        # A variable without clauses has no value; use false.
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
        """Free the memory. The solver cannot be used afterwards."""
        if self._solver is not None:
            pysolvers.minisat22_del(self._solver)
            self._solver = None
