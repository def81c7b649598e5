"""The ROS node of a component, and the thread that runs its executor.

In: callbacks of subscriptions, services and clients. Out: their calls by one thread; they only pass
messages on to the threads of the ports, so that none of them waits.
"""

from __future__ import annotations

import logging
import os
import threading
from collections.abc import Mapping
from typing import Any

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor

from robocomp_dsl.runtime.component.user_errors import describe_error
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.ros_common.names import node_name
from robocomp_dsl.runtime.middleware.ros_common.settings import domain_id, only_known

SETTINGS = ("domain_id",)
log = logging.getLogger("robocomp")


class RclpyNode:
    """A node with an rclpy context and an executor of its own."""

    def __init__(self, component: str, settings: Mapping[str, str]) -> None:
        only_known("ros2", settings, SETTINGS)
        self.domain_id = domain_id("ros2", settings, os.environ)
        namespace, name = node_name(component)
        self._context = rclpy.Context()
        try:
            # Without arguments: those of the component are none of ROS.
            rclpy.init(args=[], context=self._context, domain_id=self.domain_id)
            self.node: Any = rclpy.create_node(
                name,
                namespace=namespace,
                context=self._context,
                use_global_arguments=False,
                enable_rosout=False,
            )
        except Exception as error:
            raise MiddlewareError(
                f"ros2: cannot create the node {name} in domain {self.domain_id}: {error}; a ROS"
                " middleware must be installed, for example by pip install 'robocomp_dsl[ros2]'"
            ) from None
        self.executor = SingleThreadedExecutor(context=self._context)
        self.executor.add_node(self.node)
        self._is_closed = False
        self._reported: set[str] = set()
        self._thread = threading.Thread(target=self._spin, name=f"{component} rclpy", daemon=True)
        self._thread.start()

    def create(
        self, kind: str, type_: Any, name: str, *options: Any, port: str, **more: Any
    ) -> Any:
        """A `kind` of entity: publisher, subscription, service or client.

        Raises `MiddlewareError` with the port, for example if ROS has the name with another type.
        """
        try:
            return getattr(self.node, f"create_{kind}")(type_, name, *options, **more)
        except Exception as error:
            raise MiddlewareError(f"{port}: ROS cannot open the {kind} {name}: {error}") from None

    def _spin(self) -> None:
        while not self._is_closed:
            try:
                self.executor.spin()
            except ExternalShutdownException:
                return
            except Exception as error:
                # rclpy raises here what a client or service cannot deserialize.
                if not self._is_closed and type(error).__name__ not in self._reported:
                    self._reported.add(type(error).__name__)
                    log.warning("rclpy rejected a message: %s", describe_error(error))

    def close(self) -> None:
        """End the thread, and destroy the node with all its entities."""
        if self._is_closed:
            return
        self._is_closed = True
        self.executor.shutdown(timeout_sec=1.0)
        self._thread.join(1.0)
        self.node.destroy_node()
        rclpy.shutdown(context=self._context)
