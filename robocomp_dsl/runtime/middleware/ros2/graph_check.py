"""Warns of ROS endpoints that use the name of a topic with another type.

ROS delivers nothing between them, and reports nothing. In: the graph of ROS, read once per second.
Out: one warning for each node and topic.
"""

from __future__ import annotations

import contextlib
import logging
from typing import Any

from rclpy.node import NodeNameNonExistentError

from robocomp_dsl.runtime.middleware.ros2.node import RclpyNode

PERIOD_S = 1.0
log = logging.getLogger("robocomp")


class GraphCheck:
    """The topics of one component."""

    def __init__(self, ros: RclpyNode) -> None:
        self._node = ros.node
        self._topics: dict[str, tuple[str, str]] = {}
        self._reported: set[tuple[str, str]] = set()
        self._timer = ros.node.create_timer(PERIOD_S, self._check)

    def watch_topic(self, topic: str, type_id: str, port: str) -> None:
        """Check the endpoints of `topic`, whose type is `type_id`."""
        self._topics[topic] = type_id, port

    def _check(self) -> None:
        for topic, (type_id, port) in list(self._topics.items()):
            for endpoint in self._endpoints(topic):
                other, node = endpoint.topic_type, _full_name(endpoint)
                if other != type_id and (node, topic) not in self._reported:
                    self._reported.add((node, topic))
                    log.warning(
                        "%s: the ROS node %s uses %s with the type %s, this component with %s",
                        port,
                        node,
                        topic,
                        other,
                        type_id,
                    )

    def _endpoints(self, topic: str) -> list[Any]:
        node = self._node
        return [
            *node.get_publishers_info_by_topic(topic),
            *node.get_subscriptions_info_by_topic(topic),
        ]

    def service_mismatch(self, service: str, type_id: str) -> str:
        """Which node serves `service` with another type; "" if none does."""
        for name, namespace in self._node.get_node_names_and_namespaces():
            with contextlib.suppress(NodeNameNonExistentError):  # it has just ended
                services = self._node.get_service_names_and_types_by_node(name, namespace)
                for other, types in services:
                    if other == service and type_id not in types:
                        return (
                            f"the ROS node {namespace.rstrip('/')}/{name} serves {service} with the"
                            f" type {', '.join(types)}, this component calls {type_id}"
                        )
        return ""


def _full_name(endpoint: Any) -> str:
    return f"{endpoint.node_namespace.rstrip('/')}/{endpoint.node_name}"
