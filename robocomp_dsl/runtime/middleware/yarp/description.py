"""yarp: components, and programs of YARP 3 and 4. No part of YARP is needed."""

from robocomp_dsl.runtime.middleware.capabilities import Capabilities, MiddlewareDescription

MAX_MESSAGE_BYTES = 1 << 30
"""Larger messages are refused by the sender, and by the receiver."""

MIDDLEWARE = MiddlewareDescription(
    name="yarp",
    summary="YARP 3 and 4: programs written with YARP; needs no installation of YARP",
    capabilities=Capabilities(
        between_hosts=True,
        external_peers=True,
        fixed_address=True,
        attaches_subscribers=True,
        qos=frozenset({"reliable", "keep_all", "latched"}),
        max_message_bytes=MAX_MESSAGE_BYTES,
        external_port_names=r"/[^\s\"@]+",
    ),
    opener="robocomp_dsl.runtime.middleware.yarp.transport:open_transport",
    connector="robocomp_dsl.runtime.middleware.yarp.connector:open_connector",
    address_problem="robocomp_dsl.runtime.middleware.yarp.valid_addresses:address_problem",
)
