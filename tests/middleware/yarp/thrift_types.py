"""The interface of `thrift_peer/demo.thrift`, as the generator writes it."""

from __future__ import annotations

import numpy as np

from robocomp_dsl.runtime import types as rt


class Color(rt.Enum):
    RED = 0
    GREEN = 5
    BLUE = 6


class Point(rt.Struct):
    x: rt.Double = 0.0
    y: rt.Double = 0.0
    label: rt.String = ""


class Path(rt.Struct):
    points: list[Point] = rt.default()
    tags: dict[rt.String, rt.Int] = rt.default()
    closed: rt.Bool = False
    ids: rt.Int16Array = rt.default()
    color: Color = Color.RED
    start: Point = rt.default()


_COLORS = list[Color]
DEMO = rt.Interface(
    "demo::Demo",
    rt.Operation("add", inputs={"a": rt.Int, "b": rt.Int}, returns=rt.Int),
    rt.Operation("set_flag", inputs={"on": rt.Bool}, returns=rt.Bool),
    rt.Operation("go_home_now", rt.Pattern.COMMAND, inputs={"where_to": rt.Int}),
    rt.Operation("place", returns=rt.Int),
    rt.Operation("make_path", inputs={"start": Point, "xs": rt.Float64Array}, returns=Path),
    rt.Operation("measure_path", inputs={"path": Path}, returns=rt.Int),
    rt.Operation("reset", rt.Pattern.UNMARKED),
    rt.Operation(
        "get_long_method_name",
        inputs={"what": rt.String},
        returns=rt.String,
        defaults={"what": "x"},
    ),
    rt.Operation("next_number", inputs={"value": rt.Long}, returns=rt.Long),
    rt.Operation("twice", inputs={"value": rt.Double}, returns=rt.Double),
    rt.Operation("negated", inputs={"value": rt.Int8}, returns=rt.Int8),
    rt.Operation("half", inputs={"value": rt.Short}, returns=rt.Short),
    rt.Operation("reversed", inputs={"data": rt.UInt8Array}, returns=rt.UInt8Array),
    rt.Operation("names", returns=list[rt.String]),
    rt.Operation("table", returns=dict[rt.String, Point]),
    rt.Operation("paint", inputs={"color": Color}, returns=Color),
    rt.Operation("colors", inputs={"values": _COLORS}, returns=_COLORS),
    style="thrift",
)
PATHS = rt.Interface(
    "demo::Paths", rt.Operation("path", rt.Pattern.PUBLISH, {"path": Path}), style="thrift"
)


class DemoHandlers:
    """What the peer in C++ does, too."""

    def __init__(self) -> None:
        self.place = 0

    def go_home_now(self, where_to: int) -> None:
        self.place = where_to

    def make_path(self, start: Point, xs: list[float]) -> Path:
        points = [Point(x, 2 * x, "p") for x in xs]
        return Path(points, {"a": 1, "b": 2}, True, np.array([3, 4], np.int16), Color.BLUE, start)

    def measure_path(self, path: Path) -> int:
        points = 1000 * len(path.points) + 100 * path.tags["a"]
        return int(points + 10 * len(path.ids) + (5 if path.closed else 0) + path.start.x)

    def handlers(self) -> dict[str, object]:
        return {
            "add": lambda a, b: a + b,
            "set_flag": lambda on: on,
            "go_home_now": self.go_home_now,
            "place": lambda: self.place,
            "make_path": self.make_path,
            "measure_path": self.measure_path,
            "reset": lambda: None,
            "get_long_method_name": lambda what: what + "!",
            "next_number": lambda value: value + 1,
            "twice": lambda value: 2 * value,
            "negated": lambda value: -value,
            "half": lambda value: int(value / 2),
            "reversed": lambda data: data[::-1],
            "names": lambda: ["a", "b"],
            "table": lambda: {"k": Point(1.0, 2.0, "z")},
            "paint": lambda color: color,
            "colors": lambda values: values,
        }
