"""The transport within a process: order, late subscribers, types, threads and the end."""

from __future__ import annotations

import threading

import pytest

from sleec_runtime.errors import SleecError
from sleec_runtime.ros.in_process import Network
from sleec_runtime.ros.transport import EMPTY, Fields, Topic

NEWS = Topic("/news", depth=2)
STATE = Topic("/state", latched=True, depth=2)


def test_messages_arrive_in_the_order_of_publication_also_at_the_publisher() -> None:
    network = Network()
    one, other = network.transport(), network.transport()
    seen: list[object] = []
    one.subscribe(NEWS, lambda fields: seen.append(("one", fields["data"])))
    other.subscribe(NEWS, lambda fields: seen.append(("other", fields["data"])))
    for number in range(3):
        one.publisher(NEWS).publish({"data": number})
    assert not seen
    assert network.deliver(2) == 2
    assert network.deliver() == 4
    assert seen == [(name, number) for number in range(3) for name in ("one", "other")]


def test_a_late_subscriber_gets_the_last_messages_of_a_latched_topic_only() -> None:
    network = Network()
    one, other = network.transport(), network.transport()
    for number in range(3):
        one.publisher(STATE).publish({"data": number})
        one.publisher(NEWS).publish({"data": number})
    other.publisher(STATE).publish({"data": "other"})
    seen: list[object] = []
    late = network.transport()
    for topic in (STATE, NEWS):
        late.subscribe(topic, lambda fields: seen.append(fields["data"]))
    assert network.deliver() == 3
    assert seen == [1, 2, "other"]
    one.close()
    network.transport().subscribe(STATE, lambda fields: seen.append(fields["data"]))
    assert network.deliver() == 1


def test_a_topic_has_one_type() -> None:
    transport = Network().transport()
    transport.publisher(NEWS)
    with pytest.raises(SleecError, match="/news has the type std_msgs/msg/String, not std_msgs/msg/Empty"):
        transport.subscribe(Topic("/news", EMPTY), print)


def test_a_closed_transport_neither_sends_nor_receives() -> None:
    network = Network()
    one, other = network.transport(), network.transport()
    publisher = one.publisher(NEWS)
    other.subscribe(NEWS, lambda fields: pytest.fail("received"))
    publisher.publish({"data": 1})
    other.close()
    publisher.publish({"data": 2})
    one.close()
    publisher.publish({"data": 3})
    assert network.deliver() == 0


def test_threads_deliver_in_order_and_outlive_a_subscriber_that_fails(caplog: pytest.LogCaptureFixture) -> None:
    network = Network(threads=True)
    one, other = network.transport(), network.transport()
    seen: list[tuple[object, threading.Thread]] = []
    done = threading.Event()

    def receive(fields: Fields) -> None:
        number = fields["data"]
        if number == 1:
            raise ValueError("once")
        seen.append((number, threading.current_thread()))
        if number == 3:
            done.set()

    other.subscribe(NEWS, receive)
    for number in range(4):
        one.publisher(NEWS).publish({"data": number})
    assert done.wait(20)
    assert [number for number, _ in seen] == [0, 2, 3]
    assert {thread for _, thread in seen}.isdisjoint({threading.current_thread()})
    assert "a subscriber failed" in caplog.text
    one.close()
    other.close()
