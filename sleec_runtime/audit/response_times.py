"""Response times: how long each obligation took, and how much of its window."""

from __future__ import annotations

from typing import NamedTuple

from sleec_runtime.audit.duty import Duty
from sleec_runtime.audit.quantiles import Quantiles


class Response(NamedTuple):
    """An obligation of a clause of a rule."""

    rule: str
    clause: int
    obligation: str


class Times:
    """The response times of one obligation: the `seconds` from the trigger, or from the end of the window that the
    obligation replaces. `shares` are the parts of the window that they took, and `missed` counts missed windows."""

    def __init__(self) -> None:
        self.seconds = Quantiles()
        self.shares = Quantiles()
        self.missed = 0

    def add(self, other: Times) -> None:
        """Adds the times of another mission."""
        self.seconds.add(other.seconds)
        self.shares.add(other.shares)
        self.missed += other.missed


class ResponseTimes:
    """The response times of a mission, by obligation."""

    def __init__(self) -> None:
        self.by_response: dict[Response, Times] = {}

    def record(self, duty: Duty) -> None:
        """Records the obligations of a settled duty."""
        decision = duty.triggered.decision
        assert decision is not None
        for due in duty.task.dues():
            if due.obligation.negated or due.met is None or due.at is None:
                continue
            response = Response(duty.triggered.rule, decision.clause, due.obligation.name)
            times = self.by_response.setdefault(response, Times())
            if not due.met:
                times.missed += 1
                continue
            times.seconds.insert(float(due.at - due.since))
            if due.last is not None and due.last > due.since:
                times.shares.insert(float((due.at - due.since) / (due.last - due.since)))

    def add(self, other: ResponseTimes) -> None:
        """Adds the times of another mission."""
        for response, times in other.by_response.items():
            self.by_response.setdefault(response, Times()).add(times)
