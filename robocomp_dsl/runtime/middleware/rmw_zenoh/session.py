"""The zenoh session of a component in a ROS graph, and its node.

In: the settings of the command line. Out: an open session with the defaults of `rmw_zenoh_cpp` (its
DEFAULT_RMW_ZENOH_SESSION_CONFIG.json5: peer mode, connected to the router on this machine, no
multicast), and liveliness tokens, which show the endpoints to ROS tools.
"""

from __future__ import annotations

import itertools
import json
import logging
import os
from collections.abc import Mapping
from typing import Any

import zenoh

from robocomp_dsl.runtime.connection.endpoint import Qos
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.rmw_zenoh.graph import RosGraph
from robocomp_dsl.runtime.middleware.rmw_zenoh.wire import (
    EndpointKind,
    NodeInfo,
    TopicInfo,
    gid_of,
    qos_text,
)
from robocomp_dsl.runtime.middleware.ros_common.names import node_name
from robocomp_dsl.runtime.middleware.ros_common.settings import domain_id, only_known

DEFAULT_CONNECT = "tcp/localhost:7447"
DEFAULT_LISTEN = "tcp/localhost:0"
SETTINGS = ("connect", "listen", "domain_id")
log = logging.getLogger("robocomp")


class RosSession:
    """An open session with the node of one component."""

    def __init__(self, component: str, settings: Mapping[str, str]) -> None:
        only_known("rmw_zenoh", settings, SETTINGS)
        self.domain_id = domain_id("rmw_zenoh", settings, os.environ)
        self.connect = settings.get("connect", DEFAULT_CONNECT)
        namespace, name = node_name(component)
        self.zenoh = _open(self.connect, settings.get("listen", DEFAULT_LISTEN))
        try:
            self._report_router()
            self._ids = itertools.count(1)
            self.node = NodeInfo(self.domain_id, str(self.zenoh.info.zid()), 0, namespace, name)
            self._tokens: list[Any] = [self._declare(self.node.token())]
            self.graph = RosGraph(self.zenoh, self.domain_id)
        except BaseException:
            self.zenoh.close()
            raise

    def _report_router(self) -> None:
        """ROS nodes find each other through the router, which may start later."""
        if not self.zenoh.info.routers_zid():
            log.warning(
                "no zenoh router answers at %s; ROS nodes are found when it runs"
                " (`ros2 run rmw_zenoh_cpp rmw_zenohd`, or `--transport rmw_zenoh.connect=…`)",
                self.connect,
            )

    def _declare(self, token: str) -> Any:
        return self.zenoh.liveliness().declare_token(token)

    def announce(self, kind: EndpointKind, info: TopicInfo, qos: Qos) -> tuple[Any, bytes]:
        """Show an endpoint to ROS; returns its token, to undeclare it, and its identity."""
        text = self.node.endpoint_token(next(self._ids), kind, info, qos_text(qos))
        return self._declare(text), gid_of(text)

    def close(self) -> None:
        """Withdraw the node, and close the session."""
        self.graph.close()
        for token in self._tokens:
            token.undeclare()
        self.zenoh.close()


def _open(connect: str, listen: str) -> zenoh.Session:
    config = zenoh.Config()
    values: dict[str, Any] = {
        "mode": "peer",
        "connect/endpoints": [part.strip() for part in connect.split(",")],
        "connect/timeout_ms": 0,  # further attempts are made in the background
        "connect/exit_on_failure": False,
        "listen/endpoints": [part.strip() for part in listen.split(",")],
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": True,
        "timestamping/enabled": True,  # required by the cache of latched topics
        "queries_default_timeout": 600000,
    }
    try:
        for key, value in values.items():
            config.insert_json5(key, json.dumps(value))
        return zenoh.open(config)
    except zenoh.ZError as error:
        raise MiddlewareError(
            f"rmw_zenoh: cannot open a session (connect {connect}, listen {listen}): {error}"
        ) from None
