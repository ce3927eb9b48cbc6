"""Records the unsatisfiable and satisfiable queries of the solver."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import chain

from sleec_runtime.errors import SleecError
from sleec_verify.results.conflict_freedom import FreeComponent
from sleec_verify.results.found_trace import FoundTrace


class NoModel(SleecError):
    """A solver returned a model that does not satisfy the question."""


@dataclass
class RecordedQuestion:
    """A formula and its unsatisfiable questions. Each question asks whether some literals can be true together, and has
    words for what the answer no shows."""

    clauses: Sequence[Sequence[int]]
    questions: dict[tuple[int, ...], str] = field(default_factory=dict)


class Recorder:
    """Keeps the questions to solvers. With `examining`, it checks every model.

    It keeps a reference to the list of a formula, which may grow until `take` is called.
    """

    def __init__(self, examining: bool = False) -> None:
        self._examining = examining
        self._asked: dict[int, RecordedQuestion] = {}
        self._models = 0
        self._traces: list[FoundTrace] = []
        self._free: list[FreeComponent] = []

    def refuted(self, clauses: Sequence[Sequence[int]], literals: Sequence[int], what: str = "") -> None:
        """Records that no model of `clauses` makes all `literals` true, which shows `what`."""
        asked = self._asked.setdefault(id(clauses), RecordedQuestion(clauses))
        asked.questions[tuple(dict.fromkeys(literals))] = what

    def satisfied(
        self, clauses: Sequence[Sequence[int]], literals: Sequence[int], holds: Callable[[int], bool]
    ) -> None:
        """Records a situation: a model of `clauses` and `literals`. Raises NoModel as `examine`."""
        self._models += 1
        self.examine(clauses, literals, holds)

    def examine(self, clauses: Sequence[Sequence[int]], literals: Sequence[int], holds: Callable[[int], bool]) -> None:
        """Checks a model of `clauses` and `literals`, if examining. `holds` says which literals are true in it.

        Raises NoModel if it is not a model.
        """
        if not self._examining:
            return
        true = set(filter(holds, {*literals, *chain.from_iterable(clauses)}))
        if not true.issuperset(literals) or any(map(true.isdisjoint, clauses)):
            raise NoModel("a solver's model does not satisfy the question", "this is a bug; report it")

    def found(self, trace: FoundTrace) -> None:
        """Records a trace that answers a question with yes."""
        self._traces.append(trace)

    def conflict_free(self, component: FreeComponent) -> None:
        """Records that rules are in no conflict."""
        self._free.append(component)

    def take_free(self) -> list[FreeComponent]:
        """The components without conflicts since the last call."""
        taken, self._free = self._free, []
        return taken

    def take_traces(self) -> list[FoundTrace]:
        """The traces since the last call."""
        taken, self._traces = self._traces, []
        return taken

    def take(self) -> tuple[list[RecordedQuestion], int]:
        """The formulas with refuted questions, and the number of models, since the last call."""
        taken = list(self._asked.values()), self._models
        self._asked, self._models = {}, 0
        return taken
