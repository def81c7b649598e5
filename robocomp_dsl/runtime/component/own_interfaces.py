"""Serves the interfaces that every component has.

`Component`, `ComponentSchema` and `ComponentConnections`. In: a runner. Out: served operations, in
a callback group of their own.
"""

from __future__ import annotations

from typing import Protocol

from robocomp_dsl.runtime.component.component_interface import COMPONENT
from robocomp_dsl.runtime.component.connections_servant import ConnectionsServant, WiredRunner
from robocomp_dsl.runtime.component.introspection import InspectedRunner, Introspection
from robocomp_dsl.runtime.connection.connections_interface import COMPONENTCONNECTIONS
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.dynamic.schema_interface import COMPONENTSCHEMA


class ServedRunner(InspectedRunner, WiredRunner, Protocol):
    """What the servants need of a runner."""


def serve_own_interfaces(runner: ServedRunner) -> None:
    """Serve what tools ask a component for."""
    introspection, servant = Introspection(runner), ConnectionsServant(runner)
    served = (
        (COMPONENT, introspection.handlers()),
        # An interface of its own: a new operation in `Component` would change its type hash.
        (COMPONENTSCHEMA, introspection.schema_handlers()),
        (COMPONENTCONNECTIONS, servant.handlers()),
    )
    for interface, handlers in served:
        at = Endpoint(interface, runner.name, "Component")
        runner.ports.serve(at, handlers, introspection.callback_group)
