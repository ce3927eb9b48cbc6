"""The transport over DDS. Other ROS 2 nodes in the same domain see its topics as their own."""

from __future__ import annotations

import atexit
import ctypes
import logging
import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from heapq import merge
from operator import itemgetter
from typing import TYPE_CHECKING

from sleec_runtime.concurrency.fork import renew_after_fork
from sleec_runtime.errors import WrongType
from sleec_runtime.model import LONGEST, exact
from sleec_runtime.ros.dds.cdr import decode, encode
from sleec_runtime.ros.dds.environment import (
    HIGHEST_DOMAIN,
    distribution_of_environment,
    domain_of_environment,
    refuse_unsecured_start,
)
from sleec_runtime.ros.dds.message_types import Message
from sleec_runtime.ros.dds.settling import SettlingMessages
from sleec_runtime.ros.dds.type_store import TypeStore
from sleec_runtime.ros.transport import LONGEST_CLOSE, Fields, Receive, Topic
from sleec_runtime.ros.transport_errors import MalformedMessage, TransportUnavailable

if TYPE_CHECKING:
    from sleec_runtime.ros.dds.participant import Participant, Reader, Writer

_LOG = logging.getLogger("sleec_runtime.ros")

LARGEST = (16 << 20) + 64
"""The size of the largest message that is accepted, in bytes, without another limit: a `LayersUpdate` has up to 16 MiB,
and its encoding adds a few bytes."""

LOOKS = 4
"""How often the transport looks for messages before it delivers those that it has found."""


class DdsTransport:
    """A `Transport` over DDS. It calls subscribers in one thread of its own.

    Messages on several topics that arrive together are delivered in the order in which they were sent, by the clocks of
    their senders.

    `domain` is the DDS domain; without it, ROS_DOMAIN_ID counts. `definitions` has the text of a `.msg` file for each
    message type that ROS itself does not have, such as `{"my_msgs/msg/Grip": "float64 force"}`. `limit` is the size
    of the largest message that is accepted, in bytes. Messages that are larger or malformed are logged and dropped.

    `settle` is for transports of nodes that only observe: each message waits for so many seconds, and for messages that
    were sent before it. So a recorder sees a trigger before what it leads to. The clocks of all senders must agree;
    those of one computer do.

    Raises TransportUnavailable without the extra `dds`, if DDS cannot start, or if the environment enforces SROS 2; and
    WrongType for a wrong `domain`, `limit` or `settle`.
    """

    def __init__(
        self,
        domain: int | None = None,
        *,
        definitions: Mapping[str, str] | None = None,
        limit: int = LARGEST,
        settle: float = 0,
    ) -> None:
        held = exact(settle)
        if held is None or not 0 <= held <= LONGEST:
            raise WrongType("settle", settle, f"a number of seconds from 0 to {LONGEST:,}")
        if type(limit) is not int or limit < 1:
            raise WrongType("limit", limit, "a number of bytes from 1 on")
        if domain is not None and (type(domain) is not int or not 0 <= domain <= HIGHEST_DOMAIN):
            raise WrongType("domain", domain, f"a whole number from 0 to {HIGHEST_DOMAIN}")
        try:
            from sleec_runtime.ros.dds.participant import Participant
        except ImportError as error:
            raise TransportUnavailable(
                "the DDS transport needs the package cyclonedds", "install `sleec-runtime[dds]`"
            ) from error
        refuse_unsecured_start()
        self._types = TypeStore(distribution_of_environment(), definitions or {})
        self._limit = limit
        self._settle = float(held)
        self._lock = threading.Lock()
        self._publishers: list[DdsPublisher] = []
        self._subscriptions: tuple[_Subscription, ...] = ()
        self._forked = False
        self._participant: Participant | None = Participant(domain_of_environment() if domain is None else domain)
        self._thread = threading.Thread(
            target=self._deliver, args=(self._participant,), name="sleec DDS transport", daemon=True
        )
        self._thread.start()
        atexit.register(self.close)
        renew_after_fork(self)

    def publisher(self, topic: Topic) -> DdsPublisher:
        """A publisher on `topic`. Raises UnknownMessageType, InvalidDefinition or TransportUnavailable."""
        message = self._types.message(topic.type)
        with self._lock:
            publisher = DdsPublisher(message, self._open().writer(topic, message))
            self._publishers.append(publisher)
        return publisher

    def subscribe(self, topic: Topic, receive: Receive) -> None:
        """Calls `receive` with each message. Raises the same as `publisher`."""
        message = self._types.message(topic.type)
        with self._lock:
            reader = self._open().reader(topic, message)
            self._subscriptions += (_Subscription(topic, message, reader, receive, self._limit),)

    def close(self) -> None:
        with self._lock:
            participant, self._participant = self._participant, None
            for publisher in self._publishers:
                publisher.end()
        if participant is None:
            return
        atexit.unregister(self.close)
        participant.wake()
        if self._thread is not threading.current_thread():
            self._thread.join(LONGEST_CLOSE)
        self._subscriptions = ()

    def after_fork(self) -> None:
        """Ends the transport in a forked process, which must not call DDS: it has neither the threads of DDS, nor its
        locks in a known state."""
        self._lock = threading.Lock()
        if self._participant is not None:
            # Never freed, because cyclonedds calls DDS when an object of its own is freed.
            owners = (self._participant, [publisher.end(forked=True) for publisher in self._publishers])
            ctypes.pythonapi.Py_IncRef(ctypes.py_object((owners, self._subscriptions)))
            self._participant = None
            self._forked = True

    def _open(self) -> Participant:
        if self._participant is None:
            raise _forked() if self._forked else TransportUnavailable("the DDS transport is closed", "open a new one")
        return self._participant

    def _deliver(self, participant: Participant) -> None:
        """Delivers messages until the transport is closed."""
        settling: SettlingMessages[_Sent] = SettlingMessages(self._settle)
        while True:
            ready = participant.wait(settling.remaining())
            if self._participant is None:
                return
            messages = self._take(participant, ready)
            if not messages and not ready:
                for subscription in self._subscriptions:
                    subscription.report_incompatible_writers()
            if self._settle:
                for message in messages:
                    settling.add(message[0], message)
                messages = settling.take()
            for _, subscription, data in messages:
                if self._participant is None:
                    return
                subscription.deliver(data)

    def _take(self, participant: Participant, ready: set[Reader]) -> Sequence[_Sent]:
        """The messages that have arrived on all topics, in the order in which they were sent. It looks again until
        there are no more, because a message may have arrived earlier than one that it has seen already."""
        taken: dict[int, list[_Sent]] = {}
        for _ in range(LOOKS):
            if not ready:
                break
            for number, subscription in enumerate(self._subscriptions):
                if subscription.reader in ready:
                    sent = [(time, subscription, data) for time, data in subscription.reader.take()]
                    taken.setdefault(number, []).extend(sent)
            ready = participant.ready()
        # Messages on one topic stay in the order in which they arrived.
        return list(merge(*taken.values(), key=itemgetter(0)))


