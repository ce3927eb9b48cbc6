"""The DDS transport rejects parameters that it cannot work with, before its thread uses them."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from typing import Any

import pytest

from sleec_runtime.errors import SleecError, WrongType
from sleec_runtime.ros.dds import transport as dds_transport
from sleec_runtime.ros.dds.transport import DdsTransport
from sleec_runtime.ros.dds.type_store import LONGEST_ARRAY, TypeStore
from sleec_runtime.ros.transport import Topic
from sleec_runtime.ros.transport_errors import InvalidDefinition, TransportUnavailable
from tests.support.dds import PATIENCE, eventually, require_dds, unused_topic
from tests.support.dds import transports as transports

require_dds()

Transports = Callable[..., DdsTransport]


@pytest.mark.parametrize(
    "wrong",
    [
        *({"settle": one} for one in (-1, float("nan"), float("inf"), 1e300, 10**400, Decimal("NaN"), True, None, "1")),
        *({"limit": one} for one in (0, -1, 1.5, True, None, "1")),
        *({"domain": one} for one in (-1, 233, 2**31, 2**40, 1.5, True, "1")),
    ],
    ids=str,
)
def test_wrong_parameters_are_refused(wrong: Any) -> None:
    with pytest.raises(WrongType, match=next(iter(wrong))):
        DdsTransport(**wrong)


@pytest.mark.parametrize("settle", [Fraction(1, 20), Decimal("0.05"), 10**12])
def test_a_time_to_settle_may_be_any_number(transports: Transports, settle: Any) -> None:
    transport, topic = transports(settle=settle), Topic(unused_topic())
    received: list[object] = []
    transport.subscribe(topic, received.append)
    transport.publisher(topic).publish({"data": "x"})
    if settle < 1:
        assert eventually(lambda: received)
    else:
        time.sleep(0.2)
    assert transport._thread.is_alive()


@pytest.mark.parametrize("name", ["", "conditions", "/a b", "/é"])
def test_a_topic_that_ros_does_not_have_is_refused(transports: Transports, name: str) -> None:
    transport = transports()
    with pytest.raises(TransportUnavailable, match="start the name with `/`"):
        transport.publisher(Topic(name))
    with pytest.raises(TransportUnavailable, match="start the name with `/`"):
        transport.subscribe(Topic(name), print)


@pytest.mark.parametrize(
    "text", ["my_msgs/Grip grip", "my_msgs/Grip[3] grip", f"bool[{LONGEST_ARRAY + 1}] a", "bool[<=99999999999] a"]
)
def test_a_type_that_no_message_can_have_is_refused(text: str) -> None:
    with pytest.raises(InvalidDefinition):
        TypeStore("jazzy", {"my_msgs/msg/Grip": text}).message("my_msgs/msg/Grip")


@pytest.mark.parametrize("text", ["foo bar", "wstring a", "bool", "]"])
def test_other_definitions_are_refused(text: str) -> None:
    with pytest.raises(SleecError):
        TypeStore("jazzy", {"my_msgs/msg/Grip": text}).message("my_msgs/msg/Grip")


def test_the_end_does_not_wait_for_code_that_does_not_return(
    transports: Transports, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(dds_transport, "LONGEST_CLOSE", 0.1)
    transport, topic, begun, end = transports(), Topic(unused_topic()), threading.Event(), threading.Event()

    def receive(fields: object) -> None:
        begun.set()
        end.wait()

    transport.subscribe(topic, receive)
    transport.publisher(topic).publish({"data": "x"})
    assert begun.wait(PATIENCE)
    transport.close()
    end.set()
    assert eventually(lambda: not transport._thread.is_alive())
