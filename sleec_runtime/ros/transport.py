"""The interface between nodes and transports, which carry messages within a process, over DDS, or through ROS 2."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Protocol

from sleec_runtime.errors import WrongType

STRING = "std_msgs/msg/String"
EMPTY = "std_msgs/msg/Empty"

Fields = Mapping[str, object]
"""The fields of a message: plain values (str, bool, int, float, list, mapping)."""

LONGEST_CLOSE = 5.0
"""Seconds for which `close` waits for a call of `receive` in another thread."""

DEEPEST = 2**31 - 1
"""The highest `depth` of a topic."""

Receive = Callable[[Fields], object]
"""Gets the fields of each message of a topic."""


@dataclass(frozen=True)
class Topic:
    """A topic with its quality of service. It keeps the last `depth` messages.

    Raises WrongType for a `name` that is not printable text, and for a wrong `type` or `depth`.

    `type` is the ROS name of the message type. A subscriber that joins late gets the last `depth` messages of a
    `latched` topic (transient-local durability). Delivery is reliable. A subscriber that is not `reliable` also
    receives from publishers that are not (best effort), such as drivers of sensors.
    """

    name: str
    type: str = STRING
    latched: bool = False
    depth: int = 10
    reliable: bool = True

    def __post_init__(self) -> None:
        if not is_printable(self.name):
            raise WrongType("name", self.name, "the name of a topic, a printable text")
        if not is_printable(self.type):
            raise WrongType("type", self.type, "the name of a message type", 'as in "std_msgs/msg/String"')
        if type(self.depth) is not int or not 0 < self.depth <= DEEPEST:
            raise WrongType("depth", self.depth, f"a whole number from 1 to {DEEPEST:,}")


def is_printable(name: object) -> bool:
    """Whether a name is printable text."""
    return isinstance(name, str) and name.isprintable()


class Publisher(Protocol):
    """Publishes on one topic. Any thread may use it."""

    def publish(self, fields: Fields) -> None:
        """Sends a message. It calls no subscriber before it returns. Does nothing if the transport is closed."""
        ...


class Transport(Protocol):
    """Publishes and receives messages on topics. The nodes of a process may share one.

    A transport makes all its calls of `receive` in one thread at a time, in the order of arrival on each topic.
    """

    def publisher(self, topic: Topic) -> Publisher:
        """A publisher on `topic`."""
        ...

    def subscribe(self, topic: Topic, receive: Receive) -> None:
        """Calls `receive` with each message on `topic`, also with those of this transport. It makes no call within
        `subscribe` itself."""
        ...

    def close(self) -> None:
        """Ends all subscriptions. Waits up to `LONGEST_CLOSE` for a call of `receive` in another thread."""
        ...
