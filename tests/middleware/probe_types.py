"""An interface with one operation of every kind, as `rcgen` would generate it."""

from __future__ import annotations

from robocomp_dsl.runtime import types as rt


class Broken(rt.DeclaredError):
    code: rt.Int = 0
    what: rt.String = ""


PROBE = rt.Interface(
    "Test::Probe",
    rt.Operation("add", inputs={"a": rt.Int, "b": rt.Int}, returns=rt.Int),
    rt.Operation(
        "divide",
        inputs={"a": rt.Int, "b": rt.Int},
        returns=rt.Int,
        outputs={"rest": rt.Int},
        throws=(Broken,),
    ),
    rt.Operation("nothing"),
    rt.Operation("echo", inputs={"v": rt.Float32Array}, returns=rt.Float32Array, idempotent=True),
    rt.Operation("fail"),
    rt.Operation("nested", inputs={"depth": rt.Int}, returns=rt.Int),
    rt.Operation("block"),
    rt.Operation("note", rt.Pattern.COMMAND, inputs={"text": rt.String}),
)
NEWS = rt.Interface(
    "Test::News",
    rt.Operation("announced", rt.Pattern.PUBLISH, inputs={"who": rt.String, "n": rt.Int}),
)
OTHER_NEWS = rt.Interface(
    "Test::News", rt.Operation("announced", rt.Pattern.PUBLISH, inputs={"who": rt.String})
)
OTHER_PROBE = rt.Interface("Test::Probe", *PROBE.operations[:1])


class ProbeProxy(rt.Proxy):
    __slots__ = ()
    INTERFACE = PROBE

    def add(self, a: int, b: int) -> int:
        return self._call("add", a, b)

    def divide(self, a: int, b: int) -> tuple[int, int]:
        return self._call("divide", a, b)

    def nothing(self) -> None:
        self._call("nothing")

    def echo(self, v: rt.Float32Array) -> rt.Float32Array:
        return self._call("echo", v)

    def fail(self) -> None:
        self._call("fail")

    def nested(self, depth: int) -> int:
        return self._call("nested", depth)

    def block(self) -> None:
        self._call("block")

    def note(self, text: str) -> None:
        self._call("note", text)


class NewsProxy(rt.Proxy):
    __slots__ = ()
    INTERFACE = NEWS

    def announced(self, who: str, n: int) -> None:
        self._call("announced", who, n)
