"""Records the unsatisfiable and satisfiable queries of the solver."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import chain

from sleec_runtime.errors import SleecError
from sleec_verify.results.found_trace import FoundTrace


class NoModel(SleecError):
    """A solver returned a model that does not satisfy the question."""


@dataclass
class RecordedQuestion:
    """A formula and its unsatisfiable questions. Each question asks whether some literals can be true together."""

    clauses: Sequence[Sequence[int]]
    questions: dict[tuple[int, ...], None] = field(default_factory=dict)


class Recorder:
    """Keeps the questions to solvers. With `examining`, it checks every model.

    It keeps a reference to the list of a formula, which may grow until `take` is called.
    """

    def __init__(self, examining: bool = False) -> None:
        self._examining = examining
        self._asked: dict[int, RecordedQuestion] = {}
        self._models = 0
        self._traces: list[FoundTrace] = []

    def refuted(self, clauses: Sequence[Sequence[int]], literals: Sequence[int]) -> None:
        """Records that no model of `clauses` makes all `literals` true."""
        asked = self._asked.setdefault(id(clauses), RecordedQuestion(clauses))
        asked.questions[tuple(dict.fromkeys(literals))] = None

    def satisfied(
        self, clauses: Sequence[Sequence[int]], literals: Sequence[int], holds: Callable[[int], bool]
    ) -> None:
        """Records a model of `clauses` and `literals`. `holds` says which literals are true in it.

        Raises NoModel, if examining, if it is not a model.
        """
        self._models += 1
        if not self._examining:
            return
        true = set(filter(holds, {*literals, *chain.from_iterable(clauses)}))
        if not true.issuperset(literals) or any(map(true.isdisjoint, clauses)):
            raise NoModel("a solver's model does not satisfy the question", "this is a bug; report it")

    def found(self, trace: FoundTrace) -> None:
        """Records a trace that answers a question with yes."""
        self._traces.append(trace)

    def take_traces(self) -> list[FoundTrace]:
        """The traces since the last call."""
        taken, self._traces = self._traces, []
        return taken

    def take(self) -> tuple[list[RecordedQuestion], int]:
        """The formulas with refuted questions, and the number of models, since the last call."""
        taken = list(self._asked.values()), self._models
        self._asked, self._models = {}, 0
        return taken
