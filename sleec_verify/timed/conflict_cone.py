"""What can have to do with a conflict that comes from one rule."""

from __future__ import annotations

from sleec_runtime.model import Rule
from sleec_verify.timed.program import Program, responses_of


class Cone:
    """What can have to do with a conflict that comes from one rule."""

    def __init__(self, program: Program, rule: Rule) -> None:
        self.program = program
        self._index()
        self.rules: dict[str, Rule] = {}
        self.events: set[str] = {rule.trigger}
        self._ahead: list[str] = []
        self._reached: set[str] = set()
        self._take(rule, own=True)
        while self._ahead:
            event = self._ahead.pop()
            for other in self.program.by_trigger.get(event, ()):
                self._take(other)
            for other in self._forbidding.get(event, ()):
                self._take_one(other)
            for name in self._bound.get(event, ()):
                self._reach(name)
                for other in self._obliging.get(name, ()):
                    self._take_one(other)

    def _index(self) -> None:
        program = self.program
        self._forbidding, self._obliging, self._bound = program.forbidding, program.obliging, program.bound

    def _reach(self, event: str) -> None:
        self.events.add(event)
        if event not in self._reached:
            self._reached.add(event)
            self._ahead.append(event)

    def _take_one(self, rule: Rule) -> None:
        if rule.label not in self.rules:
            self.rules[rule.label] = rule
            self.events.add(rule.trigger)
            self.events.update(o.name for o in responses_of(rule))

    def _take(self, rule: Rule, own: bool = False) -> None:
        """A rule that the conflict may go through: what it obliges happens."""
        self._take_one(rule)
        for obligation in responses_of(rule):
            if not obligation.negated:
                self._reach(obligation.name)
            else:
                for other in self._obliging.get(obligation.name, ()):
                    if own or self.program.is_timed(other):
                        self._take_one(other)
                for name in self._bound.get(obligation.name, ()):
                    self._reach(name)
