"""A look at the running deployment from outside, as any program of the domain can take it.

In: the name of a domain. Out: proxies of the introspection interface that every component serves,
and of what the path logger has recorded.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Any

from robocomp_dsl.runtime.component_interface import COMPONENT, ComponentProxy
from robocomp_dsl.runtime.execution import Execution
from robocomp_dsl.runtime.interface import Interface
from robocomp_dsl.runtime.middleware import open_middleware
from robocomp_dsl.runtime.middleware.base import Endpoint, Host, Link
from robocomp_dsl.runtime.statistics import Statistics

LOGGER = Path(__file__).parents[1] / "path_logger" / "generated" / "interfaces.py"


class Observer:
    """Proxies of one domain; `close` it at the end."""

    def __init__(self, domain: str) -> None:
        self._host = Host("observer", domain, Execution(), Statistics())
        self._middleware = open_middleware("zenoh", self._host)

    def component(self, name: str) -> ComponentProxy:
        """What the component called `name` tells of itself."""
        return ComponentProxy(self._link(COMPONENT, name, "Component"))

    def path(self, name: str = "path_logger") -> Callable[[], Any]:
        """Asks the logger called `name` for the `PathSummary` of what it has recorded."""
        interface = _generated(LOGGER).PATHLOG
        (get_summary,) = interface.operations
        return self._link(interface, name, "PathLog").bind(get_summary)

    def _link(self, interface: Interface, component: str, port: str) -> Link:
        return self._middleware.proxy(Endpoint(interface, "observer", port, (component,)))

    def close(self) -> None:
        """Leave the domain."""
        self._middleware.close()


def _generated(path: Path) -> ModuleType:
    """The generated interfaces of another component, under a name of their own."""
    name = f"{path.parents[1].name}_interfaces"
    if name not in sys.modules:
        spec = spec_from_file_location(name, path)
        if spec is None or spec.loader is None:
            raise ImportError(f"there are no interfaces at {path}")
        sys.modules[name] = module_from_spec(spec)
        spec.loader.exec_module(sys.modules[name])
    return sys.modules[name]
