"""pipe: unix sockets with abstract names, so that a killed process leaves no file."""

from __future__ import annotations

from robocomp_dsl.runtime.middleware.capabilities import Capabilities, MiddlewareDescription

MIDDLEWARE = MiddlewareDescription(
    name="pipe",
    summary="unix sockets between processes of one machine, from another distribution",
    capabilities=Capabilities(
        attaches_subscribers=True,
        sequence_numbers=True,
        max_message_bytes=1 << 30,
    ),
    opener="robocomp_dsl_pipe.transport:open_transport",
)
