"""The transport over DDS in one process: delivery, names and QoS on the wire, bad messages, and the end."""

from __future__ import annotations

import threading
import time
from importlib import import_module
from queue import SimpleQueue
from typing import Any

import pytest

from sleec_runtime.errors import SleecError
from sleec_runtime.ros.dds.cdr import encode
from sleec_runtime.ros.dds.message_types import STANDARD
from sleec_runtime.ros.dds.transport import DdsTransport
from sleec_runtime.ros.messages import LayersUpdate
from sleec_runtime.ros.transport import Topic
from sleec_runtime.ros.transport_errors import TransportUnavailable, WrongFields
from tests.support.dds import PATIENCE, eventually, require_dds, unused_domain, unused_topic
from tests.support.dds import transports as transports

require_dds()


class Inbox:
    """The messages that a subscriber receives."""

    def __init__(self) -> None:
        self._queue: SimpleQueue[object] = SimpleQueue()

    def receive(self, fields: object) -> None:
        self._queue.put(fields)

    def next(self) -> object:
        return self._queue.get(timeout=PATIENCE)


def test_messages_arrive_in_order_in_one_thread(transports) -> None:
    sender, receiver = transports(), transports()
    topic, inbox, threads = Topic(unused_topic(), depth=100), Inbox(), set()

    def receive(fields):
        threads.add(threading.current_thread())
        inbox.receive(fields)

    receiver.subscribe(topic, receive)
    sender.subscribe(topic, receive)
    publisher = sender.publisher(topic)
    assert eventually(lambda: publisher.subscription_count() == 2)
    for number in range(50):
        publisher.publish({"data": f"Grüße {number}"})
    numbers = sorted(str(inbox.next()) for _ in range(100))
    assert numbers == sorted(str({"data": f"Grüße {number}"}) for number in range(50) for _ in range(2))
    assert len(threads) == 2
    assert threading.current_thread() not in threads


def test_messages_on_several_topics_arrive_in_the_order_in_which_they_were_sent(transports) -> None:
    """A process that was not scheduled for a while gets the context before the triggers that followed it."""
    first, second, start = (Topic(unused_topic(), depth=100) for _ in range(3))
    receiver, started, may_continue = transports(), threading.Event(), threading.Event()
    inbox = Inbox()

    def block(fields):
        started.set()
        may_continue.wait(PATIENCE)

    receiver.subscribe(first, inbox.receive)
    receiver.subscribe(second, inbox.receive)
    receiver.subscribe(start, block)
    sender = transports()
    publishers = [sender.publisher(topic) for topic in (second, first, start)]
    assert eventually(lambda: all(publisher.subscription_count() for publisher in publishers))
    publishers[2].publish({"data": "block"})
    assert started.wait(PATIENCE)
    for number in range(20):
        publishers[number % 2].publish({"data": str(number)})
    may_continue.set()
    assert [inbox.next() for _ in range(20)] == [{"data": str(number)} for number in range(20)]


def test_an_observer_waits_for_what_was_sent_before(transports) -> None:
    """The message of the first topic arrives late, as after a hop of its own."""
    first, second, inbox = Topic(unused_topic()), Topic(unused_topic()), Inbox()
    observer, sender = transports(settle=1.0), transports()
    observer.subscribe(second, inbox.receive)
    observer.subscribe(first, inbox.receive)
    publishers = [sender.publisher(topic) for topic in (first, second)]
    assert eventually(lambda: all(publisher.subscription_count() for publisher in publishers))
    writer = publishers[0]._writer
    early = time.time_ns()
    publishers[1].publish({"data": "effect"})
    data = encode(STANDARD[first.type], {"data": "cause"})
    writer._writer.write(writer._samples(data), timestamp=early)
    assert [inbox.next(), inbox.next()] == [{"data": "cause"}, {"data": "effect"}]


