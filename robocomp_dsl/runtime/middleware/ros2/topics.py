"""Publishers and subscriptions of ROS topics through rclpy.

In: encoded messages. Out: the same bytes: rclpy publishes and receives serialized messages, which
have the CDR that this project uses. No message object of rclpy is built.
"""

from __future__ import annotations

import logging
from typing import Any

from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks

from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.incoming_port import IncomingOperation, IncomingPort
from robocomp_dsl.runtime.connection.message_queue import MessageQueue
from robocomp_dsl.runtime.middleware.ros2.graph_check import GraphCheck
from robocomp_dsl.runtime.middleware.ros2.node import RclpyNode
from robocomp_dsl.runtime.middleware.ros2.qos import publisher_profile, subscription_profile
from robocomp_dsl.runtime.middleware.ros2.ros_types import message_class
from robocomp_dsl.runtime.middleware.ros_common.interface_types import topic_type
from robocomp_dsl.runtime.middleware.ros_common.names import operation_name
from robocomp_dsl.runtime.middleware.ros_common.payload import padded
from robocomp_dsl.runtime.middleware.ros_common.topics import topics_address

log = logging.getLogger("robocomp")


class Ros2Writer:
    """Publishes on one topic."""

    def __init__(
        self, ros: RclpyNode, graph: GraphCheck, at: Endpoint, name: str, operation: Operation
    ) -> None:
        self._ros = ros
        self.topic = operation_name(name, at.interface, operation)
        type_ = topic_type(operation)
        self._publisher = ros.create(
            "publisher",
            message_class(type_, at.port),
            self.topic,
            publisher_profile(at.qos),
            port=at.port,
            event_callbacks=PublisherEventCallbacks(
                incompatible_qos=_qos_warning(at.port, self.topic), use_default_callbacks=False
            ),
        )
        graph.watch_topic(self.topic, type_.type_id, at.port)
        self.send = self._publisher.publish

    def has_subscribers(self) -> bool:
        """Whether another endpoint subscribes to the topic."""
        return bool(self._publisher.get_subscription_count())

    def undeclare(self) -> None:
        """End the publisher."""
        self._ros.node.destroy_publisher(self._publisher)


class Ros2Receiver:
    """Receives one topic for one operation; `name` is that of the port."""

    def __init__(
        self,
        ros: RclpyNode,
        graph: GraphCheck,
        port: IncomingPort,
        served: IncomingOperation,
        name: str,
        queue: MessageQueue,
    ) -> None:
        self._ros = ros
        self._queue = queue
        self._served = served
        self._decode = padded(served.operation.decode_request)
        at = port.at
        topic = operation_name(name, at.interface, served.operation)
        type_ = topic_type(served.operation)
        self._subscription = ros.create(
            "subscription",
            message_class(type_, at.port),
            topic,
            self._receive,
            subscription_profile(at.qos),
            port=at.port,
            event_callbacks=SubscriptionEventCallbacks(
                incompatible_qos=_qos_warning(at.port, topic),
                message_lost=self._count_lost,
                use_default_callbacks=False,
            ),
            raw=True,
        )
        graph.watch_topic(topic, type_.type_id, at.port)

    def _receive(self, data: bytes) -> None:
        served = self._served
        served.counts.bytes_in += len(data)
        try:
            arguments = self._decode(data)
        except BaseException as error:
            served.report(error)
        else:
            self._queue.put(served, served.handle, arguments)

    def _count_lost(self, event: Any) -> None:
        self._served.counts.drops += event.total_count_change

    def undeclare(self) -> None:
        """Receive no more."""
        self._ros.node.destroy_subscription(self._subscription)


class Ros2Subscription:
    """A subscribed port; `address` are the topics that it receives."""

    def __init__(
        self, ros: RclpyNode, graph: GraphCheck, port: IncomingPort, topics: tuple[str, ...]
    ) -> None:
        self.address = topics_address(topics)
        self._queue = MessageQueue(port)
        self._receivers = [
            Ros2Receiver(ros, graph, port, served, topic, self._queue)
            for topic in topics
            for served in port.operations.values()
        ]

    def close(self) -> None:
        """See `transport.Subscription`."""
        for receiver in self._receivers:
            receiver.undeclare()
        self._queue.close()


def _qos_warning(port: str, topic: str) -> Any:
    def warn(event: Any) -> None:
        policy = getattr(event.last_policy_kind, "name", event.last_policy_kind)
        log.warning(
            "%s: nothing is exchanged with a ROS endpoint on %s, because its %s differs;"
            " change the quality of service of one side, here with --qos %s=…",
            port,
            topic,
            str(policy).rpartition("_")[2].lower(),
            port,
        )

    return warn