class DdsPublisher:
    """A `Publisher` over DDS."""

    def __init__(self, message: Message, writer: Writer) -> None:
        self._message = message
        self._writer: Writer | None = writer
        self._forked = False

    def publish(self, fields: Fields) -> None:
        """Sends a message. Fields that are not given are 0, false or empty.

        Raises WrongFields, and TransportUnavailable in a forked process or if a receiver does not keep up.
        """
        data = encode(self._message, fields)
        writer = self._writer
        if writer is not None:
            writer.write(data)
        elif self._forked:
            raise _forked()

    def subscription_count(self) -> int:
        """The number of subscriptions that discovery has found, in all processes."""
        return 0 if self._writer is None else self._writer.reader_count()

    def end(self, forked: bool = False) -> Writer | None:
        """Releases the writer, and returns it."""
        writer, self._writer = self._writer, None
        self._forked = forked
        return writer


@dataclass(frozen=True)
class _Subscription:
    topic: Topic
    message: Message
    reader: Reader
    receive: Receive
    limit: int

    def deliver(self, data: bytes) -> None:
        """Delivers a message."""
        fields = self._fields(data)
        if fields is not None:
            try:
                self.receive(fields)
            except BaseException:  # noqa: BLE001 - the thread must continue
                _LOG.exception("a subscriber of %s failed", self.topic.name)

    def report_incompatible_writers(self) -> None:
        """Logs that a publisher has appeared whose messages this subscription cannot receive."""
        reason = self.reader.incompatibility()
        if reason is not None:
            _LOG.error("a publisher of %s is not received: %s", self.topic.name, reason)

    def _fields(self, data: bytes) -> Fields | None:
        if len(data) > self.limit:
            problem = f"it has {len(data):,} bytes, more than the limit of {self.limit:,}"
        else:
            try:
                return decode(self.message, data)
            except MalformedMessage as error:
                problem = error.message
        _LOG.error("a message on %s is dropped: %s", self.topic.name, problem)
        return None


_Sent = tuple[int, _Subscription, bytes]
"""A message with the time at which it was sent."""


def _forked() -> TransportUnavailable:
    return TransportUnavailable(
        "a DDS transport cannot be used in a forked process", "open the transport in the process that uses it"
    )
