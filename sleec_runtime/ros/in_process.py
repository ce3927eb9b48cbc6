"""The transport within a process, for tests, simulations and robots of one process."""

from __future__ import annotations

import logging
import threading
from collections import defaultdict, deque
from collections.abc import Callable
from functools import partial
from queue import SimpleQueue

from sleec_runtime.errors import SleecError
from sleec_runtime.ros.transport import LONGEST_CLOSE, Fields, Receive, Topic

_LOG = logging.getLogger("sleec_runtime.ros")

Call = Callable[[], object]


class Network:
    """A network of transports in this process.

    With `threads`, each transport has a thread that delivers its messages. Without, `deliver` delivers them, in the
    order in which they were published: tests are then deterministic.
    """

    def __init__(self, threads: bool = False) -> None:
        self._threads = threads
        self._lock = threading.Lock()
        self._queue: deque[tuple[InProcessTransport, Call]] = deque()
        self._subscribers: defaultdict[str, list[tuple[InProcessTransport, Receive]]] = defaultdict(list)
        self._latched: dict[str, dict[InProcessTransport, deque[Fields]]] = {}
        self._types: dict[str, str] = {}

    def transport(self) -> InProcessTransport:
        """A new transport on this network. Close it at the end."""
        return InProcessTransport(self, self._threads)

    def deliver(self, limit: int | None = None) -> int:
        """Delivers the messages that are queued, and those that this leads to, but at most `limit`. Returns their
        number. For a network without threads."""
        count = 0
        while self._queue and count != limit:
            transport, call = self._queue.popleft()
            if not transport.closed:
                call()
                count += 1
        return count

    def publish(self, publisher: InProcessTransport, topic: Topic, fields: Fields) -> None:
        """Queues a message for all subscribers of the topic."""
        with self._lock:
            if topic.latched:
                kept = self._latched.setdefault(topic.name, {})
                kept.setdefault(publisher, deque(maxlen=topic.depth)).append(fields)
            for transport, receive in self._subscribers[topic.name]:
                self._enqueue(transport, partial(receive, fields))

    def subscribe(self, transport: InProcessTransport, topic: Topic, receive: Receive) -> None:
        """Adds a subscriber, and queues for it the messages that publishers keep for a latched topic."""
        with self._lock:
            self._subscribers[topic.name].append((transport, receive))
            for kept in self._latched.get(topic.name, {}).values() if topic.latched else ():
                for fields in kept:
                    self._enqueue(transport, partial(receive, fields))

    def admit(self, topic: Topic) -> None:
        """Raises SleecError if the topic is in use with another type."""
        with self._lock:
            known = self._types.setdefault(topic.name, topic.type)
        if known != topic.type:
            raise SleecError(f"topic {topic.name} has the type {known}, not {topic.type}", "use one type for a topic")

    def leave(self, transport: InProcessTransport) -> None:
        """Removes the subscribers of a transport, and the messages that it keeps."""
        with self._lock:
            for kept in self._latched.values():
                kept.pop(transport, None)
            for subscribers in self._subscribers.values():
                subscribers[:] = [one for one in subscribers if one[0] is not transport]

    def _enqueue(self, transport: InProcessTransport, call: Call) -> None:
        if transport.inbox is None:
            self._queue.append((transport, call))
        else:
            transport.inbox.put(call)


class InProcessTransport:
    """A `Transport` on a `Network`. It passes the fields of a message as they are."""

    def __init__(self, network: Network, threads: bool) -> None:
        self._network = network
        self.closed = False
        self.inbox: SimpleQueue[Call | None] | None = SimpleQueue() if threads else None
        self._thread: threading.Thread | None = None
        if self.inbox is not None:
            self._thread = threading.Thread(target=self._run, args=(self.inbox,), name="sleec transport", daemon=True)
            self._thread.start()

    def publisher(self, topic: Topic) -> InProcessPublisher:
        self._network.admit(topic)
        return InProcessPublisher(self, self._network, topic)

    def subscribe(self, topic: Topic, receive: Receive) -> None:
        self._network.admit(topic)
        self._network.subscribe(self, topic, receive)

    def close(self) -> None:
        self.closed = True
        self._network.leave(self)
        if self.inbox is not None and self._thread is not None:
            self.inbox.put(None)
            if self._thread is not threading.current_thread():
                self._thread.join(LONGEST_CLOSE)

    def _run(self, inbox: SimpleQueue[Call | None]) -> None:
        while (call := inbox.get()) is not None:
            if self.closed:
                continue
            try:
                call()
            except BaseException:  # noqa: BLE001 - logged
                _LOG.exception("a subscriber failed")


class InProcessPublisher:
    """A `Publisher` on a `Network`."""

    def __init__(self, transport: InProcessTransport, network: Network, topic: Topic) -> None:
        self._transport = transport
        self._network = network
        self._topic = topic

    def publish(self, fields: Fields) -> None:
        if not self._transport.closed:
            self._network.publish(self._transport, self._topic, fields)
