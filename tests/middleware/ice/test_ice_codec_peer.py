"""ZeroC's Ice gives the same bytes for random types and values, and reads those of the codec."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.codec.ice import codec, wire
from tests.middleware.ice.peers import Ice
from tests.runtime.random_schemas import slice_types, struct_of, values

pytestmark = pytest.mark.peers
_serial = itertools.count()
PRIMITIVES = {rt.LONG: "long", rt.INT: "int", rt.SHORT: "short", rt.BYTE: "byte", rt.BOOL: "bool"}
PRIMITIVES |= {rt.FLOAT: "float", rt.DOUBLE: "double", rt.STRING: "string"}


class SliceModule:
    """Types declared to Ice in its own language."""

    def __init__(self) -> None:
        self.name = f"Random{next(_serial)}"
        self.declarations: list[str] = []
        self.names: dict[Any, str] = {}

    def declare(self, pattern: str) -> str:
        name = f"T{len(self.declarations)}"
        self.declarations.append(pattern.replace("NAME", name))
        return name

    def type_name(self, type_: Any) -> str:
        """The name of a type, declared on first use."""
        if isinstance(type_, rt.Primitive):
            return PRIMITIVES[type_]
        if isinstance(type_, rt.Array | rt.Sequence):
            return self.declare(f"sequence<{self.type_name(type_.element)}> NAME;")
        if isinstance(type_, rt.Dictionary):
            pair = f"{self.type_name(type_.key)}, {self.type_name(type_.value)}"
            return self.declare(f"dictionary<{pair}> NAME;")
        if issubclass(type_, rt.StructArray):
            return self.declare(f"sequence<{self.type_name(type_._element_)}> NAME;")
        if type_ not in self.names:
            if issubclass(type_, rt.Enum):
                # Enumerators are in the scope of their enum, as their names in Python are.
                members = ", ".join(f"{m.name} = {m.value}" for m in type_)
                self.names[type_] = self.declare(f"enum NAME {{ {members} }};")
            else:
                self.names[type_] = self.struct(type_, "struct")
        return self.names[type_]

    def struct(self, type_: Any, keyword: str) -> str:
        fields = [f"{self.type_name(inner)} {name};" for name, inner in type_._fields_]
        if not fields and keyword == "struct":
            fields = ["bool unused;"]  # as `rcgen interface --to slice` writes it
        return self.declare(f"{keyword} NAME {{ {' '.join(fields)} }};")

    def load(self, folder: Path, interface: str) -> Any:
        """The module with an interface, compiled by Ice."""
        file = folder / f"{self.name}.ice"
        file.write_text(
            f"module {self.name} {{\n{chr(10).join(self.declarations)}\n"
            f"interface Probe {{ {interface} }};\n}};\n"
        )
        Ice.loadSlice(f"--underscore {file}")
        return __import__(self.name)


class Raw(Ice.Blobject):  # type: ignore[misc]
    """Answers with given bytes, and keeps what it received."""

    reply: tuple[bool, bytes] = (True, wire.EMPTY)
    received = b""

    def ice_invoke(self, request: bytes, current: Any) -> tuple[bool, bytes]:
        if current.operation.startswith("ice_"):
            return True, wire.EMPTY
        self.received = request
        return self.reply


class Process:
    """A client and a server with their own communicators, so that nothing is shortened."""

    def __init__(self, sliced_format: bool) -> None:
        properties = Ice.createProperties()
        properties.setProperty("Ice.Default.Host", "127.0.0.1")
        properties.setProperty("Ice.Default.SlicedFormat", str(int(sliced_format)))
        data = Ice.InitializationData()
        data.properties = properties
        self.client = Ice.initialize(data)
        self.server = Ice.initialize(data)
        self.adapter = self.server.createObjectAdapterWithEndpoints("a", "tcp")
        self.adapter.activate()

    def proxy(self, servant: Any) -> Any:
        identity = self.adapter.addWithUUID(servant).ice_getIdentity()
        proxy = self.adapter.createProxy(identity)
        return self.client.stringToProxy(str(proxy))

    def close(self) -> None:
        self.client.destroy()
        self.server.destroy()


@pytest.fixture(scope="module", params=[False, True], ids=["compact", "sliced"])
def process(request: pytest.FixtureRequest) -> Iterator[Process]:
    opened = Process(request.param)
    yield opened
    opened.close()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("slice")


few = settings(max_examples=60, suppress_health_check=[HealthCheck.too_slow])


@few
@given(st.data())
def test_ice_codec_and_ice_agree_on_arguments_and_results(
    process: Process, folder: Path, data: st.DataObject
) -> None:
    first, second = data.draw(slice_types), data.draw(slice_types)
    both = rt.Operation(
        "both", inputs={"a": first, "b": second}, returns=first, outputs={"c": second}
    )
    sent = (data.draw(values(first, nan=False)), data.draw(values(second, nan=False)))
    module = SliceModule()
    names = (module.type_name(first), module.type_name(second))
    loaded = module.load(
        folder,
        f"{names[0]} both({names[0]} a, {names[1]} b, out {names[1]} c);"
        f"idempotent {names[0]} get(out {names[1]} c);",
    )
    servant = Raw()
    servant.reply = True, codec.reply_encoder(both)(sent)
    proxy = loaded.ProbePrx.uncheckedCast(process.proxy(servant))
    result = proxy.get()  # Ice reads the codec's reply
    assert servant.received == wire.EMPTY
    proxy.both(*result)  # and writes the same values as a request
    request = codec.request_encoder(both)(sent)
    assert servant.received == request
    assert codec.request_encoder(both)(codec.request_decoder(both)(request)) == request

    class Servant(loaded.Probe):  # type: ignore[misc, name-defined]
        def both(self, a: Any, b: Any, current: Any = None) -> Any:
            return a, b

    typed = process.proxy(Servant())
    ok, reply = typed.ice_invoke("both", Ice.OperationMode.Normal, request)
    assert (ok, reply) == servant.reply


@few
@given(st.data())
def test_ice_codec_and_ice_agree_on_exceptions(
    process: Process, folder: Path, data: st.DataObject
) -> None:
    fields = data.draw(st.lists(slice_types, max_size=3))
    broken = struct_of(fields, rt.DeclaredError)
    error = broken(*(data.draw(values(type_, nan=False)) for type_ in fields))
    module = SliceModule()
    name = module.struct(broken, "exception")
    broken._type_id_ = f"{module.name}::{name}"
    loaded = module.load(folder, f"void fail() throws {name};")
    encode = codec.error_encoder((broken,), "Other")
    servant = Raw()
    servant.reply = False, encode(error)
    proxy = loaded.ProbePrx.uncheckedCast(process.proxy(servant))
    with pytest.raises(getattr(loaded, name)) as caught:
        proxy.fail()

    class Servant(loaded.Probe):  # type: ignore[misc, name-defined]
        def fail(self, current: Any = None) -> None:
            raise caught.value

    typed = process.proxy(Servant())
    ok, reply = typed.ice_invoke("fail", Ice.OperationMode.Normal, wire.EMPTY)
    assert not ok
    decoded = codec.error_decoder((broken,), "Other")(reply)
    assert encode(decoded) == encode(error)
