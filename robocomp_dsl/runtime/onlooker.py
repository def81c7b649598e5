"""A program's place in a running deployment: what its components serve and publish.

In: the name of a domain, interfaces as components' own generated modules have them. Out: their
operations as functions, and calls of handlers. The program is no component: nobody sees it.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

from robocomp_dsl.runtime.component_interface import COMPONENT, ComponentProxy
from robocomp_dsl.runtime.execution import Execution
from robocomp_dsl.runtime.interface import Interface
from robocomp_dsl.runtime.middleware import open_middleware
from robocomp_dsl.runtime.middleware.base import Endpoint, Host, Link
from robocomp_dsl.runtime.statistics import Statistics


class Onlooker:
    """Connections into one domain; `close` them at the end. `name` is for messages to people."""

    def __init__(self, domain: str, middleware: str = "zenoh", name: str = "onlooker") -> None:
        self._name, self._execution = name, Execution()
        host = Host(name, domain, self._execution, Statistics())
        self._middleware = open_middleware(middleware, host)

    def component(self, name: str) -> ComponentProxy:
        """What the component called `name` tells of itself."""
        return ComponentProxy(self.link(COMPONENT, name, "Component"))

    def calls(self, interface: Interface, component: str, port: str) -> Any:
        """The operations of a component's port, as functions of their names."""
        link = self.link(interface, component, port)
        return SimpleNamespace(**{one.name: link.bind(one) for one in interface.operations})

    def hear(
        self,
        interface: Interface,
        component: str,
        port: str,
        handlers: Mapping[str, Callable[..., Any]],
    ) -> None:
        """Call handlers, by the names of operations, with what the component publishes."""
        at = Endpoint(interface, self._name, port, (component,))
        self._middleware.subscribe(at, handlers, self._execution)

    def link(self, interface: Interface, component: str, port: str) -> Link:
        """What a proxy of that port stands on; no component: the only one that serves it."""
        peers = (f"{component}.{port}",) if component else ()
        return self._middleware.proxy(Endpoint(interface, self._name, port, peers))

    def close(self) -> None:
        """Leave the domain."""
        self._middleware.close()


def interfaces(folder: Path) -> ModuleType:
    """The generated interfaces of the component in `folder`, under a name of their own.

    Raises `FileNotFoundError`.
    """
    name = f"{folder.name}_interfaces"
    if name not in sys.modules:
        spec = spec_from_file_location(name, folder / "generated" / "interfaces.py")
        assert spec is not None  # noqa: S101 - the file's name ends in .py
        assert spec.loader is not None  # noqa: S101
        module = module_from_spec(spec)
        spec.loader.exec_module(module)
        sys.modules[name] = module
    return sys.modules[name]
