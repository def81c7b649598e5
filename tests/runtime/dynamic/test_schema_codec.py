"""Types that are built from a schema encode and decode as the compiled types of generated code."""

from __future__ import annotations

from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from robocomp_dsl.client import (
    build_interfaces,
    build_types,
    describe_interfaces,
    result_to_plain,
)
from robocomp_dsl.runtime import types as rt
from robocomp_dsl.runtime.dynamic.schema_interface import COMPONENTSCHEMA, Schema
from tests.runtime.random_schemas import messages, structs, types, values


def transmit(schema: Schema) -> Schema:
    """The schema as a peer receives it."""
    operation = COMPONENTSCHEMA.operation("getInterfaces")
    received: Schema = operation.decode_reply(operation.encode_reply(schema))
    return received


def rebuild(interface: rt.Interface) -> rt.Interface:
    """The interface that a client builds from the schema."""
    schema = transmit(describe_interfaces([interface]))
    return build_interfaces(schema, build_types(schema))[interface.name]


def interface_of(inputs: list[Any], outputs: list[Any]) -> rt.Interface:
    operation = rt.Operation(
        "call",
        inputs={f"in{i}": type_ for i, type_ in enumerate(inputs)},
        outputs={f"out{i}": type_ for i, type_ in enumerate(outputs[1:])},
        returns=outputs[0] if outputs else None,
    )
    return rt.Interface("Test::Random", operation)


@given(st.data())
def test_schema_codec_agrees_with_compiled_codec(data: st.DataObject) -> None:
    inputs = data.draw(st.lists(types | structs, max_size=3))
    outputs = data.draw(st.lists(types | structs, max_size=3))
    interface = interface_of(inputs, outputs)
    built = rebuild(interface)
    assert built.hash == interface.hash
    compiled, dynamic = interface.operation("call"), built.operation("call")
    arguments = tuple(data.draw(values(type_)) for type_ in inputs)
    request = compiled.encode_request(arguments)
    assert dynamic.encode_request(dynamic.decode_request(request)) == request
    results = [data.draw(values(type_, nan=False)) for type_ in outputs]
    result = (tuple(results) if len(results) > 1 else results[0]) if results else None
    reply = compiled.encode_reply(result)
    decoded = dynamic.decode_reply(reply)
    assert dynamic.encode_reply(decoded) == reply
    assert result_to_plain(dynamic, decoded) == result_to_plain(compiled, result)


@given(messages())
def test_schema_codec_builds_equal_exceptions(message: Any) -> None:
    class_ = type(message)
    members = {"__annotations__": dict(class_._fields_), "__module__": __name__}
    error_type: Any = type("Failure", (rt.DeclaredError,), members)
    interface = rt.Interface("Test::Failing", rt.Operation("fail", throws=(error_type,)))
    operation = rebuild(interface).operation("fail")
    data = interface.operations[0].encode_error(error_type(*message._astuple()))
    assert operation.encode_error(operation.decode_error(data)) == data


class Colour(rt.Enum):
    Red = 0
    Green = 5
    mro_ = 7


class Settings(rt.Struct, rename={"None_": "None", "x_": "_x"}):
    None_: rt.Int = 3
    x_: rt.Float = 0.5
    colour: Colour = Colour.Green
    text: rt.String = "é"


def test_schema_keeps_names_and_defaults_of_fields() -> None:
    interface = rt.Interface("Test::Names", rt.Operation("set", inputs={"settings": Settings}))
    operation = rebuild(interface).operation("set")
    cls: Any = operation.inputs[0][1]
    value = cls()
    assert (value.None_, value.x_, value.text) == (3, 0.5, "é")
    assert value.colour == Colour.Green
    assert [name for name, _ in cls._fields_] == ["None", "_x", "colour", "text"]
    assert operation.encode_request((value,)) == interface.operations[0].encode_request(
        (Settings(),)
    )
