"""A transport with faults, for tests: it loses, repeats, delays and reorders messages."""

from __future__ import annotations

import threading
from collections import Counter
from dataclasses import dataclass
from functools import partial
from random import Random

from sleec_runtime.ros.transport import Fields, Publisher, Receive, Topic, Transport
from sleec_runtime.timed.clock import Clock


@dataclass(frozen=True)
class Faults:
    """The probability of each fault, for each message and subscriber. They are tried in this order.

    A delayed message arrives up to `longest_delay` seconds later. A reordered one arrives after the next message of the
    same topic.
    """

    drop: float = 0.0
    duplicate: float = 0.0
    delay: float = 0.0
    reorder: float = 0.0
    longest_delay: float = 1.0


class FaultyTransport:
    """Receives through another transport, with `faults`, which depend only on `seed` and the messages.

    `clock` measures delays. `counts` has the number of each fault, by its name.
    """

    def __init__(self, transport: Transport, faults: Faults, seed: int, clock: Clock) -> None:
        self.faults = faults
        self.counts: Counter[str] = Counter()
        self._transport = transport
        self._random = Random(seed)
        self._clock = clock
        self._lock = threading.RLock()
        self._closed = False

    def publisher(self, topic: Topic) -> Publisher:
        return self._transport.publisher(topic)

    def subscribe(self, topic: Topic, receive: Receive) -> None:
        self._transport.subscribe(topic, partial(self._receive, receive, []))

    def close(self) -> None:
        self._closed = True
        self._transport.close()

    def _receive(self, receive: Receive, held: list[Fields], fields: Fields) -> None:
        with self._lock:
            if self._occurs("drop"):
                return
            for _ in range(1 + self._occurs("duplicate")):
                if self._occurs("delay"):
                    at = self._clock.now() + self._random.uniform(0, self.faults.longest_delay)
                    self._clock.wake(at, partial(self._pass, receive, fields))
                elif self._occurs("reorder"):
                    held.append(fields)
                else:
                    late, held[:] = list(held), []
                    for one in (fields, *late):
                        self._pass(receive, one)

    def _occurs(self, fault: str) -> bool:
        occurs: bool = self._random.random() < getattr(self.faults, fault)
        self.counts[fault] += occurs
        return occurs

    def _pass(self, receive: Receive, fields: Fields) -> None:
        # Also called by the clock: a transport calls in one thread at a time.
        with self._lock:
            if not self._closed:
                receive(fields)
