"""What generated code is written in, imported by it as `rt`.

Declarations of types (`Struct`, `Enum`, `StructArray`, …), wire types (`INT`, `STRING`, `Array`,
…), annotations (`Float32Array`, …), interfaces, and the failures that users catch.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.runtime.arrays import StructArray
from robocomp_dsl.runtime.errors import (
    AmbiguousServer,
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
from robocomp_dsl.runtime.interface import Interface, Operation, Pattern
from robocomp_dsl.runtime.proxy import Proxy
from robocomp_dsl.runtime.record import Record, Struct
from robocomp_dsl.runtime.schema import (
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

BoolArray: TypeAlias = NDArray[np.bool_]
UInt8Array: TypeAlias = NDArray[np.uint8]
Int16Array: TypeAlias = NDArray[np.int16]
Int32Array: TypeAlias = NDArray[np.int32]
Int64Array: TypeAlias = NDArray[np.int64]
Float32Array: TypeAlias = NDArray[np.float32]
Float64Array: TypeAlias = NDArray[np.float64]

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
    "BoolArray",
    "DeclaredError",
    "Dictionary",
    "EncodeError",
    "Enum",
    "Float32Array",
    "Float64Array",
    "Int16Array",
    "Int32Array",
    "Int64Array",
    "Interface",
    "InterfaceMismatch",
    "MalformedMessage",
    "MiddlewareError",
    "NoServer",
    "NotImplementedOperation",
    "Operation",
    "Pattern",
    "Primitive",
    "Proxy",
    "Record",
    "RemoteError",
    "Sequence",
    "Struct",
    "StructArray",
    "Timeout",
    "Type",
    "UInt8Array",
]
