"""zenoh: the house transport, between processes of one or several machines."""

from robocomp_dsl.runtime.middleware.capabilities import Capabilities, MiddlewareDescription

MIDDLEWARE = MiddlewareDescription(
    name="zenoh",
    summary="the default: components in any processes, also on several hosts",
    capabilities=Capabilities(
        topic_versions=True,
        between_hosts=True,
        sequence_numbers=True,
        reports_source=True,
        qos=frozenset({"reliable", "keep_all", "latched", "priority"}),
    ),
    opener="robocomp_dsl.runtime.middleware.zenoh.transport:open_transport",
    requires=("zenoh",),
    install="run: pip install eclipse-zenoh",
)
