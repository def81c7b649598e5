"""Client of a running deployment: calls and subscribes from a program that is not a component.

In: the name of a domain, interfaces of generated modules. Out: functions that call operations, and
calls of handlers. Components do not see the program.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from importlib import import_module
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.component.component_interface import COMPONENT, ComponentProxy
from robocomp_dsl.runtime.component.interface import Interface
from robocomp_dsl.runtime.component.statistics import Statistics
from robocomp_dsl.runtime.middleware.base import Channel, Endpoint, MiddlewareContext
from robocomp_dsl.runtime.middleware.registry import open_middleware


class DomainClient:
    """Connections to one domain; call `close` at the end. `name` appears in messages."""

    def __init__(self, domain: str, middleware: str = "zenoh", name: str = "client") -> None:
        self._name, self._execution = name, CallbackGroup()
        host = MiddlewareContext(name, domain, self._execution, Statistics())
        self._middleware = open_middleware(middleware, host)

    def component(self, name: str) -> ComponentProxy:
        """A proxy of the interface `Component` of the component `name`."""
        return ComponentProxy(self.channel(COMPONENT, name, "Component"))

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
        """Subscribe to a port; `handlers` are called by operation name."""
        at = Endpoint(interface, self._name, port, (component,))
        self._middleware.subscribe(at, handlers, self._execution)

    def channel(self, interface: Interface, component: str, port: str) -> Channel:
        """The channel of a port; with an empty component, of the only server."""
        peers = (f"{component}.{port}",) if component else ()
        return self._middleware.proxy(Endpoint(interface, self._name, port, peers))

    def close(self) -> None:
        """Leave the domain."""
        self._middleware.close()


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
