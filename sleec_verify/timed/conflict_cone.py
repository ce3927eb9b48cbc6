"""What can have to do with a conflict that comes from one rule.

Without the rule's demand of now there is a way to go on; the conflict is that this cannot be mended. What would have to
change for it spreads, from the rule on:

- An event that is done in addition calls for what its rules say, must be allowed by those that forbid it, and by laws.
- An event that has to be done at another time, or not at all, concerns the rules that call for it then.
- A rule that this concerns may be kept by any of its responses, or by triggering it at another time.
- At an instant to come, the measures are what suits the rules that are triggered there: those that speak of the same
  ones are concerned, by laws as well. (Where nothing speaks of them, they can be what they are now.)

What can be met whatever else is the case concerns nothing, and all else can be done as before. Time complexity: linear
in what is reached.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Literal, NamedTuple

from sleec_runtime.model import Rule, formulas_of, names_of
from sleec_verify.timed.program import Law, Program, events_of, formulas_of_law, law_name, may_call
from sleec_verify.timed.responses import occurrences


class _Step(NamedTuple):
    """That something is concerned, in one of these ways:

    - ``called``: the event may be done in addition;
    - ``moved``: the event may have to be done at other times, or not at all;
    - ``read``: the condition or measure may have another value at an instant to come;
    - ``taken``: all that the rule of this label demands is concerned;
    - ``demanded``: the demand of this number of that rule is, and with it what may be done in its place;
    - ``linked``: the law of this name is concerned."""

    how: Literal["called", "moved", "read", "taken", "demanded", "linked"]
    what: str
    number: int = 0


class Cone:
    """The `rules`, by their labels, and `events` that a conflict from one rule can go through."""

    def __init__(self, program: Program, rule: Rule) -> None:
        self._program = program
        self.rules: dict[str, Rule] = {}
        self.events: set[str] = set()
        self._add(rule)
        ahead = [_Step("taken", rule.label)]
        for what in program.windows(rule):
            if what.negated:
                # For other rules it does as well that the event is one of those of now.
                ahead += self._of(what.event, program.obliging, negated=False)
        found: set[_Step] = set()
        while ahead:
            step = ahead.pop()
            if step not in found:
                found.add(step)
                ahead += self._next(step)

    def _add(self, rule: Rule) -> None:
        self.rules[rule.label] = rule
        self.events.add(rule.trigger)
        self.events.update(what.event for what in self._program.windows(rule))

    def _next(self, step: _Step) -> Iterator[_Step]:
        program, what = self._program, step.what
        if step.how in ("called", "moved"):
            self.events.add(what)
            yield from (_Step("linked", law_name(law)) for law in program.laws_of_event.get(what, ()))
        if step.how == "called":
            yield from (_Step("taken", rule.label) for rule in program.by_trigger.get(what, ()))
            yield from self._of(what, program.forbidding, negated=True)
        elif step.how == "moved":
            yield from self._of(what, program.pressing, negated=False)
        elif step.how == "read":
            yield from (_Step("taken", rule.label) for rule in program.reading_later.get(what, ()))
            yield from (_Step("linked", law_name(law)) for law in program.laws_of_measure.get(what, ()))
        elif step.how == "linked":
            yield from self._law(program.law_named[what])
        else:
            rule = program.ruleset.by_label[what]
            demands = program.demands(rule)
            chosen = demands if step.how == "taken" else demands[step.number : step.number + 1]
            concerned = [demand for demand in chosen if not program.free.is_free(demand)]
            if concerned:
                yield from self._rule(rule)
            for one in (one for demand in concerned for one in occurrences(demand)):
                yield _Step("moved" if one.negated else "called", one.event)

    def _of(self, event: str, index: Mapping[str, Sequence[Rule]], negated: bool) -> Iterator[_Step]:
        """What the rules of an index demand of an event."""
        for rule in index.get(event, ()):
            for number, demand in enumerate(self._program.demands(rule)):
                if any(what.event == event and what.negated == negated for what in occurrences(demand)):
                    yield _Step("demanded", rule.label, number)

    def _rule(self, rule: Rule) -> Iterator[_Step]:
        """Anything of a rule is concerned."""
        self._add(rule)
        if rule.trigger in self._program.may_come_later:
            # Then, another of its clauses may decide.
            yield _Step("moved", rule.trigger)
            yield from (_Step("read", name) for formula in formulas_of(rule) for name in names_of(formula))
            yield _Step("taken", rule.label)

    def _law(self, law: Law) -> Iterator[_Step]:
        yield from (_Step("moved", event) for event in events_of(law))
        yield from (_Step("called", event) for event in may_call(law))
        yield from (_Step("read", name) for formula in formulas_of_law(law) for name in names_of(formula))
