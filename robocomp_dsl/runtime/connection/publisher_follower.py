"""A subscription of a client, which learns from the publishers which middlewares to use.

In: a port that names no middleware. Out: a subscription on each middleware on which a matching
publisher appears, now or later. Components do not need it: their descriptions name middlewares.
"""

from __future__ import annotations

import logging
import threading
from collections.abc import Mapping
from dataclasses import replace

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.connection.component_ports import ComponentPorts
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.peer_selection import matches
from robocomp_dsl.runtime.connection.ports import OperationCallable
from robocomp_dsl.runtime.connection.usable_records import is_usable
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.presence.port_record import PortRecord

_LONG_S = 3600.0
log = logging.getLogger("robocomp")


class PublisherFollower:
    """Subscribes to publishers on any middleware until the ports of the client are closed."""

    def __init__(
        self,
        ports: ComponentPorts,
        at: Endpoint,
        handlers: Mapping[str, OperationCallable],
        execution: CallbackGroup,
    ) -> None:
        self._ports = ports
        self._at = at
        self._handlers = handlers
        self._execution = execution
        self._registry = ports.presence.registry
        self._subscribed: set[str] = set()
        self._subscribe(ports.presence.house)
        for record in self._registry.find("publisher", at.interface.name):
            if self._is_new(record):
                self._subscribe(record.middleware)
        threading.Thread(target=self._run, name=f"{at.name}.publishers", daemon=True).start()

    def _is_new(self, record: PortRecord) -> bool:
        """Whether it is a publisher that no subscription reaches yet."""
        if record.middleware in self._subscribed:
            return False
        if not matches(self._at, record.component, record.port):
            return False
        if not is_usable(self._at, record):
            return False
        found = self._registry.find("publisher", record.interface)
        return not any(r.name == record.name and r.middleware in self._subscribed for r in found)

    def _subscribe(self, middleware: str) -> None:
        self._subscribed.add(middleware)
        at = replace(self._at, middlewares=(middleware,))
        try:
            self._ports.subscribe(at, self._handlers, self._execution, is_start=False)
        except MiddlewareError as error:
            log.warning("%s cannot be subscribed to over %s: %s", at.port, middleware, error)

    def _run(self) -> None:
        name = self._at.interface.name
        while not self._registry.closed:
            found = self._registry.wait("publisher", name, self._is_new, _LONG_S)
            for record in found:
                if self._is_new(record) and not self._registry.closed:
                    self._subscribe(record.middleware)
