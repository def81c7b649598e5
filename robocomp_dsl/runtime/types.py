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
    LONG,
    SHORT,
    STRING,
    Array,
    Dictionary,
    Enum,
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

BoolArray: TypeAlias = Annotated[NDArray[np.bool_], Array(BOOL)]
UInt8Array: TypeAlias = Annotated[NDArray[np.uint8], Array(BYTE)]
Int16Array: TypeAlias = Annotated[NDArray[np.int16], Array(SHORT)]
Int32Array: TypeAlias = Annotated[NDArray[np.int32], Array(INT)]
Int64Array: TypeAlias = Annotated[NDArray[np.int64], Array(LONG)]
Float32Array: TypeAlias = Annotated[NDArray[np.float32], Array(FLOAT)]
Float64Array: TypeAlias = Annotated[NDArray[np.float64], Array(DOUBLE)]

BoolColumn: TypeAlias = Column[np.bool_]
UInt8Column: TypeAlias = Column[np.uint8]
Int16Column: TypeAlias = Column[np.int16]
Int32Column: TypeAlias = Column[np.int32]
Int64Column: TypeAlias = Column[np.int64]
Float32Column: TypeAlias = Column[np.float32]
Float64Column: TypeAlias = Column[np.float64]

__all__ = [
    "BOOL",
    "BYTE",
    "DOUBLE",
    "FLOAT",
    "INT",
    "LONG",
    "SHORT",
    "STRING",
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
    "Int16Array",
    "Int16Column",
    "Int32Array",
    "Int32Column",
    "Int64Array",
    "Int64Column",
    "Interface",
    "InterfaceMismatch",
    "Long",
    "MalformedMessage",
    "MiddlewareError",
    "NestedColumn",
    "NoServer",
    "NotImplementedOperation",
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
    "default",
]
