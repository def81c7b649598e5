"""Questions between components over zenoh: signs of life, and latest messages.

In: the session of a presence. Out: answers to others, and the answers of others. Both work for
ports on any middleware.
"""

from __future__ import annotations

import contextlib
import json
from collections.abc import Callable
from typing import Any
from urllib.parse import unquote

import zenoh

from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.presence import keys
from robocomp_dsl.runtime.presence.port_record import PortRecord
from robocomp_dsl.runtime.presence.presence import LatestMessage, LatestMessages
from robocomp_dsl.runtime.presence.sequence_format import SEQUENCE_FORMAT

LATEST_TIMEOUT_S = 10.0
"""A latest message may be large; nobody waits for it."""
SHAPES_TIMEOUT_S = 2.0
"""A caller waits for it, once for each server with another version of its interface."""


class HouseQueries:
    """The questions and answers of one component."""

    def __init__(self, session: zenoh.Session, domain: str, component: str) -> None:
        self._session = session
        self._domain = domain
        self._component = component
        self._heartbeat: Any = None
        self._shapes: dict[str, bytes] = {}
        self._serves_shapes = False

    def answer_probes(self) -> None:
        """See `Presence`."""
        if self._heartbeat is None:
            key = keys.heartbeat_key(self._domain, self._component)

            def answer(query: zenoh.Query) -> None:
                _reply(query, key, b"")
                query.drop()

            reply = zenoh.handlers.Callback(answer, indirect=False)
            self._heartbeat = self._session.declare_queryable(key, reply)

    def probe(self, component: str, timeout: float, on_reply: Callable[[], None]) -> None:
        """See `Presence`."""

        def on_answer(reply: zenoh.Reply) -> None:
            if reply.ok is not None:
                on_reply()

        key = keys.heartbeat_key(self._domain, component)
        self._get(key, on_answer, timeout)

    def offer_shapes(self, interface: Interface) -> None:
        """See `Presence`."""
        name, hash_ = interface.name, interface.hash.hex()
        key = keys.shapes_key(self._domain, self._component, name, hash_)
        self._shapes[key] = json.dumps(interface.shapes).encode()
        if self._serves_shapes:
            return
        self._serves_shapes = True

        def answer(query: zenoh.Query) -> None:
            key = str(query.key_expr)
            if shapes := self._shapes.get(key):
                _reply(query, key, shapes)
            query.drop()

        reply = zenoh.handlers.Callback(answer, indirect=False)
        self._session.declare_queryable(keys.shapes_key(self._domain, self._component), reply)

    def shapes_of(self, peer: PortRecord) -> dict[str, str] | None:
        """See `Presence`."""
        key = keys.shapes_key(self._domain, peer.component, peer.interface, peer.hash)
        try:
            for reply in self._session.get(key, timeout=SHAPES_TIMEOUT_S):
                if reply.ok is not None:
                    return read_shapes(reply.ok.payload.to_bytes())
        except zenoh.ZError:  # the session is closing
            pass
        return None

    def _get(self, key: str, on_answer: Callable[[zenoh.Reply], None], timeout: float) -> None:
        with contextlib.suppress(zenoh.ZError):  # the session is closing
            self._session.get(
                key,
                zenoh.handlers.Callback(on_answer, indirect=False),
                timeout=timeout,
                consolidation=zenoh.ConsolidationMode.NONE,
            )

    def offer_latest(self, at: Endpoint, latest: LatestMessages) -> OfferedQueryable:
        """See `Presence`."""
        prefix = keys.port_key(self._domain, "l", at)

        def answer(query: zenoh.Query) -> None:
            for message in latest():
                key = f"{prefix}/{keys.escape_chunk(message.operation)}"
                _reply(query, key, message.data, message.number)
            query.drop()

        reply = zenoh.handlers.Callback(answer, indirect=False)
        return OfferedQueryable(self._session.declare_queryable(f"{prefix}/*", reply))

    def fetch_latest(
        self, at: Endpoint, publisher: PortRecord, on_message: Callable[[LatestMessage], None]
    ) -> None:
        """See `Presence`."""

        def on_answer(reply: zenoh.Reply) -> None:
            sample = reply.ok
            number = sample.attachment.to_bytes() if sample and sample.attachment else b""
            if sample is not None and len(number) == SEQUENCE_FORMAT.size:
                operation = unquote(str(sample.key_expr).rpartition("/")[2])
                on_message(LatestMessage(operation, number, sample.payload.to_bytes()))

        published = Endpoint(at.interface, publisher.component, publisher.port)
        key = f"{keys.port_key(self._domain, 'l', published)}/*"
        self._get(key, on_answer, LATEST_TIMEOUT_S)


class OfferedQueryable:
    """The latest messages of one published port."""

    def __init__(self, queryable: Any) -> None:
        self._queryable = queryable

    def close(self) -> None:
        """See `Closeable`."""
        with contextlib.suppress(zenoh.ZError):  # the session is closed
            self._queryable.undeclare()


def read_shapes(data: bytes) -> dict[str, str] | None:
    """The shapes in the reply of a peer; None if it contains anything else."""
    try:
        shapes = json.loads(data)
    except (ValueError, RecursionError):
        return None
    if not isinstance(shapes, dict) or not all(isinstance(text, str) for text in shapes.values()):
        return None
    return shapes


def _reply(query: zenoh.Query, key: str, payload: bytes, attachment: bytes = b"") -> None:
    with contextlib.suppress(zenoh.ZError):  # the session is closing
        query.reply(key, payload, attachment=attachment or None)
