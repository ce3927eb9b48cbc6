"""Nodes: each receives messages, rejects malformed ones with a report, and continues."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeVar
from weakref import ReferenceType, WeakKeyDictionary, ref

from sleec_runtime.errors import SleecError, WrongType
from sleec_runtime.facade.host import Host
from sleec_runtime.model import LONGEST, Rational, exact
from sleec_runtime.ros.message import Message
from sleec_runtime.ros.transport import Fields, Receive, Topic, Transport, is_printable
from sleec_runtime.timed.clock import Cancel, Clock, Time, checked_time
from sleec_runtime.timed.failures import raise_interrupt
from sleec_runtime.timed.monotonic_clock import MonotonicClock

M = TypeVar("M", bound=Message)

OnProblem = Callable[[SleecError], object]
"""Gets each problem of a node."""

_LOG = logging.getLogger("sleec_runtime.ros")

_OWNERS: WeakKeyDictionary[Host, ReferenceType[Node]] = WeakKeyDictionary()
"""The node that had each `Sleec` last."""

SHORTEST = 0.001
"""The shortest time that a node measures, in seconds. Calls at shorter intervals would leave no time for messages."""


def seconds_of(value: float, name: str) -> float:
    """A length of time as a float, with which any clock can calculate. Raises WrongType for one that is not from
    `SHORTEST` to `LONGEST`."""
    number = exact(value)
    if number is None or not 0 < number <= LONGEST or float(number) < SHORTEST:
        raise WrongType(name, value, f"a number of seconds from {SHORTEST} to {LONGEST:,}")
    return float(number)


class Node:
    """A node with a name. It logs each problem, and gives it to `on_problem`.

    `clock` measures heartbeats; the default is the clock of the computer. The transport belongs to the caller. Raises
    WrongType for a `name` that is not printable text.
    """

    def __init__(
        self, name: str, transport: Transport, clock: Clock | None = None, on_problem: OnProblem | None = None
    ) -> None:
        if not is_printable(name):
            raise WrongType("name", name, "the name of the node, a printable text")
        self.name = name
        self.transport = transport
        self.closed = False
        self._own_clock = MonotonicClock() if clock is None else None
        self.clock: Clock = self._own_clock or clock  # type: ignore[assignment]
        self._on_problem = on_problem
        self._cancels: dict[Callable[[], object], Cancel] = {}

    @contextmanager
    def starting(self) -> Iterator[None]:
        """Closes the node if the block raises, so that no half of a node takes messages."""
        try:
            yield
        except BaseException:
            self.close()
            raise

    def own(self, sleec: Host) -> None:
        """Takes `sleec` for this node. Raises SleecError if another node has it: each would change the context and the
        code of the other."""
        last = _OWNERS.get(sleec)
        owner = None if last is None else last()
        if owner is not None and not owner.closed:
            raise SleecError(
                f"node `{self.name}` has the same Sleec as node `{owner.name}`", "load the rules again for each node"
            )
        _OWNERS[sleec] = ref(self)

    def exact_time(self) -> Rational:
        """The time of the clock, as an exact number. Raises WrongType for a time out of bounds."""
        time = exact(checked_time(self.clock.now()))
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
        """Calls `call` each `seconds` until the node is closed. Raises as `seconds_of`."""
        period = seconds_of(seconds, "the time between two calls")
        self.repeat(lambda: self.clock.now() + period, call)

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
        """Logs a problem, and calls `on_problem`. The node continues if that fails."""
        place = self.name if topic is None else f"{self.name}, {topic}"
        _LOG.warning("%s: %s", place, problem)
        if self._on_problem is not None:
            try:
                self._on_problem(problem)
            except BaseException as error:  # noqa: BLE001 - logged
                _LOG.exception("%s: on_problem failed", self.name)
                raise_interrupt(error)

    def close(self) -> None:
        """Ends the timers. Later messages have no effect."""
        self.closed = True
        for cancel in self._cancels.values():
            cancel()
        if self._own_clock is not None:
            self._own_clock.close()
