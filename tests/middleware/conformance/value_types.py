"""An interface that echoes every type of IDSL, and values of each, with their limits."""

from __future__ import annotations

import math
from typing import Annotated, Any

import numpy as np

from robocomp_dsl.runtime import types as rt


class Color(rt.Enum):
    RED = 0
    GREEN = 1
    BLUE = 7


class Point(rt.Struct):
    x: rt.Float = 0.0
    y: rt.Float = 0.0
    label: rt.Short = 0


class PointList(rt.StructArray[Point]):
    __slots__ = ()


class Reading(rt.Struct):
    name: rt.String = ""
    at: Point = rt.default()
    color: Color = Color.RED
    samples: rt.Float64Array = rt.default()
    notes: list[rt.String] = rt.default()
    valid: rt.Bool = False


class Tree(rt.Struct):
    readings: list[Reading] = rt.default()
    by_name: dict[rt.String, Reading] = rt.default()
    rows: list[rt.Int32Array] = rt.default()
    points: PointList = rt.default()


Samples = Annotated[rt.Float64Array, rt.MaxLength(10)]
Waypoints = Annotated[list[Point], rt.MaxLength(2)]


class Estimate(rt.Struct):
    """Unsigned numbers, fixed arrays and bounded sequences."""

    number: rt.UInt32 = 0
    covariance: Annotated[rt.Float64Array, rt.Length(36)] = rt.default()
    pixel: rt.UInt16 = 65535
    stamp: rt.UInt64 = 2**64 - 1
    raw: Annotated[rt.UInt16Array, rt.Length(3)] = rt.default()
    flags: Annotated[rt.BoolArray, rt.Length(2)] = rt.default()
    names: Annotated[list[rt.String], rt.Length(2)] = rt.default()
    colors: Annotated[list[Color], rt.Length(3)] = rt.default()
    corners: Annotated[list[Point], rt.Length(4)] = rt.default()
    history: Samples = rt.default()
    path: Waypoints = rt.default()


class Failure(rt.DeclaredError):
    reason: rt.String = ""
    codes: rt.Int32Array = rt.default()
    at: Reading = rt.default()
    color: Color = Color.RED


class PlainFailure(rt.DeclaredError):
    pass


TYPES: dict[str, Any] = {
    "bool": rt.BOOL,
    "byte": rt.BYTE,
    "short": rt.SHORT,
    "int": rt.INT,
    "long": rt.LONG,
    "unsigned_short": rt.UINT16,
    "unsigned_int": rt.UINT32,
    "unsigned_long": rt.UINT64,
    "float": rt.FLOAT,
    "double": rt.DOUBLE,
    "string": rt.STRING,
    "enum": Color,
    "struct": Reading,
    "nested": Tree,
    "estimate": Estimate,
    "bools": rt.Array(rt.BOOL),
    "bytes": rt.Array(rt.BYTE),
    "shorts": rt.Array(rt.SHORT),
    "ints": rt.Array(rt.INT),
    "longs": rt.Array(rt.LONG),
    "unsigned_shorts": rt.Array(rt.UINT16),
    "unsigned_ints": rt.Array(rt.UINT32),
    "unsigned_longs": rt.Array(rt.UINT64, bound=4),
    "floats": rt.Array(rt.FLOAT),
    "doubles": rt.Array(rt.DOUBLE),
    "strings": rt.Sequence(rt.STRING),
    "enums": rt.Sequence(Color),
    "structs": rt.Sequence(Reading),
    "points": PointList,
    "waypoints": rt.Sequence(Point, bound=2),
    "names": rt.Sequence(rt.STRING, bound=3),
    "rows": rt.Sequence(rt.Array(rt.DOUBLE)),
    "by_name": rt.Dictionary(rt.STRING, Reading),
    "by_number": rt.Dictionary(rt.INT, rt.STRING),
    "by_color": rt.Dictionary(Color, rt.Array(rt.FLOAT)),
}
"""One operation each, which returns its argument."""

_TEXT = "ñandú 机器人 🤖 \x00 \n e\u0301"
_CORNERS = [Point(1.5, -2.0, 3), Point(0.25, 1024.0, -32768)]
_POINTS = [Point(1.5, -2.0, 3), Point(0.0, 1e30, -32768)]
READING = Reading(_TEXT, _POINTS[0], Color.BLUE, np.array([1.0, math.inf]), ["", "two"], True)


def _array(*values: Any, dtype: Any) -> Any:
    return np.array(values, dtype)


ESTIMATE = Estimate(
    2**32 - 1,
    np.arange(36) / 7,
    1,
    2**63,
    _array(0, 1, 2**16 - 1, dtype=np.uint16),
    _array(True, False, dtype=np.bool_),
    ["", _TEXT],
    [Color.BLUE, Color.RED, Color.GREEN],
    [*_CORNERS, *_CORNERS],
    _array(1.5, math.inf, dtype=np.float64),
    _CORNERS[:1],
)

