"""The questions that were answered no, and those that were answered yes, as the solver was asked them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import chain

from sleec_runtime.errors import SleecError


class NoModel(SleecError):
    """A solver said yes, and its model does not satisfy the question."""


@dataclass
class RecordedQuestion:
    """A formula, and the questions of it that were answered no: each says that some literals are true together."""

    clauses: Sequence[Sequence[int]]
    questions: dict[tuple[int, ...], None] = field(default_factory=dict)


class Recorder:
    """Keeps what solvers are asked. `examining` has it look at every model that a yes comes with.

    A formula is kept as the list that it is, and may grow until `take` is called.
    """

    def __init__(self, examining: bool = False) -> None:
        self._examining = examining
        self._asked: dict[int, RecordedQuestion] = {}
        self._models = 0

    def refuted(self, clauses: Sequence[Sequence[int]], literals: Sequence[int]) -> None:
        """Told that no model of `clauses` makes all `literals` true."""
        asked = self._asked.setdefault(id(clauses), RecordedQuestion(clauses))
        asked.questions[tuple(dict.fromkeys(literals))] = None

    def satisfied(
        self, clauses: Sequence[Sequence[int]], literals: Sequence[int], holds: Callable[[int], bool]
    ) -> None:
        """Told that `holds` says what is true in a model of `clauses` and of `literals`.

        Raises NoModel, if examining, where it is none.
        """
        self._models += 1
        if not self._examining:
            return
        true = set(filter(holds, {*literals, *chain.from_iterable(clauses)}))
        if not true.issuperset(literals) or any(map(true.isdisjoint, clauses)):
            raise NoModel("a solver's model does not satisfy the question", "this is a bug; report it")

    def take(self) -> tuple[list[RecordedQuestion], int]:
        """The formulas with refuted questions since the last call, and how many models there were."""
        taken = list(self._asked.values()), self._models
        self._asked, self._models = {}, 0
        return taken
