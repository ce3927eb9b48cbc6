"""All traces that satisfy the rules, relations and constraints, as one question to the solver."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

from sleec_runtime.model import Clause, Formula, Obligation, Rule
from sleec_verify.conformance.cases.allowed_situations import Goal
from sleec_verify.conformance.cases.goals import goals_of_rule
from sleec_verify.encoding.solver import Undecided
from sleec_verify.encoding.window_lengths import lengths_of
from sleec_verify.query.ruleset_index import RulesetIndex
from sleec_verify.traces.demands import Occurs
from sleec_verify.traces.index import TraceIndex, trace_index_of
from sleec_verify.traces.induction import InductiveModel
from sleec_verify.traces.model import TraceModel
from sleec_verify.traces.trace import TraceInstant


class LawfulTraces:
    """The question, with the rules of one domain. Goals are about the instant `now`. Earlier and later instants are
    added as they are needed.

    With `single`, no two mere inputs occur at once. With `startable`, no prohibition forbids an obligation at the
    instant of its trigger: a runtime that starts obligations at once rejects such triggers. Without `lawful`, traces
    satisfy the relations, but not necessarily the rules.
    """

    def __init__(self, index: RulesetIndex, single: bool = False, startable: bool = False, lawful: bool = True) -> None:
        self.index = index
        self._startable = startable
        self.traces = trace_index_of(index)
        self._model = InductiveModel(self.traces) if lawful else TraceModel(self.traces, rules={})
        if single:
            self._model.everywhere(self._one_input)
        self.unbounded: dict[str, str] = {}
        """The rules with a window whose length has no bounds, and why. Their triggers do not occur."""
        self._exclude_unbounded()
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

    def _exclude_unbounded(self) -> None:
        for rule in self.index.rules:
            try:
                self.traces.windows(rule)
            except Undecided as error:
                self.unbounded[rule.label] = error.message
                self._model.exclude(self._model.formula.true, rule.trigger)

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
        return self._ask(self._model.ask, literals)

    def prompt(self, literals: Iterable[int]) -> list[int]:
        """These literals, which some trace makes true, and literals with which each obligation is met as soon as its
        window opens, as far as possible. Raises `Undecided`."""
        required = list(literals)
        seen: set[tuple[int, Occurs, int]] = set()
        while self.reaches(required):
            left = [one for one in self._responses() if not one[1].negated and one not in seen]
            if not left:
                break
            seen.update(left)
            wanted = [self._promptly(*one) for one in left]
            self._add_many(self._model.ask, required, wanted)
        return required

    def _promptly(self, at: int, window: Occurs, guard: int) -> int:
        """A literal that implies that a response is met as its window opens, if its clause decides."""
        met = self._model.occurs(at, window._replace(end=window.start))
        return self._model.formula.any_of([-guard, met])

    def _add_many(self, ask: Callable[..., bool], required: list[int], wanted: Sequence[int]) -> None:
        """Adds as many of the literals `wanted` to `required` as a trace can make true: by halves, because most of them
        can be added together. `ask` has found a trace for `required`."""
        required += [literal for literal in wanted if self._model.true(literal)]
        left = [literal for literal in wanted if not self._model.true(literal)]
        if not left:
            return
        if self._ask(ask, [*required, *left]):
            required += left
            return
        self._ask(ask, required)
        half = len(left) // 2
        if half:
            self._add_many(ask, required, left[:half])
            self._add_many(ask, required, left[half:])

    def _ask(self, ask: Callable[..., bool], literals: Iterable[int]) -> bool:
        required = list(literals)
        while ask(*required):
            refused = list(self._not_startable()) if self._startable else []
            if not refused:
                return True
            for clause in refused:
                self._model.add(clause)
        return False

    def _not_startable(self) -> Iterator[list[int]]:
        """Clauses that exclude what cannot be started in the trace of the last question."""
        responses = list(self._responses())
        forbidden = [one for one in responses if one[1].negated]
        for at, window, guard in responses:
            for other, prohibition, why in forbidden:
                if not window.negated and window.start == 0 != window.end and window.event == prohibition.event:
                    bounds = self._model.times.within(other, at, prohibition.start, prohibition.end)
                    if all(map(self._model.true, bounds)):
                        yield [-guard, -why, *(-bound for bound in bounds)]

    def _responses(self) -> Iterator[tuple[int, Occurs, int]]:
        """The responses of the clauses that decide in the trace of the last question: the instant of the trigger, the
        window, and the literal of the guard."""
        for one in self._model.decided:
            if self._model.true(one.guard):
                for obligation in one.clause.obligations:
                    window = fixed_window(self.traces, obligation)
                    if window is not None:
                        yield one.at, Occurs(obligation.name, *window, negated=obligation.negated), one.guard

    def smallest(self, literals: Iterable[int]) -> tuple[TraceInstant, ...]:
        """A trace that makes these true, without unnecessary instants, events and conditions, at the earliest times
        from 0 on. Raises `Undecided`."""
        model = self._model
        required = list(literals)
        found = self.reaches(required)
        assert found, "asked for what was found to be reachable"
        tried: set[int] = set()
        # A trace without some parts may have new ones.
        while left := [literal for literal in self._parts() if literal not in tried]:
            tried.update(left)
            self._add_many(model.ask_here, required, [-literal for literal in left])
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


def fixed_window(traces: TraceIndex, obligation: Obligation) -> tuple[int, int | None] | None:
    """The first and the last second of the window of a response, or None if a measure gives its length."""
    if any(length.measures for length in lengths_of(obligation)):
        return None
    return traces.responses.window(obligation)
