"""inproc: direct calls between components of one process."""

from robocomp_dsl.runtime.middleware.capabilities import Capabilities, MiddlewareDescription

MIDDLEWARE = MiddlewareDescription(
    name="inproc",
    summary="direct calls between components of one process",
    capabilities=Capabilities(
        topic_versions=True,
        between_processes=False,
        attaches_subscribers=True,
        reports_source=True,
        qos=frozenset({"reliable", "keep_all", "latched"}),
    ),
    opener="robocomp_dsl.runtime.middleware.inproc.transport:open_transport",
)
