"""What the middleware `local` can do."""

from __future__ import annotations

from robocomp_dsl.runtime.middleware.capabilities import Capabilities, MiddlewareDescription

MAX_MESSAGE_BYTES = 1 << 30
"""Larger messages are refused by the sender, and by the receiver."""

MIDDLEWARE = MiddlewareDescription(
    name="local",
    summary="fast, on one machine: unix sockets, and shared memory for large messages",
    capabilities=Capabilities(
        topic_versions=True,
        attaches_subscribers=True,
        sequence_numbers=True,
        qos=frozenset({"reliable", "keep_all", "latched"}),
        max_message_bytes=MAX_MESSAGE_BYTES,
    ),
    opener="robocomp_dsl.runtime.middleware.local.transport:open_transport",
)
