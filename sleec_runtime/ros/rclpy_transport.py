"""The transport through rclpy, for nodes in a ROS 2 workspace (Humble and Jazzy).

rclpy is part of ROS 2 and is not on a package index. So tests run this module against a fake of the calls that it
makes; see docs/dds.md.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from sleec_runtime.ros.transport import LONGEST_CLOSE, Fields, Receive, Topic
from sleec_runtime.ros.transport_errors import TransportUnavailable, UnknownMessageType, WrongFields
from sleec_runtime.support.messages import represent

_LOG = logging.getLogger("sleec_runtime.ros")


class RclpyTransport:
    """A `Transport` through a node of rclpy. It calls subscribers in one thread of its own.

    `name` is the name of the ROS node, and `args` are its ROS arguments, such as ``["--ros-args", "-r", "__ns:=/a"]``.
    Without `args`, those of the command line count. Raises TransportUnavailable without rclpy, and for a name or
    arguments that ROS does not accept.
    """

    def __init__(self, name: str, args: Sequence[str] | None = None) -> None:
        try:
            import rclpy
            from rclpy.context import Context
            from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
        except ImportError as error:
            raise TransportUnavailable(
                "the package rclpy is missing", "source a ROS 2 workspace, as in `. /opt/ros/jazzy/setup.sh`"
            ) from error
        # A context of its own, so that the signal handlers of the program stay as they are.
        self._context = Context()
        what = f"the ROS node {represent(name)}"
        with _refusals(what):
            rclpy.init(args=None if args is None else list(args), context=self._context)
        try:
            with _refusals(what):
                self._node = rclpy.create_node(name, context=self._context)
        except TransportUnavailable:
            self._context.try_shutdown()
            raise
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._shutdown: type[BaseException] = ExternalShutdownException
        self._closed = False
        self._thread = threading.Thread(target=self._spin, name="sleec rclpy transport", daemon=True)
        self._thread.start()

    def publisher(self, topic: Topic) -> RclpyPublisher:
        """A publisher on `topic`. Raises UnknownMessageType and TransportUnavailable."""
        kind = _message_class(topic.type)
        with _refusals(f"topic {represent(topic.name)}"):
            return RclpyPublisher(self, kind, self._node.create_publisher(kind, topic.name, _qos(topic)))

    def subscribe(self, topic: Topic, receive: Receive) -> None:
        """Calls `receive` with each message. Raises UnknownMessageType and TransportUnavailable."""
        from rosidl_runtime_py.convert import message_to_ordereddict

        def deliver(message: Any) -> None:
            if not self._closed:
                try:
                    receive(message_to_ordereddict(message))
                except BaseException:  # noqa: BLE001 - the executor must continue
                    _LOG.exception("a subscriber of %s failed", topic.name)

        kind = _message_class(topic.type)
        with _refusals(f"topic {represent(topic.name)}"):
            self._node.create_subscription(kind, topic.name, deliver, _qos(topic))

    def close(self) -> None:
        self._closed = True
        self._context.try_shutdown()
        if self._thread is not threading.current_thread():
            self._thread.join(LONGEST_CLOSE)

    @property
    def closed(self) -> bool:
        return self._closed

    def _spin(self) -> None:
        try:
            self._executor.spin()
        except self._shutdown:
            pass
        finally:
            self._node.destroy_node()


class RclpyPublisher:
    """A `Publisher` through rclpy."""

    def __init__(self, transport: RclpyTransport, kind: Any, publisher: Any) -> None:
        self._transport = transport
        self._kind = kind
        self._publisher = publisher

    def publish(self, fields: Fields) -> None:
        """Sends a message. Fields that are not given have the default of their type. Raises WrongFields."""
        from rosidl_runtime_py.set_message import set_message_fields

        message = self._kind()
        try:
            set_message_fields(message, dict(fields))
        except (AssertionError, AttributeError, OverflowError, TypeError, ValueError) as error:
            raise WrongFields(f"the fields do not fit {self._kind.__name__}: {error}") from error
        if not self._transport.closed:
            self._publisher.publish(message)

    def subscription_count(self) -> int:
        """The number of subscriptions that discovery has found, in all processes."""
        return 0 if self._transport.closed else int(self._publisher.get_subscription_count())


@contextmanager
def _refusals(what: str) -> Iterator[None]:
    """Raises TransportUnavailable for a name or arguments that ROS does not accept."""
    from rclpy.exceptions import NameValidationException

    try:
        yield
    # The errors of the C library of ROS are RuntimeErrors.
    except (NameValidationException, RuntimeError) as error:
        raise TransportUnavailable(
            f"{what} cannot be created: {error}",
            "use letters, digits and underscores in names, and check the arguments after --ros-args",
        ) from error


def _message_class(name: str) -> Any:
    from rosidl_runtime_py.utilities import get_message

    try:
        return get_message(name)
    except (AttributeError, ModuleNotFoundError, ValueError) as error:
        raise UnknownMessageType(name, (), "install and source the ROS package that defines it") from error


def _qos(topic: Topic) -> Any:
    from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=topic.depth,
        reliability=ReliabilityPolicy.RELIABLE if topic.reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if topic.latched else DurabilityPolicy.VOLATILE,
    )