VALUES: dict[str, tuple[Any, ...]] = {
    "bool": (True, False),
    "byte": (0, 255),
    "short": (-(2**15), 2**15 - 1),
    "int": (-(2**31), 2**31 - 1),
    "long": (-(2**63), 2**63 - 1),
    "unsigned_short": (0, 2**16 - 1),
    "unsigned_int": (0, 2**32 - 1),
    "unsigned_long": (0, 2**64 - 1),
    "float": (-0.0, 1.5, math.inf, -math.inf, math.nan),
    "double": (1e-310, 1e308, math.inf, math.nan),
    "string": ("", _TEXT, "x" * 100_000),
    "enum": tuple(Color),
    "struct": (Reading(), READING),
    "nested": (
        Tree(),
        Tree(
            [READING, Reading()],
            {"": Reading(), _TEXT: READING},
            [_array(dtype=np.int32), _array(1, -1, dtype=np.int32)],
            PointList(_POINTS),
        ),
    ),
    "estimate": (Estimate(), ESTIMATE),
    "bools": (_array(dtype=np.bool_), _array(True, False, dtype=np.bool_)),
    "bytes": (_array(dtype=np.uint8), _array(0, 255, dtype=np.uint8)),
    "shorts": (_array(dtype=np.int16), _array(-(2**15), 2**15 - 1, dtype=np.int16)),
    "ints": (_array(dtype=np.int32), _array(-(2**31), 2**31 - 1, dtype=np.int32)),
    "longs": (_array(dtype=np.int64), _array(-(2**63), 2**63 - 1, dtype=np.int64)),
    "unsigned_shorts": (_array(dtype=np.uint16), _array(0, 2**16 - 1, dtype=np.uint16)),
    "unsigned_ints": (_array(dtype=np.uint32), _array(0, 2**32 - 1, dtype=np.uint32)),
    "unsigned_longs": (_array(dtype=np.uint64), _array(0, 2**64 - 1, dtype=np.uint64)),
    "floats": (_array(dtype=np.float32), _array(0, math.nan, -math.inf, dtype=np.float32)),
    "doubles": (_array(dtype=np.float64), _array(-0.0, math.nan, 1e308, dtype=np.float64)),
    "strings": ([], ["", _TEXT]),
    "enums": ([], list(Color)),
    "structs": ([], [Reading(), READING]),
    "points": (PointList(), PointList(_POINTS)),
    "waypoints": ([], _CORNERS),
    "names": ([], ["", _TEXT, "three"]),
    "rows": ([], [_array(dtype=np.float64), _array(1.5, dtype=np.float64)]),
    "by_name": ({}, {"": Reading(), _TEXT: READING}),
    "by_number": ({}, {-(2**31): "", 2**31 - 1: _TEXT}),
    "by_color": ({}, {Color.BLUE: _array(1.5, dtype=np.float32)}),
}

VALUE_ECHO = rt.Interface(
    "Test::ValueEcho",
    *(
        rt.Operation(name, inputs={"value": type_}, returns=type_, idempotent=True)
        for name, type_ in TYPES.items()
    ),
    rt.Operation(
        "several",
        inputs={"a": rt.Int, "text": rt.String, "points": PointList},
        returns=rt.Double,
        outputs={"reading": Reading, "color": Color, "names": list[rt.String]},
    ),
    rt.Operation("only_outputs", outputs={"first": rt.Int, "second": rt.String}),
    rt.Operation("unmarked", rt.Pattern.UNMARKED, inputs={"value": rt.Int}),
    rt.Operation("fail", inputs={"plain": rt.Bool}, throws=(Failure, PlainFailure)),
)
VALUE_NEWS = rt.Interface(
    "Test::ValueNews",
    *(rt.Operation(name, rt.Pattern.PUBLISH, {"value": type_}) for name, type_ in TYPES.items()),
    rt.Operation("several", rt.Pattern.PUBLISH, {"a": rt.Int, "tree": Tree, "n": rt.Long}),
    rt.Operation("nothing", rt.Pattern.PUBLISH),
    rt.Operation("unmarked", rt.Pattern.UNMARKED, {"value": rt.Int}),
)
VALUE_COMMANDS = rt.Interface(
    "Test::ValueCommands",
    *(rt.Operation(name, rt.Pattern.COMMAND, {"value": type_}) for name, type_ in TYPES.items()),
    rt.Operation("nothing", rt.Pattern.COMMAND),
)


def identical(a: Any, b: Any) -> bool:
    """Whether two values have the same types and contents; NaN is identical to NaN."""
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        has_nan = a.dtype.kind == "f"
        return a.dtype == b.dtype and np.array_equal(a, b, equal_nan=has_nan)
    if isinstance(a, float) and isinstance(b, float):
        both_nan = math.isnan(a) and math.isnan(b)
        return both_nan or (a == b and math.copysign(1, a) == math.copysign(1, b))
    if isinstance(a, rt.StructArray) and isinstance(b, rt.StructArray):
        return type(a) is type(b) and len(a) == len(b) and all(map(_same_struct, a, b))
    if isinstance(a, rt.Struct) and isinstance(b, rt.Struct):
        return type(a) is type(b) and _same_struct(a, b)
    if isinstance(a, list | tuple) and isinstance(b, list | tuple):
        return type(a) is type(b) and len(a) == len(b) and all(map(identical, a, b))
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(identical(value, b[key]) for key, value in a.items())
    return type(a) is type(b) and bool(a == b)


def _same_struct(a: rt.Struct, b: rt.Struct) -> bool:
    names: tuple[str, ...] = type(a).__match_args__
    return all(identical(getattr(a, name), getattr(b, name)) for name in names)
