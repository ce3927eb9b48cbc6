"""A SAT solver behind four calls, so that another can take its place. The one in use is python-sat's.

A solver says yes, no, or None where it gave up: unknown is an answer, never an exception swallowed.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from types import TracebackType
from typing import Any, Protocol

from sleec_runtime.errors import SleecError

CONFLICT_BUDGET = 2_000_000
"""Conflicts after which a question is given up. Questions about rules that people write need a few dozen."""


class Undecided(SleecError):
    """A question that was given up. A check turns this into the verdict `Unknown`; it never counts as fine."""


class Solver(Protocol):
    """What the verifier needs of a solver. Literals are non-zero integers, a negative one is a negation."""

    def add(self, clauses: Iterable[Sequence[int]]) -> None: ...

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


class MiniSat:
    """MiniSat 2.2 by python-sat: the quickest to set up and to take down, and most questions are small."""

    def __init__(self, clauses: Iterable[Sequence[int]] = ()) -> None:
        from pysat.solvers import Minisat22

        self._solver: Any = Minisat22(bootstrap_with=clauses)
        self._solver.conf_budget(CONFLICT_BUDGET)
        self._model: list[int] = []

    def add(self, clauses: Iterable[Sequence[int]]) -> None:
        self._solver.append_formula(clauses)

    def solve(self, assumptions: Sequence[int] = ()) -> bool | None:
        answer: bool | None = self._solver.solve_limited(assumptions)
        if answer:
            self._model = self._solver.get_model()
        return answer

    def holds(self, literal: int) -> bool:
        variable = abs(literal)
        # A variable that stands in no clause has no value; false serves.
        true = variable <= len(self._model) and self._model[variable - 1] > 0
        return true == (literal > 0)

    def core(self) -> list[int]:
        return self._solver.get_core() or []

    def propagate(self, assumptions: Sequence[int]) -> tuple[bool, list[int]]:
        consistent, literals = self._solver.propagate(assumptions)
        return consistent, literals

    def __enter__(self) -> MiniSat:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self._solver.delete()
