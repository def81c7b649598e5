"""The other endpoints of the ROS graph, from liveliness tokens.

In: tokens that appear and disappear. Out: which endpoints a topic or service has, and warnings
about endpoints with another type under the same name.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from typing import Any

import zenoh

from robocomp_dsl.runtime.middleware.rmw_zenoh.wire import (
    TOKENS,
    RemoteEndpoint,
    TopicInfo,
    parse_endpoint,
)

log = logging.getLogger("robocomp")


class RosGraph:
    """All endpoints of a ROS domain; `own` is the identity of the own session."""

    def __init__(self, session: zenoh.Session, domain_id: int) -> None:
        self._changed = threading.Condition()
        self._endpoints: dict[str, RemoteEndpoint] = {}
        self._watched: dict[str, tuple[TopicInfo, str]] = {}
        self._reported: set[tuple[str, str]] = set()
        self._subscriber: Any = session.liveliness().declare_subscriber(
            f"{TOKENS}/{domain_id}/**", self._on_token, history=True
        )

    def _on_token(self, sample: zenoh.Sample) -> None:
        token = str(sample.key_expr)
        endpoint = parse_endpoint(token)
        if endpoint is None:
            return
        with self._changed:
            if sample.kind == zenoh.SampleKind.PUT:
                self._endpoints[token] = endpoint
            else:
                self._endpoints.pop(token, None)
            self._changed.notify_all()
            watched = self._watched.get(endpoint.info.name)
        if watched and sample.kind == zenoh.SampleKind.PUT:
            self._report(endpoint, *watched)

    def watch(self, info: TopicInfo, port: str) -> None:
        """Warn of endpoints with the name of `info` that have another type."""
        with self._changed:
            self._watched[info.name] = info, port
            endpoints = list(self._endpoints.values())
        for endpoint in endpoints:
            self._report(endpoint, info, port)

    def _report(self, endpoint: RemoteEndpoint, info: TopicInfo, port: str) -> None:
        if endpoint.info.name != info.name or endpoint.info == info:
            return
        if (endpoint.node, info.name) not in self._reported:
            self._reported.add((endpoint.node, info.name))
            log.warning("%s: %s", port, mismatch(endpoint, info))

    def find(self, kind: str, info: TopicInfo) -> list[RemoteEndpoint]:
        """The endpoints of this kind with the name, type and hash of `info`."""
        with self._changed:
            return [
                endpoint
                for endpoint in self._endpoints.values()
                if endpoint.kind == kind and endpoint.info == info
            ]

    def find_other(self, kind: str, info: TopicInfo) -> RemoteEndpoint | None:
        """An endpoint of this kind and name that has another type or hash."""
        with self._changed:
            for endpoint in self._endpoints.values():
                same_name = endpoint.info.name == info.name
                if endpoint.kind == kind and same_name and endpoint.info != info:
                    return endpoint
        return None

    def wait(self, condition: Callable[[], object], timeout: float) -> bool:
        """Wait up to `timeout` s until `condition` is true; it is evaluated at every change."""
        with self._changed:
            self._changed.wait_for(condition, timeout)
            return bool(condition())

    def notify(self) -> None:
        """Let all waits evaluate their conditions."""
        with self._changed:
            self._changed.notify_all()

    def close(self) -> None:
        """Follow the graph no longer."""
        self._subscriber.undeclare()


def mismatch(endpoint: RemoteEndpoint, info: TopicInfo) -> str:
    """The text for an endpoint whose type differs."""
    theirs = endpoint.info
    if theirs.type_id != info.type_id:
        return (
            f"the ROS node {endpoint.node} uses {info.name} with the type {theirs.type_id},"
            f" this component with {info.type_id}"
        )
    return (
        f"the ROS node {endpoint.node} uses another definition of {info.type_id} for"
        f" {info.name}: its hash is {theirs.hash[:20]}…, here it is {info.hash[:20]}…"
    )
