"""The clock of a scenario: a virtual clock on which acts come before the alarms of the same time."""

from __future__ import annotations

from math import floor

from sleec_runtime import VirtualClock
from sleec_runtime.timed.clock import Time


class ScenarioClock(VirtualClock):
    """A virtual clock for a test, which decides what comes first at one time.

    A window closes at its last instant, and a report at that instant is in time only if it comes before the clock. So
    a test first goes to that time with `arrive`, reports, and then lets the alarms go off with ``advance(0)``.
    """

    def next_alarm(self) -> Time | None:
        """The time of the next alarm."""
        return self._alarms.earliest()

    def arrive(self, at: Time) -> None:
        """Moves to the time `at`. No alarm may be set before it."""
        self._now = max(self._now, at)


def second(time: Time) -> int:
    """The second to which a time belongs."""
    return floor(time)
