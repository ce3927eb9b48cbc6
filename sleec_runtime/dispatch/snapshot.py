"""One whole context, and what every rule says in it. A change makes a new one; who holds the old one keeps it."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping

from sleec_runtime.dispatch.plan import Plan
from sleec_runtime.dispatch.program import Program
from sleec_runtime.evaluation.formula_truth import Situation
from sleec_runtime.evaluation.hedge_chain import Outcome, walk
from sleec_runtime.model import Context, Rule, Value
from sleec_runtime.support.chunked_sequence import Chunks


class Conditions(Mapping[str, Value]):
    """What is known in one context: conditions and measures by name. Immutable."""

    __slots__ = ("_numbers", "_values")

    def __init__(self, numbers: Mapping[str, int], values: Chunks[Value | None]) -> None:
        self._numbers = numbers
        self._values = values

    def get(self, name: str, default: object = None) -> Value | None:  # type: ignore[override]
        number = self._numbers.get(name)
        value = None if number is None else self._values[number]
        return value if value is not None else default  # type: ignore[return-value]

    def __getitem__(self, name: str) -> Value:
        value = self.get(name)
        if value is None:
            raise KeyError(name)
        return value

    def __iter__(self) -> Iterator[str]:
        return (name for name, number in self._numbers.items() if self._values[number] is not None)

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __repr__(self) -> str:
        return f"Conditions({dict(self)})"


class Cell:
    """What the rules of one trigger say in one context, and the plan made of it when it was first asked for."""

    __slots__ = ("outcomes", "plan")

    def __init__(self, outcomes: tuple[Outcome, ...]) -> None:
        self.outcomes = outcomes
        self.plan: Plan | None = None


class Snapshot:
    """A context χ without triggers, with the outcome of every rule for the case that its trigger occurs.

    `number` counts the changes. `mark` is another object whenever something changed that a `NEVER` mentions: a plan
    checked under one mark is good under it. `rows` are the rows of the cells, for dispatch.
    """

    __slots__ = ("_cells", "_values", "mark", "number", "program", "rows")

    def __init__(
        self, program: Program, values: Chunks[Value | None], cells: Chunks[Cell], mark: object, number: int
    ) -> None:
        self.program = program
        self._values = values
        self._cells = cells
        self.rows = cells.rows
        self.mark = mark
        self.number = number

    @classmethod
    def first(cls, program: Program, known: Mapping[str, object], number: int = 0) -> Snapshot:
        """The context in which only `known` is reported. O(size of the rules). Raises as `Program.checked` does."""
        initial: Chunks[Value | None] = Chunks.of([None] * len(program.numbers))
        values = initial.replaced(program.checked(known))
        reading = program.ruleset.reading
        cells = []
        for trigger, rules in zip(program.number_of, program.cells):
            situation = _situation(program, values, (trigger,))
            cells.append(Cell(tuple(walk(rule, situation, reading) for rule in rules)))
        return cls(program, values, Chunks.of(cells), object(), number)

    @property
    def conditions(self) -> Conditions:
        return Conditions(self.program.numbers, self._values)

    def context(self, triggers: Iterable[str] = ()) -> Context:
        """This context, with `triggers` occurring in it."""
        return Context(frozenset(triggers), self.conditions)

    def cell(self, number: int) -> Cell:
        return self._cells[number]

    def outcome(self, rule: Rule, triggers: Collection[str] = ()) -> Outcome:
        """What a rule of the program says here if its trigger occurs, alone or together with other `triggers`."""
        program = self.program
        if len(triggers) > 1 and rule.label in program.tied:
            return walk(rule, _situation(program, self._values, triggers), program.ruleset.reading)
        cell, position = program.place_of[rule.label]
        return self._cells[cell].outcomes[position]

    def changed(self, changes: Mapping[str, object]) -> tuple[Snapshot, tuple[Rule, ...]]:
        """The context after `changes`, and the rules that were decided anew.

        O(changes + the size of the rules that mention a changed name). Raises as `Program.checked` does; nothing is
        changed then, nor is this snapshot ever.
        """
        program = self.program
        checked = program.checked(changes)
        values = {number: value for number, value in checked.items() if self._values[number] != value}
        if not values:
            return self, ()
        after = self._values.replaced(values)
        names = [name for name in changes if program.numbers[name] in values]
        concerned = dict.fromkeys(place for name in names for place in program.mentions.get(name, ()))
        outcomes: dict[int, list[Outcome]] = {}
        for cell, position in concerned:
            if cell not in outcomes:
                outcomes[cell] = list(self._cells[cell].outcomes)
            rule = program.cells[cell][position]
            outcomes[cell][position] = walk(rule, _situation(program, after, (rule.trigger,)), program.ruleset.reading)
        cells = self._cells.replaced({cell: Cell(tuple(of_cell)) for cell, of_cell in outcomes.items()})
        mark = self.mark if program.situational.isdisjoint(names) else object()
        rules = tuple(program.cells[cell][position] for cell, position in concerned)
        return Snapshot(program, after, cells, mark, self.number + 1), rules

    def without_plans(self, triggers: Iterable[str]) -> Snapshot:
        """The same context, with the plans of `triggers` to be made anew: something else is bound to their rules."""
        numbers = [self.program.number_of[trigger] for trigger in triggers if trigger in self.program.number_of]
        cells = self._cells.replaced({number: Cell(self._cells[number].outcomes) for number in numbers})
        return Snapshot(self.program, self._values, cells, self.mark, self.number)


def _situation(program: Program, values: Chunks[Value | None], triggers: Iterable[str]) -> Situation:
    """What rules are decided in if `triggers` occur."""
    context = Context(frozenset(triggers), Conditions(program.numbers, values))
    return Situation(context, program.measures, None if program.strict else False)
