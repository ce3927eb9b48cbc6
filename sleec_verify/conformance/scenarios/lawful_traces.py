"""All traces that satisfy the rules, relations and constraints, as one question to the solver."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from sleec_runtime.model import Clause, Formula, Rule
from sleec_verify.conformance.cases.allowed_situations import Goal
from sleec_verify.conformance.cases.goals import goals_of_rule
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.traces.demands import Occurs
from sleec_verify.traces.index import trace_index_of
from sleec_verify.traces.induction import InductiveModel
from sleec_verify.traces.model import TraceModel
from sleec_verify.traces.trace import TraceInstant


class LawfulTraces:
    """The question, with the rules of one domain. Goals are about the instant `now`. Earlier and later instants are
    added as they are needed. With `single`, no two mere inputs occur at once. Without `lawful`, traces satisfy the
    relations, but not necessarily the rules."""

    def __init__(self, index: RulesetIndex, single: bool = False, lawful: bool = True) -> None:
        self.index = index
        self.traces = trace_index_of(index)
        self._model = InductiveModel(self.traces) if lawful else TraceModel(self.traces, rules={})
        if single:
            self._model.everywhere(self._one_input)
        self._now = self._model.instant(self._model.formula.true)
        self.encoder = self._model.instants[self._now]
        self._guards: dict[int, list[int]] = {}
        self._situations: dict[int, list[Goal]] = {}
        self._occurs: dict[Occurs, int] = {}

    # The instant now ------------------------------------------------------------------------------------------

    def trigger(self, name: str) -> int:
        return self.encoder.event(name)

    def literal(self, formula: Formula) -> int:
        return self.encoder.literal(formula)

    def guards(self, position: int) -> list[int]:
        """The literals of the guards of one rule's clauses."""
        if position not in self._guards:
            rule = self.index.rules[position]
            self._guards[position] = self.encoder.guards(rule, self.index.ruleset.reading)
        return self._guards[position]

    def chain(self, clause: Clause) -> list[int]:
        """The literals of the clauses of an alternative's chain."""
        return self._model.chain(self._now)(clause)

    def situations(self, criterion: str, position: int) -> list[Goal]:
        """The goals of one rule that are about now alone."""
        if position not in self._situations:
            self._situations[position] = goals_of_rule(self, criterion, position)
        return self._situations[position]

    # Other instants -------------------------------------------------------------------------------------------

    def occurs(self, what: Occurs) -> int:
        """A literal that implies that an event occurs, or does not occur, in a window after now."""
        if what not in self._occurs:
            self._occurs[what] = self._model.occurs(self._now, what)
        return self._occurs[what]

    def one_decides(self, ways: Iterable[tuple[Rule, int, int]]) -> int:
        """A literal that implies one of these: a clause of a rule decides a number of seconds after now."""
        return self._model.formula.any_of([self._decides(*way) for way in ways])

    def _decides(self, rule: Rule, number: int, after: int) -> int:
        model = self._model

        def here(at: int) -> int:
            bounds = model.times.within(self._now, at, after, after)
            if -model.formula.true in bounds:
                return -model.formula.true
            return model.formula.every([model.guards(at, rule)[number][1], *bounds])

        return model.exists(here)

    def _one_input(self, at: int) -> None:
        events = [self._model.instants[at].event(event) for event in sorted(self.traces.mere_inputs)]
        self._model.add([-self._model.instants[at].at_least_two(events)])

    # Questions ------------------------------------------------------------------------------------------------

    def reaches(self, literals: Iterable[int]) -> bool:
        """Whether some trace makes all of these true. Raises `Undecided`."""
        return self._model.ask(*literals)

    def true(self, literal: int) -> bool:
        """Whether a literal is true in the trace of the last question."""
        return self._model.true(literal)

    def smallest(self, literals: Iterable[int]) -> tuple[TraceInstant, ...]:
        """A trace that makes these true, without unnecessary instants, events and conditions, at the earliest times
        from 0 on. Raises `Undecided`."""
        model = self._model
        required = list(literals)
        found = model.ask(*required)
        assert found, "asked for what was found to be reachable"
        needed: set[int] = set()
        while left := [literal for literal in self._parts() if literal not in needed and -literal not in required]:
            for literal in left:
                # What is false already stays false.
                if not model.true(literal) or model.ask_here(*required, -literal):
                    required.append(-literal)
                else:
                    needed.add(literal)
            model.ask_here(*required)
        times, _ = model.schedule()
        nodes = sorted((node for node in model.used() if node in model.instants), key=times.__getitem__)
        return tuple(model.at(node, times[node] - times[nodes[0]]) for node in nodes)

    def _parts(self) -> Iterator[int]:
        """The literals of the instants, events and conditions of a trace."""
        instants = self._model.instants.values()
        yield from (instant.used for instant in instants)
        for instant in instants:
            yield from instant.events().values()
            yield from (literal for (kind, *_), literal in instant.state().items() if kind == "condition")
