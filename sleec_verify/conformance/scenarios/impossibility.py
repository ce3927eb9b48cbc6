"""Whether something can happen at an instant, given what is forbidden and what follows from it at once."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from typing import NamedTuple

from sleec_runtime.model import Context, Obligation, Ruleset, Value
from sleec_verify.conformance.scenarios.compiled_rules import CompiledRules
from sleec_verify.conformance.scenarios.requirement import Requirements


class Span(NamedTuple):
    """The times from `first` to `last` (None: no end) at which an event is required or forbidden."""

    name: str
    first: int
    last: int | None

    def covers(self, time: int) -> bool:
        """Whether `time` is one of them."""
        return self.first <= time and (self.last is None or time <= self.last)

    def covers_all(self, other: Span, now: int) -> bool:
        """Whether it covers what is left of the window of `other` from `now` on."""
        ends_later = self.last is None or (other.last is not None and other.last <= self.last)
        return self.name == other.name and self.first <= max(other.first, now) and ends_later


class Impossibility:
    """Contradictions of one instant under the rules and constraints of `ruleset`."""

    def __init__(self, ruleset: Ruleset, requirements: Requirements) -> None:
        self._requirements = requirements
        self._compiled = CompiledRules(ruleset)

    def contradicts(
        self,
        triggers: Iterable[str],
        time: int,
        values: Mapping[str, Value],
        forbidden: Collection[Span] = (),
        required: Collection[Span] = (),
        happening: Iterable[str] = (),
    ) -> bool:
        """Whether the events `triggers`, with the responses that begin at this instant and those that they trigger,
        contradict each other, what is `forbidden`, `required` or `happening`, or a constraint."""
        literals = [Obligation(name) for name in sorted(triggers)]
        new_demands: list[Span] = []
        new_bans: list[Span] = []
        seen = {literal.name for literal in literals}
        waiting = [frozenset(seen)]
        while waiting:
            for _, _, responses in self._requirements.decided(waiting.pop(), frozenset(seen), values):
                for one in responses:
                    if one.start is None or one.instead is not None:
                        continue
                    name, negated, timing = one.obligation.name, one.obligation.negated, one.obligation.timing
                    span = Span(name, time + one.start, None if one.end is None else time + one.end)
                    if negated:
                        new_bans.append(span)
                    elif timing is None or not any(True for _ in timing.alternatives()):
                        new_demands.append(span)
                    if one.start == 0:
                        literals.append(Obligation(name, negated))
                        if not negated and name not in seen:
                            seen.add(name)
                            waiting.append(frozenset({name}))
        if any(ban.covers_all(demand, time) for demand in new_demands for ban in (*forbidden, *new_bans)):
            return True
        if any(ban.covers_all(demand, time) for demand in required for ban in new_bans):
            return True
        literals += [Obligation(ban.name, negated=True) for ban in forbidden if ban.covers(time)]
        literals += [Obligation(name) for name in happening]
        events = frozenset(literal.name for literal in literals if not literal.negated)
        return self._compiled.conflict(literals, Context(events, values))
