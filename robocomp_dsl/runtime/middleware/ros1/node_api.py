"""The XML-RPC interface of a node, through which master and other nodes reach it.

In: calls. Out: `[1, message, value]`, or `[-1, reason, 0]`, as http://wiki.ros.org/ROS/Slave_API
specifies. What the node publishes and receives is asked of `NodeState`.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Sequence
from socketserver import ThreadingMixIn
from typing import Any, Protocol
from xmlrpc.server import SimpleXMLRPCRequestHandler, SimpleXMLRPCServer

from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.middleware.tcp.stream import failure_reason

_TRANSPORT = "TCPROS"
_REQUEST_S = 10.0
"""A peer that has connected sends its request within this time."""


class NodeState(Protocol):
    """What the interface shows and changes."""

    master: str

    def publications(self) -> list[tuple[str, str]]:
        """Topic and type of each published topic."""

    def subscriptions(self) -> list[tuple[str, str]]:
        """Topic and type of each subscribed topic."""

    def bus_info(self) -> list[list[Any]]:
        """Each connection: number, peer, direction, transport, topic, whether it is connected."""

    def bus_stats(self) -> list[list[Any]]:
        """Counts of publications, subscriptions and services."""

    def update_publishers(self, topic: str, publishers: Sequence[str]) -> None:
        """The master reports all publishers of a topic."""

    def update_parameter(self, key: str, value: Any) -> None:
        """The master reports a changed parameter."""

    def tcpros_address(self, topic: str) -> tuple[str, int] | None:
        """Where subscribers of a topic connect; None if it is not published."""

    def request_shutdown(self, caller: str, reason: str) -> None:
        """A tool, or the master, asks the node to end."""


class _RequestHandler(SimpleXMLRPCRequestHandler):
    timeout = _REQUEST_S


class _Server(ThreadingMixIn, SimpleXMLRPCServer):
    daemon_threads = True
    block_on_close = False

    def handle_error(self, request: Any, client_address: Any) -> None:
        """A peer that breaks its connection, or sends anything else, is no failure of the node."""


class NodeApi:
    """Serves the interface; `uri` is its address. Raises `MiddlewareError` if it cannot listen."""

    def __init__(self, host: str, state: NodeState) -> None:
        self._state = state
        self._counts = threading.Lock()
        try:
            self._server = _Server((host, 0), _RequestHandler, logRequests=False, allow_none=True)
        except OSError as error:
            raise MiddlewareError(
                f"ros1 cannot listen at {host}: {failure_reason(error)}"
            ) from None
        for name in (
            *("getBusInfo", "getBusStats", "getMasterUri", "getName", "getPid"),
            *("getPublications", "getSubscriptions", "paramUpdate", "publisherUpdate"),
            *("requestTopic", "shutdown"),
        ):
            self._server.register_function(getattr(self, f"_{name}"), name)
        self.uri = f"http://{host}:{self._server.server_address[1]}/"
        self._thread = threading.Thread(
            target=self._server.serve_forever, args=(0.1,), name="ros1 node", daemon=True
        )
        self._thread.start()

    def _getBusInfo(self, _caller: str = "") -> list[Any]:  # noqa: N802 - names of ROS
        return [1, "bus info", self._state.bus_info()]

    def _getBusStats(self, _caller: str = "") -> list[Any]:  # noqa: N802
        return [1, "bus statistics", self._state.bus_stats()]

    def _getMasterUri(self, _caller: str = "") -> list[Any]:  # noqa: N802
        return [1, self._state.master, self._state.master]

    def _getName(self, _caller: str = "") -> list[Any]:  # noqa: N802
        return [1, "node name", getattr(self._state, "name", "")]

    def _getPid(self, _caller: str = "") -> list[Any]:  # noqa: N802
        return [1, "", os.getpid()]

    def _getPublications(self, _caller: str = "") -> list[Any]:  # noqa: N802
        return [1, "publications", [list(each) for each in self._state.publications()]]

    def _getSubscriptions(self, _caller: str = "") -> list[Any]:  # noqa: N802
        return [1, "subscriptions", [list(each) for each in self._state.subscriptions()]]

    def _paramUpdate(self, _caller: str, key: str, value: Any) -> list[Any]:  # noqa: N802
        self._state.update_parameter(key, value)
        return [1, "", 0]

    def _publisherUpdate(  # noqa: N802
        self, _caller: str, topic: str, publishers: Sequence[str]
    ) -> list[Any]:
        if not isinstance(publishers, list) or not isinstance(topic, str):
            return [-1, "publisherUpdate takes a topic and a list of addresses", 0]
        self._state.update_publishers(topic, [str(each) for each in publishers])
        return [1, "", 0]

    def _requestTopic(  # noqa: N802
        self, _caller: str, topic: str, protocols: Sequence[Sequence[Any]]
    ) -> list[Any]:
        offered = [each[0] for each in protocols if isinstance(each, list) and each]
        if _TRANSPORT not in offered:
            return [0, f"the only protocol is {_TRANSPORT}", 0]
        address = self._state.tcpros_address(topic)
        if address is None:
            return [-1, f"{topic} is not published here", 0]
        return [1, "", [_TRANSPORT, *address]]

    def _shutdown(self, caller: str, reason: str = "") -> list[Any]:
        self._state.request_shutdown(caller, reason)
        return [1, "shutdown", 0]

    def close(self) -> None:
        """Serve nothing more."""
        self._server.shutdown()
        self._server.server_close()
        self._thread.join(1.0)
