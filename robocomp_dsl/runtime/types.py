"""The names that generated code uses, imported as `rt`.

Declarations of types (`Struct`, `Enum`, `StructArray`, …), annotations that name the type on the
wire (`Int`, `String`, `Float32Array`, …), wire types as objects (`INT`, `STRING`, `Array`, …),
interfaces, and the failures that users catch.
"""

from __future__ import annotations

from typing import Annotated, TypeAlias

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.runtime.component.interface import Interface, Operation, Pattern
from robocomp_dsl.runtime.component.proxy import Proxy
from robocomp_dsl.runtime.data.arrays import Column, NestedColumn, StructArray
from robocomp_dsl.runtime.data.schema import (
    BOOL,
    BYTE,
    DOUBLE,
    FLOAT,
    INT,
    INT8,
    LONG,
    OCTET,
    SHORT,
    STRING,
    UINT16,
    UINT32,
    UINT64,
    Array,
    Dictionary,
    Enum,
    Length,
    MaxLength,
    Primitive,
    Sequence,
    Type,
)
from robocomp_dsl.runtime.data.struct import Struct, default
from robocomp_dsl.runtime.errors import (
    AmbiguousServer,
    CallRejected,
    DeclaredError,
    EncodeError,
    InterfaceMismatch,
    MalformedMessage,
    MiddlewareError,
    NoServer,
    NotImplementedOperation,
    NotPublishable,
    RemoteError,
    Timeout,
)

Bool: TypeAlias = Annotated[bool, BOOL]
Byte: TypeAlias = Annotated[int, BYTE]
Short: TypeAlias = Annotated[int, SHORT]
Int: TypeAlias = Annotated[int, INT]
Long: TypeAlias = Annotated[int, LONG]
Float: TypeAlias = Annotated[float, FLOAT]
Double: TypeAlias = Annotated[float, DOUBLE]
String: TypeAlias = Annotated[str, STRING]
# Only imported ROS types have these.
Int8: TypeAlias = Annotated[int, INT8]
Octet: TypeAlias = Annotated[int, OCTET]
UInt16: TypeAlias = Annotated[int, UINT16]
UInt32: TypeAlias = Annotated[int, UINT32]
UInt64: TypeAlias = Annotated[int, UINT64]

BoolArray: TypeAlias = Annotated[NDArray[np.bool_], Array(BOOL)]
UInt8Array: TypeAlias = Annotated[NDArray[np.uint8], Array(BYTE)]
Int16Array: TypeAlias = Annotated[NDArray[np.int16], Array(SHORT)]
Int32Array: TypeAlias = Annotated[NDArray[np.int32], Array(INT)]
Int64Array: TypeAlias = Annotated[NDArray[np.int64], Array(LONG)]
Int8Array: TypeAlias = Annotated[NDArray[np.int8], Array(INT8)]
OctetArray: TypeAlias = Annotated[NDArray[np.uint8], Array(OCTET)]
UInt16Array: TypeAlias = Annotated[NDArray[np.uint16], Array(UINT16)]
UInt32Array: TypeAlias = Annotated[NDArray[np.uint32], Array(UINT32)]
UInt64Array: TypeAlias = Annotated[NDArray[np.uint64], Array(UINT64)]
Float32Array: TypeAlias = Annotated[NDArray[np.float32], Array(FLOAT)]
Float64Array: TypeAlias = Annotated[NDArray[np.float64], Array(DOUBLE)]

BoolColumn: TypeAlias = Column[np.bool_]
UInt8Column: TypeAlias = Column[np.uint8]
Int16Column: TypeAlias = Column[np.int16]
Int32Column: TypeAlias = Column[np.int32]
Int64Column: TypeAlias = Column[np.int64]
Int8Column: TypeAlias = Column[np.int8]
OctetColumn: TypeAlias = Column[np.uint8]
UInt16Column: TypeAlias = Column[np.uint16]
UInt32Column: TypeAlias = Column[np.uint32]
UInt64Column: TypeAlias = Column[np.uint64]
Float32Column: TypeAlias = Column[np.float32]
Float64Column: TypeAlias = Column[np.float64]

__all__ = [
    "BOOL",
    "BYTE",
    "DOUBLE",
    "FLOAT",
    "INT",
    "INT8",
    "LONG",
    "OCTET",
    "SHORT",
    "STRING",
    "UINT16",
    "UINT32",
    "UINT64",
    "AmbiguousServer",
    "Array",
    "Bool",
    "BoolArray",
    "BoolColumn",
    "Byte",
    "CallRejected",
    "Column",
    "DeclaredError",
    "Dictionary",
    "Double",
    "EncodeError",
    "Enum",
    "Float",
    "Float32Array",
    "Float32Column",
    "Float64Array",
    "Float64Column",
    "Int",
    "Int8",
    "Int8Array",
    "Int8Column",
    "Int16Array",
    "Int16Column",
    "Int32Array",
    "Int32Column",
    "Int64Array",
    "Int64Column",
    "Interface",
    "InterfaceMismatch",
    "Length",
    "Long",
    "MalformedMessage",
    "MaxLength",
    "MiddlewareError",
    "NestedColumn",
    "NoServer",
    "NotImplementedOperation",
    "NotPublishable",
    "Octet",
    "OctetArray",
    "OctetColumn",
    "Operation",
    "Pattern",
    "Primitive",
    "Proxy",
    "RemoteError",
    "Sequence",
    "Short",
    "String",
    "Struct",
    "StructArray",
    "Timeout",
    "Type",
    "UInt8Array",
    "UInt8Column",
    "UInt16",
    "UInt16Array",
    "UInt16Column",
    "UInt32",
    "UInt32Array",
    "UInt32Column",
    "UInt64",
    "UInt64Array",
    "UInt64Column",
    "default",
]
