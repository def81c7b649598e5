"""The Python names of a component.

In: a component. Out: `PythonNames`: the names of its types, interfaces, proxies and methods.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from robocomp_dsl.generate import names
from robocomp_dsl.generate.python.machine_code import method_names
from robocomp_dsl.generate.python.python_types import PythonTypes
from robocomp_dsl.model.component import Component, Port, Role
from robocomp_dsl.model.interface import Interface, Module, Operation
from robocomp_dsl.record import ValueRecord

SERVED_ROLES = (Role.IMPLEMENTS, Role.SUBSCRIBES)
"""The roles of ports that other components call."""


class InterfaceNames(ValueRecord):
    """The names of an interface in the other generated modules."""

    constant: str
    proxy: str
    methods: dict[Operation, str]


def name_interfaces(
    interfaces: Iterable[Interface], types: PythonTypes
) -> dict[Interface, InterfaceNames]:
    """Names for the interfaces of a component that differ from all type names."""
    interface_list = list(interfaces)
    count = Counter(i.name for i in interface_list)
    found = {}
    for interface in interface_list:
        name = (
            f"{interface.module}_{interface.name}" if count[interface.name] > 1 else interface.name
        )
        found[interface] = InterfaceNames(
            types.scope.claim(name.upper()),
            types.scope.claim(f"{name}Proxy"),
            _method_names(interface, types),
        )
    return found


def _method_names(interface: Interface, types: PythonTypes) -> dict[Operation, str]:
    reserved = names.PROXY_MEMBERS | names.ANNOTATION | set(types.names.values())
    method_names_ = names.unique([o.name for o in interface.operations], reserved)
    return dict(zip(interface.operations, method_names_, strict=True))


class PythonNames(ValueRecord):
    """All names of one component."""

    package: str
    types: PythonTypes
    interfaces: dict[Interface, InterfaceNames]
    handlers: dict[tuple[Port, Operation], str]
    proxies: dict[Port, str]
    params: str


def members(
    component: Component, types: PythonTypes, interfaces: dict[Interface, InterfaceNames]
) -> PythonNames:
    """Names for the methods and proxies; none hides a type or a member of the base class."""
    params = types.scope.claim(f"{names.camel(component.name)}Params")
    ref = component.statemachine
    states = method_names(ref.machine) if ref and ref.machine else set()
    scope = names.NameScope(names.COMPONENT_MEMBERS | types.scope.taken | states)
    served = [p for p in component.ports if p.role in SERVED_ROLES]
    proxies = {
        p: scope.claim(f"{p.name.lower()}_proxy") for p in component.ports if p not in served
    }
    handlers = {(p, o): scope.claim(f"{p.name}_{o.name}") for p in served for o in p.operations}
    package = names.package_of(component.name)
    return PythonNames(package, types, interfaces, handlers, proxies, params)


def names_of(component: Component) -> PythonNames:
    """All Python names of a component."""
    types = PythonTypes(modules_of(component))
    interfaces = name_interfaces(dict.fromkeys(p.interface for p in component.ports), types)
    return members(component, types, interfaces)


def modules_of(component: Component) -> tuple[Module, ...]:
    """All directly or indirectly imported modules, imported ones first."""
    found = (m for module in component.modules for m in module.closure())
    return tuple(dict.fromkeys(found))
