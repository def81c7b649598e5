"""Client of a running deployment: calls and subscribes from a program that is not a component.

In: the name of a domain, and interfaces: of generated modules, or of the schema that a running
component serves. Out: functions that call operations, and calls of handlers. Components do not see
the program. `robocomp_dsl.client` is the public name of this module.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from dataclasses import replace
from importlib import import_module
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType, SimpleNamespace, TracebackType
from typing import TYPE_CHECKING, Any, Self

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.component_interface import COMPONENT, ComponentProxy
from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import Channel, ComponentContext
from robocomp_dsl.runtime.connection.publisher_follower import PublisherFollower
from robocomp_dsl.runtime.connection.usable_records import middlewares_of_subscribers
from robocomp_dsl.runtime.errors import NoServer, SchemaError

if TYPE_CHECKING:
    from robocomp_dsl.runtime.dynamic.description import ComponentDescription

_SCHEMA_TIMEOUT_S = 1.0
"""A component serves its schema at the same moment as the interface `Component`."""


class DomainClient:
    """Connections to one domain; call `close` at the end. `name` appears in messages."""

    def __init__(self, domain: str, middleware: str = "zenoh", name: str = "client") -> None:
        self._name, self._execution = name, CallbackGroup()
        self.statistics = Statistics()
        host = ComponentContext(name, domain, self._execution, self.statistics)
        self._middleware = open_ports(middleware, host)

    def components(self, timeout: float = 1.0) -> list[str]:
        """The names of the components in the domain; waits at most `timeout` s for a name."""
        return self._middleware.find_servers(COMPONENT, timeout)

    def component(self, name: str) -> ComponentProxy:
        """A proxy of the interface `Component` of the component `name`."""
        return ComponentProxy(self.channel(COMPONENT, name, "Component"))

    def describe(self, component: str, timeout: float = 5.0) -> ComponentDescription:
        """Ports, interfaces and types of a running component, without generated code.

        Waits up to `timeout` s. Raises `NoServer` if there is no such component, `SchemaError` if
        it serves no schema, as components of older versions, and `Timeout` if it does not reply.
        """
        # Programs that have generated code load none of this.
        from robocomp_dsl.runtime.dynamic.description import describe_component  # noqa: PLC0415
        from robocomp_dsl.runtime.dynamic.schema_interface import (  # noqa: PLC0415
            COMPONENTSCHEMA,
            ComponentSchemaProxy,
        )

        about = self.component(component)
        about.set_timeout(timeout)
        if not about.wait_for_server(timeout):
            raise NoServer(f"there is no component `{component}` in this domain")
        info = about.getInfo()
        proxy = ComponentSchemaProxy(self.channel(COMPONENTSCHEMA, component, "Component"))
        proxy.set_timeout(timeout)
        if not proxy.wait_for_server(min(timeout, _SCHEMA_TIMEOUT_S)):
            raise SchemaError(
                f"`{component}` does not serve its schema (Component.getInterfaces): it runs with"
                " an older version of robocomp_dsl; update it and start it again"
            )
        try:
            return describe_component(info, proxy.getInterfaces())
        except SchemaError as error:
            raise SchemaError(f"the schema of `{component}` is invalid: {error}") from None

    def operations(self, interface: Interface, component: str, port: str) -> Any:
        """The operations of a component's port, as attributes by operation name."""
        link = self.channel(interface, component, port)
        return SimpleNamespace(
            **{operation.name: link.bind(operation) for operation in interface.operations}
        )

    def subscribe(
        self,
        interface: Interface,
        component: str,
        port: str,
        handlers: Mapping[str, Callable[..., Any]],
    ) -> None:
        """Subscribe to a port, on its middlewares; `handlers` are called by operation name.

        The component may start later.
        """
        at = Endpoint(interface, self._name, port, (component,))
        PublisherFollower(self._middleware, at, handlers, self._execution)

    def channel(self, interface: Interface, component: str, port: str) -> Channel:
        """The channel of a port; with an empty component, of the only server."""
        peers = (f"{component}.{port}",) if component else ()
        return self._middleware.proxy(Endpoint(interface, self._name, port, peers))

    def publisher(self, interface: Interface, component: str, port: str) -> Channel:
        """A channel that publishes what subscribers take for messages of a component's port.

        It reaches subscribers on the middlewares of those that exist now.
        """
        at = Endpoint(interface, component, port)
        middlewares = middlewares_of_subscribers(at, self._middleware.presence)
        return self._middleware.advertise(replace(at, middlewares=middlewares))

    def close(self) -> None:
        """Leave the domain."""
        self._middleware.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: object, trace: TracebackType | None
    ) -> None:
        self.close()


def load_generated_interfaces(folder: Path) -> ModuleType:
    """Load the generated interfaces of the component in `folder` without changing `sys.path`.

    Raises `FileNotFoundError` if it has none, or several.
    """
    found = sorted(folder.glob("*_generated/interfaces.py"))
    if len(found) != 1:
        listed = ", ".join(str(package_folder.parent) for package_folder in found) or "none"
        raise FileNotFoundError(f"{folder} must hold one generated package; there is {listed}")
    package = found[0].parent.resolve()
    known = sys.modules.get(package.name)
    if known is None or [Path(package_folder).resolve() for package_folder in known.__path__] != [
        package
    ]:
        _forget(package.name)
        _load(package.name, package / "__init__.py", search=[str(package)])
    return import_module(f"{package.name}.interfaces")


def _forget(package: str) -> None:
    """A package of the same name was already loaded from another folder."""
    for name in [
        module for module in sys.modules if module == package or module.startswith(f"{package}.")
    ]:
        del sys.modules[name]


def _load(name: str, path: Path, search: list[str]) -> None:
    spec = spec_from_file_location(name, path, submodule_search_locations=search)
    assert spec is not None  # noqa: S101 - the file's name ends in .py
    assert spec.loader is not None  # noqa: S101
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    sys.modules[name] = module
