"""The smallest situation that makes a formula true, whatever else holds.

A situation names some triggers and conditions, and all others must not matter. So every name has two variables, "known
true" and "known false" (dual-rail encoding). The formula must follow from what is known (Kleene's three values: sound
for every completion). The solver finds such a situation. A counter then reduces the number of names until no smaller
situation exists.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from sleec_runtime.model import And, Comparison, Formula, Not, Or, Truth, Value, measures_of
from sleec_verify.encoding.cnf import Encoder
from sleec_verify.encoding.solver import MiniSat, Solver, Undecided
from sleec_verify.query.assumption_slicing import slicing_of
from sleec_verify.query.names import Name, names_in
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.query.unit_propagation import Impossible, Literals, propagate_units
from sleec_verify.results.finding import Witness
from sleec_verify.wording.sentence import sentence


def smallest_situation(index: RulesetIndex, formula: Formula, valued: Iterable[str] = ()) -> Witness | None:
    """A situation with a minimal number of names that makes `formula` (over triggers, conditions and measures) true, or
    None.

    The measures of `valued` always get a value. If all names that the situation does not mention are false (Definition
    1), the assumptions allow it.

    Raises `Undecided` if the solver gave up.
    """
    valued, assumed = set(valued), _assumed(index, formula, valued)
    least = 0
    if not assumed and not valued:
        try:
            found = propagate_units(formula)
        except Impossible:
            return None
        if not found.open_parts:
            return _of_literals(found.literals)
        least = found.least()
    rails = _Rails(index)
    rails.encoder.clauses.append([rails.known(formula, True)])
    for measure in sorted(valued):
        rails.require_value(measure)
    for assumption in assumed:
        rails.encoder.clauses.append([rails.in_completion(assumption)])
    rails.encoder.close()
    return rails.smallest(least)


def _assumed(index: RulesetIndex, formula: Formula, valued: Iterable[str]) -> list[Formula]:
    """The assumptions that a situation of the formula may violate, sliced to what may have to occur there."""
    if not index.assumptions:
        return []
    named = set(names_in(formula))
    # Unnecessary triggers do not make a situation smaller.
    occurring = slicing_of(index).occurring_with(name for kind, name in named if kind == "trigger")
    named.update(("condition", measure) for measure in valued)
    return slicing_of(index).kept_by(named, occurring)


def _of_literals(literals: Literals) -> Witness:
    names = sorted(literals)
    return Witness(
        tuple(name for kind, name in names if kind == "trigger" and literals[kind, name]),
        {name: literals[kind, name] for kind, name in names if kind == "condition"},
        tuple(name for kind, name in names if kind == "trigger" and not literals[kind, name]),
    )


class _Rails:
    """The formula over what is known, and the search for the smallest number of names."""

    def __init__(self, index: RulesetIndex) -> None:
        self.encoder = Encoder(index.ruleset.measures)
        self._rails: dict[Name, tuple[int, int]] = {}
        self._mentioned: dict[Name, int] = {}
        self._known: dict[tuple[int, bool], int] = {}

    def _rails_of(self, name: Name) -> tuple[int, int]:
        rails = self._rails.get(name)
        if rails is None:
            yes, no = rails = self._rails[name] = (self.encoder.fresh(), self.encoder.fresh())
            self.encoder.clauses.append([-yes, -no])
            self._mentioned[name] = self.encoder.any_of([yes, no])
        return rails

    def _measure(self, measure: str) -> int:
        name = ("condition", measure)
        if name not in self._mentioned:
            self._mentioned[name] = self.encoder.fresh()
        return self._mentioned[name]

    def require_value(self, measure: str) -> None:
        self.encoder.measures.mention(measure)
        self.encoder.clauses.append([self._measure(measure)])

    def _compared(self, comparison: Comparison, value: bool) -> int:
        literal = self.encoder.measures.literal(comparison)
        mentioned = [self._measure(measure) for measure in measures_of(comparison)]
        return self.encoder.all_of([literal if value else -literal, *mentioned])

    def known(self, formula: Formula, value: bool) -> int:
        """A literal that is true only if what is known gives `formula` this value."""
        # Equation 1 repeats the conditions, as the same objects.
        seen = self._known.get((id(formula), value))
        if seen is None:
            seen = self._known[id(formula), value] = self._build(formula, value)
        return seen

    def _build(self, formula: Formula, value: bool) -> int:
        if isinstance(formula, Not):
            return self.known(formula.operand, not value)
        if isinstance(formula, (And, Or)):
            parts = [self.known(operand, value) for operand in formula.operands]
            return self.encoder.all_of(parts) if isinstance(formula, And) == value else self.encoder.any_of(parts)
        if isinstance(formula, Comparison):
            return self._compared(formula, value)
        if isinstance(formula, Truth):
            return self.encoder.true() if formula.value == value else -self.encoder.true()
        yes, no = self._rails_of((formula.kind, formula.name))
        return yes if value else no

    def in_completion(self, formula: Formula) -> int:
        """The literal of `formula` if everything unknown is false."""
        if isinstance(formula, Not):
            return -self.in_completion(formula.operand)
        if isinstance(formula, And):
            return self.encoder.all_of([self.in_completion(operand) for operand in formula.operands])
        if isinstance(formula, Or):
            return self.encoder.any_of([self.in_completion(operand) for operand in formula.operands])
        if isinstance(formula, Comparison):
            return self._compared(formula, True)
        if isinstance(formula, Truth):
            return self.encoder.true() if formula.value else -self.encoder.true()
        return self._rails_of((formula.kind, formula.name))[0]

    def smallest(self, least: int) -> Witness | None:
        """The smallest situation. `least` is a lower bound on its number of names."""
        names = sorted(self._mentioned)
        with MiniSat(self.encoder.clauses) as solver:
            values = self._solve(solver)
            if values is None:
                return None
            situation, size = self._situation(solver, values)
            if size <= least:
                return situation
            counter = _Counter(self.encoder, [self._mentioned[name] for name in names], size)
            solver.add(counter.clauses)
            while size > least:
                solver.add([[-counter.at_least[size]]])
                values = self._solve(solver)
                if values is None:
                    break
                situation, size = self._situation(solver, values)
        return situation

    def _solve(self, solver: Solver) -> Mapping[str, Value] | None:
        """The values of the measures in a situation, or None if there is no situation."""
        while True:
            answer = solver.solve()
            if answer is None:
                raise Undecided(sentence("the solver reached its limit in the search for a smallest situation"))
            if not answer:
                return None
            values = self.encoder.measures.decode(solver.holds)
            if not isinstance(values, list):
                return values
            solver.add([values])

    def _situation(self, solver: Solver, values: Mapping[str, Value]) -> tuple[Witness, int]:
        """The situation in the solver's model, and the number of its names."""
        mentioned = [name for name, variable in sorted(self._mentioned.items()) if solver.holds(variable)]
        triggers, absent = [], []
        conditions: dict[str, Value] = {}
        for kind, name in mentioned:
            rails = self._rails.get((kind, name))
            if rails is None:
                conditions[name] = values[name]
            elif kind == "condition":
                conditions[name] = solver.holds(rails[0])
            elif solver.holds(rails[0]):
                triggers.append(name)
            else:
                absent.append(name)
        return Witness(tuple(triggers), conditions, tuple(absent)), len(mentioned)


class _Counter:
    """Clauses that make ``at_least[k]`` true if k of the literals are true, for k up to `most` (sequential counter)."""

    def __init__(self, encoder: Encoder, literals: list[int], most: int) -> None:
        self.clauses: list[list[int]] = []
        self.at_least: dict[int, int] = {}
        for literal in literals:
            extended = {k: encoder.fresh() for k in range(1, min(most, len(self.at_least) + 1) + 1)}
            for k, register in extended.items():
                if k in self.at_least:
                    self.clauses.append([-self.at_least[k], register])
                if k == 1:
                    self.clauses.append([-literal, register])
                elif k - 1 in self.at_least:
                    self.clauses.append([-literal, -self.at_least[k - 1], register])
            self.at_least = extended
