"""Writers and readers of DDS topics.

In: encoded messages. Out: the same bytes. The queue of a subscription is the cache of its reader: a
thread of the port takes the messages out of it.
"""

from __future__ import annotations

import threading
from collections import deque
from typing import Any

from cyclonedds.core import (
    DDSException,
    GuardCondition,
    InstanceState,
    Policy,
    Qos,
    ReadCondition,
    SampleState,
    ViewState,
    WaitSet,
)
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.component.receiver import QueueClosed
from robocomp_dsl.runtime.component.statistics import OperationCounts
from robocomp_dsl.runtime.connection import endpoint
from robocomp_dsl.runtime.connection.bounded_queue import KEEP_ALL_DEPTH
from robocomp_dsl.runtime.connection.incoming_port import IncomingOperation, IncomingPort
from robocomp_dsl.runtime.middleware.dds.idl_types import message_type
from robocomp_dsl.runtime.middleware.dds.participant import Participant
from robocomp_dsl.runtime.middleware.ros_common.interface_types import topic_type
from robocomp_dsl.runtime.middleware.ros_common.names import operation_name
from robocomp_dsl.runtime.middleware.ros_common.payload import padded
from robocomp_dsl.runtime.middleware.ros_common.topics import topics_address

DEFAULT_DEPTH = 10
MAX_HOLD_MS = 50
"""A reliable writer waits so long for a full subscriber; then it drops the message."""
_WAIT_S = 60.0
_BATCH = 64


def topic_qos(qos: endpoint.Qos) -> Any:
    """The quality of service of a reader or writer; reliable unless the user says otherwise."""
    depth = qos.depth or (KEEP_ALL_DEPTH if qos.keep_all else DEFAULT_DEPTH)
    policies = [
        Policy.Reliability.BestEffort
        if qos.reliable is False
        else Policy.Reliability.Reliable(duration(milliseconds=MAX_HOLD_MS)),
        Policy.Durability.TransientLocal if qos.latched else Policy.Durability.Volatile,
        Policy.History.KeepAll if qos.keep_all else Policy.History.KeepLast(depth),
        # The CDR of ROS 2, and of the codec: XCDR version 1.
        Policy.DataRepresentation(use_cdrv0_representation=True),
    ]
    if qos.keep_all:
        policies.append(Policy.ResourceLimits(max_samples=depth))
    return Qos(*policies)


def _open_topic(participant: Participant, name: str, operation: Operation, port: str) -> Any:
    type_ = topic_type(operation)
    participant.watch(name, type_.type_id, port)
    # "rt" marks topics of ROS among those of DDS.
    return Topic(participant.dds, f"rt{name}", message_type(type_))


class DdsWriter:
    """Publishes on one topic; `name` is that of the port."""

    def __init__(
        self,
        participant: Participant,
        at: endpoint.Endpoint,
        name: str,
        operation: Operation,
        counts: OperationCounts,
    ) -> None:
        self._counts = counts
        full = operation_name(name, at.interface, operation)
        with participant.opening(full, at.port):
            self._topic = _open_topic(participant, full, operation, at.port)
            self._writer: Any = DataWriter(participant.dds, self._topic, topic_qos(at.qos))
        self._message = self._topic.data_type

    def send(self, data: bytes) -> None:
        """Publish one message; it is dropped if a reliable subscriber has no room for it."""
        try:
            self._writer.write(self._message(data))
        except DDSException as error:
            if error.code != DDSException.DDS_RETCODE_TIMEOUT:
                raise
            self._counts.drops += 1

    def has_subscribers(self) -> bool:
        """Whether another endpoint subscribes to the topic."""
        return bool(self._writer.get_matched_subscriptions())

    def undeclare(self) -> None:
        """End the writer."""
        self._writer = None  # deleted with its last reference


class DdsReceiver:
    """Receives one topic for one operation; `name` is that of the port."""

    def __init__(
        self, participant: Participant, port: IncomingPort, served: IncomingOperation, name: str
    ) -> None:
        at = port.at
        self._served = served
        self._decode = padded(served.operation.decode_request)
        self._messages: deque[bytes] = deque()
        self._closed = threading.Event()
        full = operation_name(name, at.interface, served.operation)
        with participant.opening(full, at.port):
            self._topic = _open_topic(participant, full, served.operation, at.port)
            self._reader: Any = DataReader(participant.dds, self._topic, topic_qos(at.qos))
            self._waitset: Any = WaitSet(participant.dds)
            self._guard: Any = GuardCondition(participant.dds)
            any_state = ViewState.Any | InstanceState.Any | SampleState.NotRead
            self._waitset.attach(ReadCondition(self._reader, any_state))
            self._waitset.attach(self._guard)
        port.receive(self._take, self._handle)

    def _take(self) -> bytes:
        while True:
            if self._closed.is_set():
                self._reader = self._waitset = None  # deleted with their last reference
                raise QueueClosed
            if self._messages:
                return self._messages.popleft()
            self._waitset.wait(duration(seconds=_WAIT_S))
            samples = self._reader.take(_BATCH)
            # Writers that leave appear as samples without data.
            self._messages.extend(s.payload for s in samples if s.sample_info.valid_data)

    def _handle(self, data: bytes) -> None:
        served = self._served
        served.counts.bytes_in += len(data)
        try:
            served.handle(self._decode(data))
        except BaseException as error:
            served.report(error)

    def undeclare(self) -> None:
        """Receive no more."""
        self._closed.set()
        self._guard.set(True)


class DdsSubscription:
    """A subscribed port; `address` are the topics that it receives."""

    def __init__(
        self, participant: Participant, port: IncomingPort, topics: tuple[str, ...]
    ) -> None:
        self.address = topics_address(topics)
        self._receivers = [
            DdsReceiver(participant, port, served, topic)
            for topic in topics
            for served in port.operations.values()
        ]

    def close(self) -> None:
        """See `transport.Subscription`."""
        for receiver in self._receivers:
            receiver.undeclare()
