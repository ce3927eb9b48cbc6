"""The result of an audited mission, as a value that a worker can return."""

from __future__ import annotations

from typing import NamedTuple

from sleec_runtime.audit.coverage import Coverage
from sleec_runtime.audit.quantiles import Quantiles
from sleec_runtime.audit.response_times import ResponseTimes
from sleec_runtime.model import Rational
from sleec_verify.audit.record import Record


class MissionResult(NamedTuple):
    """The finished audit of the log at `path`.

    `records` are the listed deviations and problems, and `more` is the number of others of the same kinds. `first` and
    `last` are the times of the first and the last observation, in seconds; None without any. `entered`: the log has a
    domain.
    """

    path: str
    observations: int
    first: Rational | None
    last: Rational | None
    records: tuple[Record, ...]
    more: int
    coverage: Coverage
    response_times: ResponseTimes
    entered: bool


class Spread(NamedTuple):
    """Quantiles of some numbers: the minimum, the median, the 95th percentile and the maximum."""

    min: float
    median: float
    p95: float
    max: float


class Response(NamedTuple):
    """How long an obligation of a clause took: the seconds from its trigger, and the shares of its window."""

    rule: str
    clause: int
    obligation: str
    executed: int
    missed: int
    seconds: Spread | None
    shares: Spread | None


class UnauditedLog(NamedTuple):
    """A log that cannot be audited, with the reason and a hint."""

    path: str
    message: str
    hint: str | None = None


class AuditSummary(NamedTuple):
    """The results of the missions of one audit, and the tolerance in seconds."""

    missions: tuple[MissionResult, ...]
    tolerance: Rational

    @property
    def coverage(self) -> Coverage:
        """The coverage of all missions together."""
        total = Coverage()
        for mission in self.missions:
            total.add(mission.coverage)
        return total

    @property
    def responses(self) -> tuple[Response, ...]:
        """The response times of all missions together, by rule and clause."""
        total = ResponseTimes()
        for mission in self.missions:
            total.add(mission.response_times)
        return tuple(
            Response(*response, times.seconds.count, times.missed, _spread(times.seconds), _spread(times.shares))
            for response, times in sorted(total.by_response.items())
        )


def _spread(numbers: Quantiles) -> Spread | None:
    return Spread(*map(numbers.quantile, (0, 0.5, 0.95, 1))) if numbers.count else None
