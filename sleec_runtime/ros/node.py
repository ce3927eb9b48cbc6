"""Nodes: each receives messages, rejects malformed ones with a report, and continues."""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import TypeVar

from sleec_runtime.errors import SleecError, WrongType
from sleec_runtime.model import Rational, exact
from sleec_runtime.ros.message import Message
from sleec_runtime.ros.transport import Fields, Receive, Topic, Transport
from sleec_runtime.timed.clock import Cancel, Clock, Time
from sleec_runtime.timed.monotonic_clock import MonotonicClock

M = TypeVar("M", bound=Message)

OnProblem = Callable[[SleecError], object]
"""Gets each problem of a node."""

_LOG = logging.getLogger("sleec_runtime.ros")


def positive(seconds: float, name: str) -> float:
    """Raises WrongType for a number that is not above 0."""
    number = exact(seconds)
    if number is None or number <= 0:
        raise WrongType(name, seconds, "a number of seconds above 0")
    return seconds


class Node:
    """A node with a name. It logs each problem, and gives it to `on_problem`.

    `clock` measures heartbeats; the default is the clock of the computer. The transport belongs to the caller.
    """

    def __init__(
        self, name: str, transport: Transport, clock: Clock | None = None, on_problem: OnProblem | None = None
    ) -> None:
        self.name = name
        self.transport = transport
        self.closed = False
        self._own_clock = MonotonicClock() if clock is None else None
        self.clock: Clock = self._own_clock or clock  # type: ignore[assignment]
        self._on_problem = on_problem
        self._cancels: dict[Callable[[], object], Cancel] = {}

    def exact_time(self) -> Rational:
        """The time of the clock, as an exact number."""
        time = exact(self.clock.now())
        assert time is not None
        return time

    def listen(self, kind: type[M], receive: Callable[[M], object]) -> None:
        """Calls `receive` with each message of this kind."""
        self.subscribe(kind.topic, lambda fields: receive(kind.from_fields(fields)))

    def subscribe(self, topic: Topic, receive: Receive) -> None:
        """Calls `receive` with the fields of each message on `topic`."""

        def received(fields: Fields) -> None:
            if not self.closed:
                try:
                    receive(fields)
                except SleecError as error:
                    self.report(error, topic.name)

        self.transport.subscribe(topic, received)

    def sender(self, kind: type[M]) -> Callable[[M], None]:
        """A function that publishes messages of this kind. It reports what the transport cannot send."""
        publish = self.transport.publisher(kind.topic).publish

        def send(message: M) -> None:
            fields = message.to_fields()
            try:
                publish(fields)
            except SleecError as error:
                self.report(error, kind.topic.name)

        return send

    def every(self, seconds: float, call: Callable[[], object]) -> None:
        """Calls `call` each `seconds` until the node is closed. Raises WrongType for a number that is not above 0."""
        positive(seconds, "the time between two calls")
        self.repeat(lambda: self.clock.now() + seconds, call)

    def repeat(self, following: Callable[[], Time], call: Callable[[], object]) -> None:
        """Calls `call` at the time that `following` returns, and then again, until the node is closed."""

        def ring() -> None:
            if self.closed:
                return
            try:
                call()
            except SleecError as error:
                self.report(error)
            finally:
                self._cancels[call] = self.clock.wake(following(), ring)

        self._cancels[call] = self.clock.wake(following(), ring)

    def report(self, problem: SleecError, topic: str | None = None) -> None:
        """Logs a problem, and calls `on_problem`."""
        place = self.name if topic is None else f"{self.name}, {topic}"
        _LOG.warning("%s: %s", place, problem)
        if self._on_problem is not None:
            self._on_problem(problem)

    def close(self) -> None:
        """Ends the timers. Later messages have no effect."""
        self.closed = True
        for cancel in self._cancels.values():
            cancel()
        if self._own_clock is not None:
            self._own_clock.close()
