"""The Python names of a bridge: those of its component, found by the names in the model.

The component is checked anew from the generated CDSL file, so its types are other objects than
those of the bridge; their qualified names are the same.
"""

from __future__ import annotations

from robocomp_dsl.generate import names
from robocomp_dsl.generate.python.component_names import PythonNames, names_of
from robocomp_dsl.generate.python.python_types import NUMPY, field_names, numpy_of
from robocomp_dsl.model.bridge import Bridge
from robocomp_dsl.model.bridge_ports import BridgePort
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.types import (
    Declaration,
    Enum,
    Field,
    Primitive,
    Sequence,
    Struct,
    Type,
)

LOCAL = names.ARGUMENTS | frozenset(("at", "user", "values", "np", "message"))
"""Names that functions of `mapping.py` use themselves."""


class BridgeNames:
    """The names for the generated code of one bridge.

    `variables` are local names of what the bridge declares, by their names in BDSL; `used` collects
    the types that expressions mention.
    """

    def __init__(self, bridge: Bridge, component: Component) -> None:
        self.python: PythonNames = names_of(component)
        self.used: set[str] = set()
        types = self.python.types.names
        self._types = {d.qualified: name for d, name in types.items() if _is_named(d)}
        self._enumerators = {
            (d.qualified, e.name): self.python.types.enumerator(e)
            for d in types
            if isinstance(d, Enum)
            for e in d.enumerators
        }
        self._ports = {port.name: port for port in component.ports}
        declared = [
            *(item.name for item in bridge.inputs),
            *(hub.name for hub in bridge.hubs),
            *(function.name for function in bridge.functions),
            *(item.name for action in bridge.actions for item in action.inputs),
            *(call.name for service in bridge.services for call in service.calls),
        ]
        reserved = LOCAL | names.BUILTINS | names.MODULE | set(types.values())
        unique = list(dict.fromkeys(declared))
        self.variables = dict(zip(unique, names.unique(unique, reserved), strict=True))

    def type_name(self, type_: Declaration) -> str:
        """The name of a struct, enum or named sequence, which `mapping.py` has to import."""
        name = self._types[type_.qualified]
        self.used.add(name)
        return name

    def annotation(self, type_: object) -> str:
        """The annotation of a value of a type; `Any` for what only expressions have."""
        if isinstance(type_, Sequence) and type_.is_anonymous:
            array = numpy_of(type_)
            return array.alias if array else f"list[{self.annotation(type_.element)}]"
        if isinstance(type_, Primitive):
            return self.python.types.annotation(type_)
        if isinstance(type_, Declaration) and type_.qualified in self._types:
            return self.type_name(type_)
        return "Any"

    def enumerator(self, type_: Enum, name: str) -> str:
        """`Color.red`."""
        return f"{self.type_name(type_)}.{self._enumerators[type_.qualified, name]}"

    def field(self, type_: object, field: Field) -> str:
        """The attribute of a field of a struct."""
        struct = struct_of(type_)
        index = next(i for i, other in enumerate(struct.fields) if other.name == field.name)
        return field_names(struct)[index]

    def handler(self, port: BridgePort) -> str:
        """The method that receives messages of a subscribed port, or requests of a served one."""
        own = self._ports[port.name]
        operation = next(o for o in own.interface.operations if o.name == port.operation.name)
        return self.python.handlers[own, operation]

    def call(self, port: BridgePort) -> str:
        """`motors_proxy.setPower`: the method of a called or published port."""
        own = self._ports[port.name]
        interface = self.python.interfaces[own.interface]
        method = {o.name: name for o, name in interface.methods.items()}[port.operation.name]
        return f"{self.python.proxies[own]}.{method}"


def _is_named(type_: Declaration) -> bool:
    return not (isinstance(type_, Sequence) and type_.is_anonymous)


def struct_of(type_: object) -> Struct:
    """A type that the checker has found to be a struct."""
    if not isinstance(type_, Struct):
        raise TypeError(f"{type_!r} is no struct")
    return type_


def element_dtype(type_: Type | object) -> str:
    """`np.float64` for a sequence of numbers or bools; "" for other types."""
    array = numpy_of(type_) if isinstance(type_, Sequence) else None
    return array.dtype if array else ""


def primitive_dtype(type_: Primitive) -> str:
    """The numpy type of a number."""
    return NUMPY[type_].dtype


def array_annotation(type_: Primitive) -> str:
    """The annotation of an array of numbers."""
    return NUMPY[type_].alias
