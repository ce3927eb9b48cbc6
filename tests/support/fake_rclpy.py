"""A fake of the calls of rclpy, rosidl_runtime_py and std_msgs that `RclpyTransport` makes, with their signatures.

The signatures are those of the documentation of Humble and Jazzy (https://docs.ros.org/en/humble/p/rclpy/ and
https://docs.ros.org/en/jazzy/p/rclpy/). Anything else is an error: an unknown argument, a node without an initialised
context, a message of another class, a value of another type, or a call after the shutdown.
"""

from __future__ import annotations

import enum
import re
import sys
import threading
from collections import OrderedDict, defaultdict
from collections.abc import Callable, Iterator
from queue import SimpleQueue
from types import ModuleType
from typing import Any

import pytest


class ExternalShutdownException(Exception):
    pass


class NameValidationException(Exception):
    """A wrong name of a node or topic. Its base is not ValueError."""


class HistoryPolicy(enum.Enum):
    KEEP_LAST = 1


class ReliabilityPolicy(enum.Enum):
    RELIABLE = 1
    BEST_EFFORT = 2


class DurabilityPolicy(enum.Enum):
    TRANSIENT_LOCAL = 1
    VOLATILE = 2


class QoSProfile:
    def __init__(
        self, *, history: HistoryPolicy, depth: int, reliability: ReliabilityPolicy, durability: DurabilityPolicy
    ) -> None:
        assert isinstance(depth, int)
        self.history = HistoryPolicy(history)
        self.depth = depth
        self.reliability = ReliabilityPolicy(reliability)
        self.durability = DurabilityPolicy(durability)


class Context:
    """A context, with the executor that waits for it."""

    def __init__(self) -> None:
        self.initialised = False
        self.ok = False
        self.args: list[str] | None = None
        self.work: SimpleQueue[Callable[[], object] | None] = SimpleQueue()

    def try_shutdown(self) -> None:
        assert self.initialised
        if self.ok:
            self.ok = False
            self.work.put(None)


def init(*, args: list[str] | None = None, context: Context | None = None) -> None:
    assert context is not None, "the default context would take over the signals"
    assert not context.initialised
    assert args is None or isinstance(args, list)
    if args and args[-1] == "-r":
        # An RCLError of the extension module.
        raise RuntimeError("Failed to parse ROS arguments: Couldn't parse trailing -r flag")
    context.initialised = context.ok = True
    context.args = args


def create_node(node_name: str, *, context: Context | None = None) -> Node:
    assert context is not None
    assert context.ok
    _validate(node_name, r"[A-Za-z_]\w*")
    return Node(node_name, context)


def _validate(name: str, form: str) -> None:
    if not re.fullmatch(form, name, re.ASCII):
        raise NameValidationException(f"Invalid name: '{name}'")


class Node:
    """A node. All nodes of a test see the topics of each other."""

    made: list[Node]
    topics: defaultdict[str, list[tuple[Node, type, Callable[[Any], object], QoSProfile]]]

    def __init__(self, name: str, context: Context) -> None:
        self.name = name
        self.context = context
        self.destroyed = False
        self.publishers: list[Publisher] = []
        self.made.append(self)

    def create_publisher(self, msg_type: type, topic: str, qos_profile: QoSProfile) -> Publisher:
        assert isinstance(qos_profile, QoSProfile)
        _validate(topic, r"(/?[A-Za-z_]\w*)+")
        self.publishers.append(Publisher(self, msg_type, topic, qos_profile))
        return self.publishers[-1]

    def create_subscription(
        self, msg_type: type, topic: str, callback: Callable[[Any], object], qos_profile: QoSProfile
    ) -> object:
        assert isinstance(qos_profile, QoSProfile)
        _validate(topic, r"(/?[A-Za-z_]\w*)+")
        self.topics[topic].append((self, msg_type, callback, qos_profile))
        return object()

    def destroy_node(self) -> None:
        assert not self.destroyed
        self.destroyed = True
        for subscriptions in self.topics.values():
            subscriptions[:] = [one for one in subscriptions if one[0] is not self]


class Publisher:
    def __init__(self, node: Node, msg_type: type, topic: str, qos_profile: QoSProfile) -> None:
        self.node = node
        self.msg_type = msg_type
        self.topic = topic
        self.qos_profile = qos_profile

    def publish(self, msg: object) -> None:
        assert self.node.context.ok
        if type(msg) is not self.msg_type:
            raise TypeError(f"Expected {self.msg_type}, got {type(msg)}")
        for node, kind, callback, _ in tuple(self.node.topics[self.topic]):
            if kind is self.msg_type:
                node.context.work.put(lambda callback=callback: callback(msg))  # type: ignore[misc]

    def get_subscription_count(self) -> int:
        return sum(kind is self.msg_type for _, kind, _, _ in self.node.topics[self.topic])


class SingleThreadedExecutor:
    def __init__(self, *, context: Context | None = None) -> None:
        assert context is not None
        assert context.ok
        self._context = context
        self._nodes: list[Node] = []

    def add_node(self, node: Node) -> bool:
        self._nodes.append(node)
        return True

    def spin(self) -> None:
        assert self._nodes
        assert threading.current_thread() is not threading.main_thread()
        while self._context.ok:
            call = self._context.work.get()
            if call is None:
                raise ExternalShutdownException
            # An error of a callback ends `spin`, as in rclpy.
            call()


class String:
    """std_msgs.msg.String, whose generated class checks the type of what is assigned."""

    def __init__(self) -> None:
        self._data = ""

    @property
    def data(self) -> str:
        return self._data

    @data.setter
    def data(self, value: str) -> None:
        assert isinstance(value, str), "The 'data' field must be of type 'str'"
        self._data = value


def get_message(identifier: str) -> type:
    if identifier.count("/") != 2:
        raise ValueError(f"Expected the full name of a message, got '{identifier}'")
    if identifier != "std_msgs/msg/String":
        raise ModuleNotFoundError(f"No module named '{identifier.partition('/')[0]}'")
    return String


def set_message_fields(msg: Any, values: dict[str, Any]) -> list[object]:
    assert type(values) is dict
    for name, value in values.items():
        getattr(msg, name)
        setattr(msg, name, value)
    return []


def message_to_ordereddict(msg: Any) -> OrderedDict[str, object]:
    return OrderedDict(data=msg.data)


MODULES = {
    "rclpy": (init, create_node),
    "rclpy.context": (Context,),
    "rclpy.exceptions": (NameValidationException,),
    "rclpy.executors": (ExternalShutdownException, SingleThreadedExecutor),
    "rclpy.qos": (DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy),
    "rosidl_runtime_py": (),
    "rosidl_runtime_py.convert": (message_to_ordereddict,),
    "rosidl_runtime_py.set_message": (set_message_fields,),
    "rosidl_runtime_py.utilities": (get_message,),
}


@pytest.fixture
def rclpy_nodes(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[Node]]:
    """Puts the fake in the place of rclpy. The nodes that were made, all of which must be destroyed at the end."""
    for name, members in MODULES.items():
        module = ModuleType(name)
        for member in members:
            setattr(module, member.__name__, member)
        monkeypatch.setitem(sys.modules, name, module)
    Node.made, Node.topics = [], defaultdict(list)
    yield Node.made
    assert all(node.destroyed for node in Node.made)
