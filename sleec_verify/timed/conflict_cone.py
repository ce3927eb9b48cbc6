"""What can have to do with a conflict that comes from one rule.

Without the rule's demand of now there is a way to go on; the conflict is that this cannot be mended. What would have to
change for it spreads, from the rule on:

- An event that is done in addition calls for what its rules say, must be allowed by those that forbid it, and by laws.
- An event that has to be done at another time, or not at all, concerns the rules that call for it then.
- A rule that this concerns may be kept by any of its responses, or by triggering it at another time.
- At an instant to come, the measures are what suits the rules that are triggered there: those that speak of the same
  ones are concerned, by laws as well. (Where nothing speaks of them, they can be what they are now.)

All else can be done as before. Time complexity: linear in what is reached.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from sleec_runtime.model import Assume, Formula, Never, Rule, formulas_of, names_of
from sleec_runtime.model_time import Effect, EventRelation, Lasting
from sleec_verify.timed.program import Law, Program, events_of, formulas_of_law
from sleec_verify.timed.responses import Demand, occurrences


class Cone:
    """The `rules`, by their labels, and `events` that a conflict from one rule can go through."""

    def __init__(self, program: Program, rule: Rule) -> None:
        self._program = program
        self.rules: dict[str, Rule] = {}
        self.events: set[str] = set()
        self._called: set[str] = set()
        self._moved: set[str] = set()
        self._measures: set[str] = set()
        self._laws: set[int] = set()
        self._concerned: set[tuple[str, int]] = set()
        self._ahead: list[Demand] = []
        self._take([rule])
        for demand in program.demands(rule):
            for what in occurrences(demand):
                if what.negated:
                    # For other rules it does as well that the event is one of those of now.
                    self._take_for(what.event, program.obliging, negated=False)
        while self._ahead:
            for what in occurrences(self._ahead.pop()):
                if what.negated:
                    self._move(what.event)
                else:
                    self._call(what.event)

    def _take(self, rules: Iterable[Rule]) -> None:
        """All that these rules demand is concerned."""
        for rule in rules:
            for number, demand in enumerate(self._program.demands(rule)):
                self._concern(rule, number, demand)

    def _take_for(self, event: str, index: Mapping[str, Sequence[Rule]], negated: bool) -> None:
        """What the rules of an index demand of an event is concerned, and with it what may be done in its place."""
        for rule in index.get(event, ()):
            for number, demand in enumerate(self._program.demands(rule)):
                if any(what.event == event and what.negated == negated for what in occurrences(demand)):
                    self._concern(rule, number, demand)

    def _concern(self, rule: Rule, number: int, demand: Demand) -> None:
        key = (rule.label, number)
        if key in self._concerned:
            return
        self._concerned.add(key)
        self._ahead.append(demand)
        if rule.label not in self.rules:
            self.rules[rule.label] = rule
            self.events.add(rule.trigger)
            self.events.update(what.event for what in self._program.windows(rule))
            if rule.trigger in self._program.may_come_later:
                # Then, another of its clauses may decide.
                self._move(rule.trigger)
                self._read(formulas_of(rule))
                self._take([rule])

    def _call(self, event: str) -> None:
        """The event may be done in addition."""
        self.events.add(event)
        if event not in self._called:
            self._called.add(event)
            program = self._program
            self._take(program.by_trigger.get(event, ()))
            self._take_for(event, program.forbidding, negated=True)
            self._link(program.laws_of_event.get(event, ()))

    def _move(self, event: str) -> None:
        """The event may have to be done at other times."""
        self.events.add(event)
        if event not in self._moved:
            self._moved.add(event)
            self._take_for(event, self._program.pressing, negated=False)
            self._link(self._program.laws_of_event.get(event, ()))

    def _read(self, formulas: Iterable[Formula]) -> None:
        for name in (name for formula in formulas for name in names_of(formula)):
            if name not in self._measures:
                self._measures.add(name)
                self._take(self._program.reading_later.get(name, ()))
                self._link(self._program.laws_of_measure.get(name, ()))

    def _link(self, laws: Iterable[Law]) -> None:
        for law in laws:
            if law.span.start not in self._laws:
                self._laws.add(law.span.start)
                for event in events_of(law):
                    self._move(event)
                for event in _may_call(law):
                    self._call(event)
                self._read(formulas_of_law(law))


def _may_call(law: Law) -> Iterator[str]:
    """The events that a law may call for."""
    if isinstance(law, EventRelation):
        if law.relation in ("equal", "happenBefore"):
            yield law.left
        if law.relation in ("equal", "witness"):
            yield law.right
    elif isinstance(law, Lasting):
        if law.end is not None:
            yield law.end
    elif isinstance(law, (Assume, Never)) or (isinstance(law, Effect) and law.relation == "causation"):
        yield from events_of(law)
