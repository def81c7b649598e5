"""What zenoh can do."""

from __future__ import annotations

from robocomp_dsl.runtime.middleware.capabilities import Capabilities, MiddlewareDescription

MIDDLEWARE = MiddlewareDescription(
    name="zenoh",
    summary="between processes and machines; the default",
    capabilities=Capabilities(
        between_hosts=True,
        sequence_numbers=True,
        reports_source=True,
        qos=frozenset({"reliable", "priority"}),
    ),
    opener="robocomp_dsl.runtime.middleware.zenoh.transport:open_transport",
    requires=("zenoh",),
    install="pip install eclipse-zenoh",
)
