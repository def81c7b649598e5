"""The ports of a component as endpoints.

In: the component's ports and its settings, which may be replaced while it runs. Out: an `Endpoint`
for each port: peers, middlewares and quality of service.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator

from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.component.settings import RunSettings
from robocomp_dsl.runtime.component.spec import CalledPort, ComponentSpec, ServedPort
from robocomp_dsl.runtime.connection.endpoint import Endpoint, Qos
from robocomp_dsl.runtime.connection.qos_support import check_qos
from robocomp_dsl.runtime.time.clock_interface import CLOCK

ROLES = {
    "implements": "server",
    "requires": "client",
    "publishes": "publisher",
    "subscribes": "subscriber",
}
"""Attributes of `ComponentSpec`, and the roles of their ports."""
SEARCHING_ROLES = ("client", "subscriber")
"""These ports look for their peers; the others are found by them."""


class Wiring:
    """The ports of one component; `settings` are those in force.

    `lock` is held while a port opens or changes, so that an open port and `settings` agree.
    """

    def __init__(self, name: str, spec: ComponentSpec, settings: RunSettings) -> None:
        self.name = name
        self.spec = spec
        self.settings = settings
        self.lock = threading.RLock()
        self._unopened: list[ServedPort | CalledPort] = [*spec.implements, *spec.subscribes]

    def is_open(self, port: ServedPort | CalledPort) -> bool:
        """Whether a change of the port must change more than `settings`."""
        return not any(other is port for other in self._unopened)

    def mark_open(self, port: ServedPort | CalledPort) -> None:
        """The port is served or subscribed from now on."""
        self._unopened = [other for other in self._unopened if other is not port]

    def ports(self) -> Iterator[tuple[str, ServedPort | CalledPort]]:
        """All ports with their roles."""
        for attribute, role in ROLES.items():
            for port in getattr(self.spec, attribute):
                yield role, port

    def role_of(self, port: ServedPort | CalledPort) -> str:
        """The role of a port, see `ROLES`."""
        return next(role for role, other in self.ports() if other is port)

    def endpoint(self, port: ServedPort | CalledPort) -> Endpoint:
        """The endpoint of a port.

        A port that looks for its peers keeps its name; a remap names those peers.
        """
        settings, interface = self.settings, interface_of(port)
        searches = self.role_of(port) in SEARCHING_ROLES
        return Endpoint(
            interface,
            self.name,
            port.name if searches else settings.remaps.get(port.name, port.name),
            settings.peers_of(port.name) if searches else (),
            settings.qos.get(port.name, Qos()),
            # All components share the clock, whatever their middlewares are.
            () if interface.name == CLOCK.name else self.middlewares_of(port),
            settings.external_records(port.name, self.spec.role_of_peers(port), interface.name),
            settings.connection_qos(port.name),
        )

    def middlewares_of(self, port: ServedPort | CalledPort) -> tuple[str, ...]:
        """The middlewares of a port, in order of preference."""
        return self.settings.middlewares_of(port.name, port.middlewares, self.spec.middleware)

    def check_qos(self) -> None:
        """Check that all middlewares can do what is asked for. Raises `UnsupportedQos`."""
        for role, port in self.ports():
            check_qos(self.endpoint(port), role, self.middlewares_of(port))


def interface_of(port: ServedPort | CalledPort) -> Interface:
    """The interface of a port."""
    return port.interface if isinstance(port, ServedPort) else port.proxy.INTERFACE
