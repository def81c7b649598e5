"""Middlewares for cases, which must not depend on those that are built in or installed."""

from __future__ import annotations

from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.runtime.middleware.capabilities import Capabilities, MiddlewareDescription
from robocomp_dsl.runtime.middleware.registry import description_of

HOUSE = Capabilities(
    between_hosts=True,
    reports_source=True,
    qos=frozenset({"reliable", "priority"}),
    topic_versions=True,
)
ONE_MACHINE = Capabilities(reports_source=True, valid_names="[a-z_]+|[A-Z][A-Za-z]*")
SERVICES = Capabilities(
    between_hosts=True, topics=False, external_peers=True, fixed_address=True, reports_source=True
)
TOPICS = Capabilities(
    between_hosts=True,
    services=False,
    external_peers=True,
    qos=frozenset({"latched"}),
    external_port_names="/[a-z:]+",
)


class FixedMiddlewares(KnownMiddlewares):
    """Only the middlewares of this module."""

    def find(self, written: str) -> str | None:
        return next((name for name in self.names() if name == written.lower()), None)

    def names(self) -> list[str]:
        return sorted(self._further)


OTHER_MIDDLEWARES = FixedMiddlewares(
    (
        MiddlewareDescription("bus", "topics only", TOPICS, "bus:open"),
        MiddlewareDescription(
            "inproc", "in one process", Capabilities(between_processes=False), "inproc:open"
        ),
        MiddlewareDescription("rpc", "services only", SERVICES, "rpc:open"),
        MiddlewareDescription("shm", "on one machine", ONE_MACHINE, "shm:open"),
        MiddlewareDescription("zenoh", "the default", HOUSE, "zenoh:open"),
    )
)


def _built_in(name: str) -> MiddlewareDescription:
    description = description_of(name)
    assert description is not None
    return description


BRIDGED_MIDDLEWARES = FixedMiddlewares(
    tuple(_built_in(name) for name in ("ice", "inproc", "ros1", "ros2", "yarp", "zenoh"))
)
"""Those between which the cases of bridges pass data."""
