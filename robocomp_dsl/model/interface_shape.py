"""The canonical form of operations, as `runtime/data/type_hash.py` writes it for generated code.

In: operations. Out: their shapes; peers understand each other if the shapes are equal.
"""

from __future__ import annotations

from collections.abc import Iterable

from robocomp_dsl.model import types
from robocomp_dsl.model.interface import Interface, Operation, Param

_NAMES = {types.UINT16: "uint16", types.UINT32: "uint32", types.UINT64: "uint64"}


class InterfaceShapes:
    """Computes shapes; each type once."""

    def __init__(self) -> None:
        self._known: dict[int, tuple[types.Declaration, str]] = {}

    def of(self, interface: Interface) -> dict[str, str]:
        """The shape of each operation by name."""
        return {operation.name: self.of_operation(operation) for operation in interface.operations}

    def of_operation(self, operation: Operation) -> str:
        """The shape of one operation."""
        result = [f":{self.of_type(operation.result)}"] if operation.result else []
        outputs = ",".join([*result, *self._members(operation.outputs)])
        throws = ",".join(self.of_type(exception) for exception in operation.throws)
        inputs = ",".join(self._members(operation.inputs))
        return f"{operation.pattern} {operation.name}({inputs})->({outputs}) throws({throws})"

    def of_type(self, type_: types.Type | types.ExceptionType) -> str:
        """The shape of a type."""
        if isinstance(type_, types.Primitive):
            return f"string<{type_.bound}>" if type_.bound else _NAMES.get(type_, type_.name)
        known = self._known.get(id(type_))
        if known is None:  # the type is kept, so that its id stays its own
            known = self._known[id(type_)] = (type_, self._declared(type_))
        return known[1]

    def _declared(self, type_: types.Declaration) -> str:
        match type_:
            case types.Sequence():
                element = self.of_type(type_.element)
                if type_.size:
                    return f"array<{element},{type_.size}>"
                return f"sequence<{element}{f',{type_.bound}' if type_.bound else ''}>"
            case types.Dictionary():
                return f"dictionary<{self.of_type(type_.key)},{self.of_type(type_.value)}>"
            case types.Struct() | types.ExceptionType():
                # ROS hashes its types itself, without units.
                is_ros = isinstance(type_, types.Struct) and bool(type_.ros_name)
                fields = self._members(type_.fields, with_units=not is_ros)
                return f"struct{{{','.join(fields)}}}"
            case types.Enum():
                values = (f"{e.name.rstrip('_')}={e.value}" for e in type_.enumerators)
                return f"enum{{{','.join(values)}}}"
        raise TypeError(f"{type_.qualified} is no data type")

    def _members(
        self, members: Iterable[types.Field | Param], *, with_units: bool = True
    ) -> list[str]:
        return [
            f"{m.name}:{self.of_type(m.type)}{f'[{m.unit}]' if m.unit and with_units else ''}"
            for m in members
        ]
