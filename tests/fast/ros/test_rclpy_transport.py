"""The transport through rclpy, against a strict fake of the calls that it makes."""

from __future__ import annotations

import sys
import threading
from queue import SimpleQueue

import pytest

from sleec_runtime.ros.rclpy_transport import RclpyTransport
from sleec_runtime.ros.transport import Topic
from sleec_runtime.ros.transport_errors import TransportUnavailable, UnknownMessageType, WrongFields
from tests.support.dds import PATIENCE
from tests.support.fake_rclpy import DurabilityPolicy, Node, ReliabilityPolicy
from tests.support.fake_rclpy import rclpy_nodes as rclpy_nodes


def test_messages_arrive_in_order_in_one_thread(rclpy_nodes: list[Node]) -> None:
    sender, receiver = RclpyTransport("sender"), RclpyTransport("receiver", ["--ros-args", "-r", "__ns:=/a"])
    assert [node.name for node in rclpy_nodes] == ["sender", "receiver"]
    assert [node.context.args for node in rclpy_nodes] == [None, ["--ros-args", "-r", "__ns:=/a"]]
    received: SimpleQueue[object] = SimpleQueue()
    threads = set()

    def receive(fields: object) -> None:
        threads.add(threading.current_thread())
        received.put(fields)
        if fields == {"data": "fail"}:
            raise RuntimeError("a subscriber that fails does not end the others")

    receiver.subscribe(Topic("/conditions"), receive)
    publisher = sender.publisher(Topic("/conditions"))
    assert publisher.subscription_count() == 1
    for text in ("fail", "a", "b"):
        publisher.publish({"data": text})
    publisher.publish({})
    assert [received.get(timeout=PATIENCE) for _ in range(4)] == [{"data": text} for text in ("fail", "a", "b", "")]
    assert len(threads) == 1
    receiver.close()
    receiver.close()
    sender.close()
    publisher.publish({"data": "too late"})
    assert publisher.subscription_count() == 0


def test_qos_is_that_of_the_topic(rclpy_nodes: list[Node]) -> None:
    transport = RclpyTransport("node")
    transport.publisher(Topic("/layers_update", latched=True, depth=1))
    transport.subscribe(Topic("/sensor", depth=5, reliable=False), print)
    (node,) = rclpy_nodes
    latched, (_, _, _, sensor) = node.publishers[0].qos_profile, Node.topics["/sensor"][0]
    assert (latched.depth, latched.reliability, latched.durability) == (
        1,
        ReliabilityPolicy.RELIABLE,
        DurabilityPolicy.TRANSIENT_LOCAL,
    )
    assert (sensor.depth, sensor.reliability, sensor.durability) == (
        5,
        ReliabilityPolicy.BEST_EFFORT,
        DurabilityPolicy.VOLATILE,
    )
    transport.close()


def test_a_subscriber_may_close_the_transport(rclpy_nodes: list[Node]) -> None:
    transport, closed = RclpyTransport("node"), threading.Event()

    def receive(fields: object) -> None:
        transport.close()
        closed.set()

    transport.subscribe(Topic("/stop"), receive)
    transport.publisher(Topic("/stop")).publish({"data": ""})
    assert closed.wait(PATIENCE)
    transport.close()


def test_wrong_fields_and_types_are_refused(rclpy_nodes: list[Node]) -> None:
    transport = RclpyTransport("node")
    publisher = transport.publisher(Topic("/conditions"))
    with pytest.raises(WrongFields, match="do not fit String: The 'data' field must be of type 'str'"):
        publisher.publish({"data": 5})
    with pytest.raises(WrongFields, match="text"):
        publisher.publish({"text": "x"})
    for name in ("my_msgs/msg/Grip", "String"):
        with pytest.raises(UnknownMessageType, match="source the ROS package"):
            transport.subscribe(Topic("/grip", name), print)
    transport.close()


def test_without_ros_the_error_says_what_to_source(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "rclpy", None)
    with pytest.raises(TransportUnavailable, match="source a ROS 2 workspace"):
        RclpyTransport("node")


def test_names_and_arguments_that_ros_does_not_accept_are_refused(rclpy_nodes: list[Node]) -> None:
    for name, args in (("my-robot", None), ("", None), ("1a", None), ("node", ["--ros-args", "-r"])):
        with pytest.raises(TransportUnavailable, match="cannot be created"):
            RclpyTransport(name, args)
    assert rclpy_nodes == []
    transport = RclpyTransport("node")
    for name in ("", "/", "/a b", "/1a", "/a-b"):
        with pytest.raises(TransportUnavailable, match="use letters, digits and underscores"):
            transport.publisher(Topic(name))
        with pytest.raises(TransportUnavailable, match="use letters, digits and underscores"):
            transport.subscribe(Topic(name), print)
    transport.close()
