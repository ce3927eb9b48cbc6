"""Until when the rules require each event: an execution after that was not required.

A robot may execute an obligation more than once while its window is open, for example once for each rule.
"""

from __future__ import annotations

from collections.abc import Sequence

from sleec_runtime.audit.duty import Duty
from sleec_runtime.evaluation.trace import Untimed
from sleec_runtime.model import Rational, Rule, literals


class Permissions:
    """The latest end of the windows that required each event; None if it has no end."""

    def __init__(self, tolerance: Rational, untimed: Untimed) -> None:
        self.tolerance = tolerance
        self.untimed = untimed
        self.until: dict[str, Rational | None] = {}

    def permits(self, event: str, now: Rational, ends: Sequence[Rational | None]) -> bool:
        """Whether a rule requires `event` now. `ends` are those of the open windows that require it."""
        for end in ends:
            self._extend(event, end)
        if event not in self.until:
            return False
        until = self.until[event]
        return until is None or now <= until

    def end(self, duty: Duty) -> None:
        """Records the ends of the windows of a settled duty that were met or missed."""
        for due in duty.task.dues():
            if due.met is not None and not due.obligation.negated:
                self._extend(due.obligation.name, None if due.last is None else due.last + self.tolerance)

    def permit_all(self, rule: Rule, now: Rational) -> None:
        """Permits all that a rule may require if it is triggered now, because what it requires is unknown."""
        horizon = self._horizon(rule)
        for clause in rule.clauses():
            for obligation in literals(clause):
                self._extend(obligation.name, None if horizon is None else now + horizon + self.tolerance)

    def _horizon(self, rule: Rule) -> Rational | None:
        """The seconds after the trigger in which a rule may require something; None if they have no bound. An
        alternative follows the window before it, so the sum of all windows is enough."""
        total: Rational = 0
        for clause in rule.clauses():
            for obligation in literals(clause):
                window = None if obligation.timing is None else obligation.timing.window
                if window is None:
                    seconds: Rational | None = 0 if self.untimed == "at" else None
                else:
                    seconds = None if window.end is None else window.end.seconds
                if seconds is None:
                    return None
                total += max(seconds, 0)
        return total

    def _extend(self, event: str, end: Rational | None) -> None:
        before = self.until.get(event, end)
        self.until[event] = None if end is None or before is None else max(before, end)
