"""An interface with one operation of every kind, as `rcgen` would generate it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from robocomp_dsl.runtime import types as rt


class Broken(rt.DeclaredError):
    __slots__ = ("code", "what")
    _fields_ = (("code", rt.INT), ("what", rt.STRING))

    def __init__(self, code: int = 0, what: str = "") -> None:
        self.code = code
        self.what = what


FLOATS = rt.Array(rt.FLOAT)
PROBE = rt.Interface(
    "Test::Probe",
    (
        rt.Operation("add", rt.Pattern.QUERY, (("a", rt.INT), ("b", rt.INT)), (("", rt.INT),)),
        rt.Operation(
            "divide",
            rt.Pattern.QUERY,
            (("a", rt.INT), ("b", rt.INT)),
            (("", rt.INT), ("rest", rt.INT)),
            (Broken,),
        ),
        rt.Operation("nothing", rt.Pattern.QUERY),
        rt.Operation("echo", rt.Pattern.QUERY, (("v", FLOATS),), (("", FLOATS),), idempotent=True),
        rt.Operation("fail", rt.Pattern.QUERY),
        rt.Operation("nested", rt.Pattern.QUERY, (("depth", rt.INT),), (("", rt.INT),)),
        rt.Operation("block", rt.Pattern.QUERY),
        rt.Operation("note", rt.Pattern.COMMAND, (("text", rt.STRING),)),
    ),
)
NEWS = rt.Interface(
    "Test::News", (rt.Operation("said", rt.Pattern.PUBLISH, (("who", rt.STRING), ("n", rt.INT))),)
)
OTHER_NEWS = rt.Interface(
    "Test::News", (rt.Operation("said", rt.Pattern.PUBLISH, (("who", rt.STRING),)),)
)
OTHER_PROBE = rt.Interface("Test::Probe", PROBE.operations[:1])


class ProbeProxy(rt.Proxy):
    __slots__ = tuple(operation.name for operation in PROBE.operations)
    INTERFACE = PROBE
    add: Callable[..., int]
    divide: Callable[..., tuple[int, int]]
    nothing: Callable[..., None]
    echo: Callable[..., Any]
    fail: Callable[..., None]
    nested: Callable[..., int]
    block: Callable[..., None]
    note: Callable[..., None]

    def _bind(self, bind: Callable[[rt.Operation], Callable[..., Any]]) -> None:
        for operation in PROBE.operations:
            setattr(self, operation.name, bind(operation))


class NewsProxy(rt.Proxy):
    __slots__ = ("said",)
    INTERFACE = NEWS
    said: Callable[..., None]

    def _bind(self, bind: Callable[[rt.Operation], Callable[..., Any]]) -> None:
        self.said = bind(NEWS.operations[0])
