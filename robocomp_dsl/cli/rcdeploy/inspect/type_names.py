"""Names of types and signatures of operations, as users read them. In: types. Out: texts."""

from __future__ import annotations

from robocomp_dsl.client import DescribedPort
from robocomp_dsl.runtime.data.arrays import StructArray
from robocomp_dsl.runtime.data.schema import Array, Dictionary, Primitive, Sequence, Type
from robocomp_dsl.runtime.data.type_hash import sequence_shape, type_shape
from robocomp_dsl.runtime.dynamic.schema_interface import FieldInfo, OperationInfo


def type_name(type_: Type) -> str:
    """`double`, `sequence<Pose>`, `Pose`."""
    match type_:
        case Primitive():
            return type_shape(type_)
        case Array() | Sequence():
            return sequence_shape(type_, type_name(type_.element))
        case Dictionary():
            return f"dictionary<{type_name(type_.key)},{type_name(type_.value)}>"
    if issubclass(type_, StructArray):
        return f"sequence<{type_._element_.__name__}>"
    return type_.__name__


def signature(operation: OperationInfo) -> str:
    """`double getX(int joint [rad], out Pose pose)`; `void` without a result."""
    outputs = list(operation.outputs)
    result = outputs.pop(0).type if outputs and not outputs[0].name else "void"
    parameters = [_parameter(info) for info in operation.inputs]
    parameters += [f"out {_parameter(info)}" for info in outputs]
    throws = f" throws {', '.join(operation.throws)}" if operation.throws else ""
    return f"{result} {operation.name}({', '.join(parameters)}){throws}"


def _parameter(info: FieldInfo) -> str:
    return f"{info.type} {info.name}" + (f" [{info.unit}]" if info.unit else "")


def operations_of(port: DescribedPort) -> str:
    """Names of the operations of a port."""
    return ", ".join(operation.name for operation in port.interface.operations)
