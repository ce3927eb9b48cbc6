"""The interface to cyclonedds: writers and readers of bytes, and a wait for all readers."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import Any

from cyclonedds.core import (
    DDSException,
    DDSStatus,
    GuardCondition,
    InstanceState,
    ReadCondition,
    SampleState,
    ViewState,
    WaitSet,
)
from cyclonedds.domain import DomainParticipant
from cyclonedds.pub import DataWriter
from cyclonedds.qos import Policy, Qos
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic as DdsTopic
from cyclonedds.util import duration

from sleec_runtime.ros.dds.idl_types import serialized_type
from sleec_runtime.ros.dds.message_types import Message
from sleec_runtime.ros.transport import Topic
from sleec_runtime.ros.transport_errors import TransportUnavailable
from sleec_runtime.support.messages import represent

LONGEST_BLOCK = 1
"""Seconds after which `write` gives up, if a receiver does not keep up."""

LONGEST_WAIT = 86_400.0
"""Seconds after which `wait` returns at the latest, if a time is given. DDS counts nanoseconds, in 64 bits."""

_FOREVER: int = duration(infinite=True)

AT_ONCE = 64
"""The number of messages that are read at once."""


INCOMPATIBLE = {
    2: "it is volatile, and the subscription is latched",
    11: "it is best-effort, and the subscription is reliable",
    24: "its messages have another type",
}
"""Why a writer does not reach a reader, by the policy that DDS names (OMG, DDS 1.4, Section 2.2.3; DDS-XTypes)."""


class Participant:
    """A participant of a DDS domain. Raises TransportUnavailable if DDS cannot start."""

    def __init__(self, domain: int) -> None:
        try:
            self._participant = DomainParticipant(domain)
        except DDSException as error:
            raise TransportUnavailable(
                f"DDS cannot start in domain {domain}: {error.msg}", "check CYCLONEDDS_URI and the network interface"
            ) from error
        self._waitset = _WaitSet(self._participant)
        self._readers: dict[int, Reader] = {}
        self._waking = GuardCondition(self._participant)
        self._waitset.attach(self._waking)

    def writer(self, topic: Topic, message: Message) -> Writer:
        """A writer of messages in CDR."""
        samples, entity = self._topic(topic, message)
        return Writer(DataWriter(self._participant, entity, _qos(topic)), samples)

    def reader(self, topic: Topic, message: Message) -> Reader:
        """A reader, whose messages end `wait`."""
        _, entity = self._topic(topic, message)
        reader = DataReader(self._participant, entity, _qos(topic))
        reader.set_status_mask(DDSStatus.RequestedIncompatibleQos)
        ready = ReadCondition(reader, ViewState.Any | SampleState.NotRead | InstanceState.Any)
        readable = Reader(reader, ready)
        self._readers[self._waitset.attach_with_key(ready)] = readable
        self._waitset.attach(reader)
        return readable

    def wait(self, seconds: float | None = None) -> set[Reader]:
        """The readers with messages, as soon as there are any, or a reader has another status, or after `wake`, or
        after `seconds`, or after `LONGEST_WAIT`."""
        return self._with_messages(_FOREVER if seconds is None else duration(seconds=min(seconds, LONGEST_WAIT)))

    def ready(self) -> set[Reader]:
        """The readers that have messages now."""
        return self._with_messages(0)

    def _with_messages(self, timeout: int) -> set[Reader]:
        keys = self._waitset.wait_for_keys(timeout)
        return {self._readers[key] for key in keys if key in self._readers}

    def wake(self) -> None:
        """Lets every call of `wait` return."""
        self._waking.set(True)

    def _topic(self, topic: Topic, message: Message) -> tuple[Any, Any]:
        samples = serialized_type(message)
        hint = "start the name with `/`, and use one type for a topic"
        if not topic.name.startswith("/"):
            raise TransportUnavailable(f"topic {represent(topic.name)} cannot be created", hint)
        try:
            # As ROS 2 names topics in DDS: `rt/conditions`.
            return samples, DdsTopic(self._participant, f"rt{topic.name}", samples)
        except DDSException as error:
            raise TransportUnavailable(
                f"topic {represent(topic.name)} of type {topic.type!r} cannot be created: {error.msg}", hint
            ) from error


class _WaitSet(WaitSet):
    """A wait set that tells which of its entities have ended the wait. cyclonedds only tells their number, and asking
    each of them takes time on the way from a message to its receiver."""

    def attach_with_key(self, entity: Any) -> int:
        """Adds an entity, and returns its key."""
        self.attach(entity)
        return ctypes.addressof(self.attached[-1][1])

    def wait_for_keys(self, timeout: int) -> Sequence[int]:
        """The keys of the entities that have ended the wait, or none after `timeout` nanoseconds."""
        keys = (ctypes.c_void_p * len(self.attached))()
        found: int = self._waitset_wait(self._ref, keys, len(keys), timeout)
        if found < 0:
            raise DDSException(found, "while waiting for messages")
        return [key for key in keys[:found] if key is not None]


class Writer:
    """Writes messages in CDR on one topic."""

    def __init__(self, writer: Any, samples: Any) -> None:
        self._writer = writer
        self._samples = samples

    def write(self, data: bytes) -> None:
        """Raises TransportUnavailable if a receiver does not keep up."""
        try:
            self._writer.write(self._samples(data))
        except DDSException as error:
            raise TransportUnavailable(f"a message was not sent: {error.msg}") from error

    def reader_count(self) -> int:
        """The number of readers that discovery has found."""
        return len(self._writer.get_matched_subscriptions())


class Reader:
    """Reads messages in CDR on one topic."""

    def __init__(self, reader: Any, ready: Any) -> None:
        self._reader = reader
        self._ready = ready

    def take(self) -> Sequence[tuple[int, bytes]]:
        """The next messages, or none. Each has the time at which it was sent, in nanoseconds since 1970."""
        samples = self._reader.take(AT_ONCE, self._ready)
        return [(one.sample_info.source_timestamp, one.data) for one in samples if one.sample_info.valid_data]

    def incompatibility(self) -> str | None:
        """Why a writer that has appeared since the last call does not reach this reader; None if there is none."""
        status = self._reader.get_requested_incompatible_qos_status()
        return INCOMPATIBLE.get(status.last_policy_id, "its QoS differs") if status.total_count_change else None


def _qos(topic: Topic) -> Any:
    """The QoS of a topic, as ROS 2 sets it."""
    kept = Policy.History.KeepLast(topic.depth)
    return Qos(
        Policy.Reliability.Reliable(max_blocking_time=duration(seconds=LONGEST_BLOCK))
        if topic.reliable
        else Policy.Reliability.BestEffort,
        Policy.Durability.TransientLocal if topic.latched else Policy.Durability.Volatile,
        kept,
        # What a latched topic keeps for late joiners.
        Policy.DurabilityService(
            cleanup_delay=0, history=kept, max_samples=-1, max_instances=-1, max_samples_per_instance=-1
        ),
        # Messages stay valid after their writer ends.
        Policy.WriterDataLifecycle(autodispose=False),
        Policy.DataRepresentation(use_cdrv0_representation=True),
    )