def test_types_of_ros_arrive_as_plain_values(transports) -> None:
    transport, inbox = transports(definitions={"my_msgs/msg/Grip": "float32[2] forces\nbool closed"}), Inbox()
    battery = Topic(unused_topic(), "sensor_msgs/msg/BatteryState", latched=True)
    grip = Topic(unused_topic(), "my_msgs/msg/Grip", latched=True)
    transport.publisher(battery).publish({"percentage": 0.25, "header": {"frame_id": "base"}, "cell_voltage": [1, 2]})
    transport.publisher(grip).publish({"forces": [0.5, 1]})
    transport.subscribe(battery, inbox.receive)
    received = inbox.next()
    assert isinstance(received, dict)
    assert received["percentage"] == 0.25
    assert received["header"] == {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": "base"}
    assert received["cell_voltage"] == [1.0, 2.0]
    transport.subscribe(grip, inbox.receive)
    assert inbox.next() == {"forces": [0.5, 1.0], "closed": False}


def test_a_late_joiner_gets_the_last_messages_of_a_latched_topic(transports) -> None:
    topic, inbox = Topic(unused_topic(), latched=True, depth=2), Inbox()
    publisher = transports().publisher(topic)
    for text in "abc":
        publisher.publish({"data": text})
    transports().subscribe(topic, inbox.receive)
    assert [inbox.next(), inbox.next()] == [{"data": "b"}, {"data": "c"}]


def test_names_and_qos_on_the_wire_are_those_of_ros_2(transports) -> None:
    from cyclonedds.builtin import BuiltinDataReader, BuiltinTopicDcpsPublication, BuiltinTopicDcpsSubscription
    from cyclonedds.domain import DomainParticipant
    from cyclonedds.qos import Policy

    transport = transports()
    conditions = Topic(unused_topic(), depth=7)
    layers = Topic(unused_topic(), "std_msgs/msg/Empty", latched=True, depth=1)
    transport.publisher(conditions)
    transport.publisher(layers)
    transport.subscribe(conditions, print)
    participant = DomainParticipant(unused_domain())
    for builtin, kinds in ((BuiltinTopicDcpsPublication, 2), (BuiltinTopicDcpsSubscription, 1)):
        reader = BuiltinDataReader(participant, builtin)
        found: dict[str, Any] = {}

        def discovered(reader=reader, found=found, kinds=kinds):
            for one in reader.take(N=100):
                if one.topic_name in (f"rt{conditions.name}", f"rt{layers.name}"):
                    found[one.topic_name] = one
            return len(found) == kinds

        assert eventually(discovered)
        one = found[f"rt{conditions.name}"]
        assert one.type_name == "std_msgs::msg::dds_::String_"
        assert Policy.Durability.Volatile in one.qos
        assert isinstance(one.qos[Policy.Reliability], Policy.Reliability.Reliable)
        if kinds == 2:
            latched = found[f"rt{layers.name}"]
            assert latched.type_name == "std_msgs::msg::dds_::Empty_"
            assert Policy.Durability.TransientLocal in latched.qos
            assert isinstance(latched.qos[Policy.Reliability], Policy.Reliability.Reliable)


def test_a_program_with_types_of_its_own_takes_part(transports) -> None:
    """It stands for other ROS 2 nodes, and uses the classes and the serialiser of cyclonedds."""
    from cyclonedds.domain import DomainParticipant
    from cyclonedds.idl import make_idl_struct
    from cyclonedds.pub import DataWriter
    from cyclonedds.qos import Policy, Qos
    from cyclonedds.sub import DataReader
    from cyclonedds.topic import Topic as DdsTopic

    # cyclonedds computes its types in ways that mypy cannot follow.
    types: Any = import_module("cyclonedds.idl.types")
    struct: Any = make_idl_struct
    stamp = struct("Time_", "builtin_interfaces.msg.dds_.Time_", {"sec": types.int32, "nanosec": types.uint32})
    header = struct("Header_", "std_msgs.msg.dds_.Header_", {"stamp": stamp, "frame_id": str})
    joints = struct(
        "JointState_",
        "sensor_msgs.msg.dds_.JointState_",
        {"header": header, "name": types.sequence[str]}
        | dict.fromkeys(("position", "velocity", "effort"), types.sequence[types.float64]),
    )
    topic, inbox = Topic(unused_topic(), "sensor_msgs/msg/JointState", latched=True), Inbox()
    participant = DomainParticipant(unused_domain())
    theirs = DdsTopic(participant, f"rt{topic.name}", joints)
    qos = Qos(Policy.Reliability.Reliable(10**9), Policy.Durability.TransientLocal, Policy.History.KeepLast(9))
    sent = joints(header(stamp(5, 7), "arm"), ["wrist"], [0.25], [], [1.5, -2.0])
    writer = DataWriter(participant, theirs, qos)
    writer.write(sent)
    transport = transports()
    transport.subscribe(topic, inbox.receive)
    fields = {
        "header": {"stamp": {"sec": 5, "nanosec": 7}, "frame_id": "arm"},
        "name": ["wrist"],
        "position": [0.25],
        "velocity": [],
        "effort": [1.5, -2.0],
    }
    assert inbox.next() == fields
    transport.publisher(topic).publish({**fields, "velocity": [3]})
    reader = DataReader(participant, theirs, qos)
    received: list[Any] = []

    def answered() -> bool:
        received.extend(reader.take(10))
        return any(one.velocity for one in received)

    assert eventually(answered)
    (answer,) = [one for one in received if one.velocity]
    assert (answer.header.frame_id, answer.name, answer.velocity) == ("arm", ["wrist"], [3.0])


def test_the_longest_message_of_a_node_arrives(transports) -> None:
    topic, inbox = LayersUpdate.topic, Inbox()
    sender, receiver = transports(), transports()
    text = "x" * LayersUpdate.max_size
    sender.publisher(topic).publish({"data": text})
    receiver.subscribe(topic, inbox.receive)
    assert inbox.next() == {"data": text}


def test_bad_messages_are_logged_and_dropped(transports, caplog: pytest.LogCaptureFixture) -> None:
    from cyclonedds.domain import DomainParticipant
    from cyclonedds.pub import DataWriter
    from cyclonedds.qos import Policy, Qos
    from cyclonedds.topic import Topic as DdsTopic

    from sleec_runtime.ros.dds.idl_types import serialized_type

    topic, inbox = Topic(unused_topic()), Inbox()
    transport = transports(limit=100)

    def receive(fields):
        if fields == {"data": "fail"}:
            raise RuntimeError("the subscriber is broken")
        inbox.receive(fields)

    transport.subscribe(topic, receive)
    strings = serialized_type(STANDARD[topic.type])
    participant = DomainParticipant(unused_domain())
    writer = DataWriter(
        participant, DdsTopic(participant, f"rt{topic.name}", strings), Qos(Policy.Reliability.Reliable(10**9))
    )
    publisher = transport.publisher(topic)
    assert eventually(lambda: publisher.subscription_count() and writer.get_matched_subscriptions())
    writer.write(strings(b"\0\1\0\0\2\0\0\0\xff\0\0\0"))
    publisher.publish({"data": "x" * 100})
    publisher.publish({"data": "fail"})
    publisher.publish({"data": "good"})
    assert inbox.next() == {"data": "good"}
    assert eventually(lambda: "is dropped: a text is not UTF-8" in caplog.text)
    assert f"a message on {topic.name} is dropped: it has 112 bytes, more than the limit of 100" in caplog.text
    assert "the subscriber is broken" in caplog.text
    with pytest.raises(WrongFields, match="field 'data' is text; got 5"):
        publisher.publish({"data": 5})


def test_a_publisher_with_other_qos_is_reported(transports, caplog: pytest.LogCaptureFixture) -> None:
    name, inbox = unused_topic(), Inbox()
    transport = transports()
    transport.subscribe(Topic(name), print)
    transport.subscribe(Topic(name, reliable=False), inbox.receive)
    publisher = transport.publisher(Topic(name, reliable=False))
    problem = f"a publisher of {name} is not received: it is best-effort, and the subscription is reliable"
    assert eventually(lambda: problem in caplog.text)
    assert eventually(publisher.subscription_count)
    publisher.publish({"data": "from a sensor"})
    assert inbox.next() == {"data": "from a sensor"}


def test_a_publisher_of_another_type_or_durability_is_reported(transports, caplog: pytest.LogCaptureFixture) -> None:
    name, other = unused_topic(), unused_topic()
    transports().publisher(Topic(name, "std_msgs/msg/Bool"))
    transport = transports()
    transport.publisher(Topic(other))
    transport.subscribe(Topic(name), print)
    transport.subscribe(Topic(other, latched=True), print)
    assert eventually(lambda: f"a publisher of {name} is not received: its messages have another type" in caplog.text)
    assert eventually(lambda: f"a publisher of {other} is not received: it is volatile" in caplog.text)


def test_a_topic_has_one_type_and_a_valid_name(transports) -> None:
    transport = transports()
    with pytest.raises(TransportUnavailable, match="topic '/a b' of type 'std_msgs/msg/String' cannot be created"):
        transport.publisher(Topic("/a b"))


def test_a_closed_transport_sends_nothing(transports) -> None:
    transport, topic = transports(), Topic(unused_topic())
    publisher = transport.publisher(topic)
    transport.close()
    transport.close()
    publisher.publish({"data": "x"})
    assert publisher.subscription_count() == 0
    with pytest.raises(TransportUnavailable, match="is closed"):
        transport.publisher(topic)
    with pytest.raises(TransportUnavailable, match="is closed"):
        transport.subscribe(topic, print)


def test_a_subscriber_may_close_the_transport(transports) -> None:
    transport, topic, closed = transports(), Topic(unused_topic(), latched=True), threading.Event()
    transport.publisher(topic).publish({"data": "x"})

    def receive(fields):
        transport.close()
        closed.set()

    transport.subscribe(topic, receive)
    assert closed.wait(PATIENCE)


@pytest.mark.parametrize("text", ["233", "-1", "zero", "1.5", "9" * 5000, "0" * 9 + "233"])
def test_a_domain_that_does_not_exist_is_refused(monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", text)
    with pytest.raises(TransportUnavailable, match="set a number from 0 to 232"):
        DdsTransport()


def test_dds_that_cannot_start_is_refused(transports, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CYCLONEDDS_URI", "<CycloneDDS><Domain><General><Nonsense/></General></Domain></CycloneDDS>")
    with pytest.raises(TransportUnavailable, match="DDS cannot start in domain 100"):
        DdsTransport(100)


SECURITY = "<CycloneDDS><Domain><Security><Authentication/></Security></Domain></CycloneDDS>"


def test_security_that_is_demanded_and_missing_prevents_the_start(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_SECURITY_ENABLE", "true")
    monkeypatch.setenv("ROS_SECURITY_STRATEGY", "Enforce")
    with pytest.raises(TransportUnavailable, match="does not read the keystore of SROS 2"):
        DdsTransport(100)
    monkeypatch.delenv("ROS_SECURITY_ENABLE")
    monkeypatch.setenv("CYCLONEDDS_URI", SECURITY)
    with pytest.raises(TransportUnavailable, match="DDS cannot start in domain 100"):
        DdsTransport(100)


def test_without_the_package_the_error_names_the_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "sleec_runtime.ros.dds.participant", None)
    with pytest.raises(SleecError) as caught:
        DdsTransport()
    assert caught.value.hint == "install `sleec-runtime[dds]`"


def test_many_topics_may_have_one_type(transports) -> None:
    """cyclonedds would never return from creating a topic for the 32nd class of one definition."""
    transport, inbox = transports(), Inbox()
    topics = [Topic(unused_topic(), latched=True) for _ in range(70)]
    for number, topic in enumerate(topics):
        transport.publisher(topic).publish({"data": str(number)})
        transport.subscribe(topic, inbox.receive)
    assert {str(inbox.next()) for _ in topics} == {str({"data": str(number)}) for number in range(70)}
