"""A schema from a peer may be anything: what is not valid is a `SchemaError`, quickly."""

from __future__ import annotations

import copy
from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from robocomp_dsl.client import SchemaError, build_interfaces, build_types, describe_interfaces
from robocomp_dsl.runtime.component.component_interface import COMPONENT
from robocomp_dsl.runtime.dynamic.schema_interface import (
    EnumeratorInfo,
    FieldInfo,
    Schema,
    TypeInfo,
)

VALID = describe_interfaces([COMPONENT])


def build(schema: Schema) -> None:
    build_interfaces(schema, build_types(schema))


def doubling_types(count: int) -> list[TypeInfo]:
    """Types of which each has two fields of the one before."""
    types = [TypeInfo("T0", "struct", "", [FieldInfo("x", "int")])]
    for i in range(1, count):
        fields = [FieldInfo("a", f"T{i - 1}"), FieldInfo("b", f"T{i - 1}")]
        types.append(TypeInfo(f"T{i}", "struct", "", fields))
    return types


def with_field(type_: str, name: str = "x", default: str = "") -> Callable[[Schema], None]:
    def change(schema: Schema) -> None:
        schema.types.append(
            TypeInfo("New", "struct", "", [FieldInfo(name, type_, "", "", default)])
        )

    return change


CHANGES: dict[str, tuple[Callable[[Schema], None], str]] = {
    "unknown type": (with_field("Nothing"), "`Nothing` is not defined before its use"),
    "own type": (with_field("New"), "`New` is not defined before its use"),
    "open sequence": (with_field("sequence<int"), "`>` is missing"),
    "empty type": (with_field(""), "is not defined"),
    "text behind": (with_field("int>"), "unexpected `>`"),
    "other signs": (with_field("int; drop"), "is not a type"),
    "sequence as key": (with_field("dictionary<sequence<int>,int>"), "the key of a dictionary"),
    "deep type": (with_field("sequence<" * 5000 + "int" + ">" * 5000), "nested deeper"),
    "code as name": (with_field("int", "x=__import__('os')"), "not a valid name"),
    "dunder type": (lambda s: s.types.append(TypeInfo("a b", "struct")), "not a valid name"),
    "bad default": (with_field("int", default="[" * 100_000), "the default is not JSON"),
    "two types": (lambda s: s.types.append(s.types[0]), "is defined twice"),
    "unknown kind": (lambda s: s.types.append(TypeInfo("A", "union")), "unknown kind `union`"),
    "empty enum": (lambda s: s.types.append(TypeInfo("A", "enum")), "has no enumerators"),
    "enumerator": (
        lambda s: s.types.append(TypeInfo("A", "enum", "", [], [EnumeratorInfo("1")])),
        "not a valid name",
    ),
    "many fields": (lambda s: s.types.extend(doubling_types(60)), "more than 100000 fields"),
    "hash": (lambda s: setattr(s.interfaces[0], "hash", "00"), "does not have the type hash"),
    "pattern": (
        lambda s: setattr(s.interfaces[0].operations[0], "pattern", "shout"),
        "unknown pattern",
    ),
    "throws": (
        lambda s: s.interfaces[0].operations[0].throws.append(s.types[0].name),
        "which is not an exception",
    ),
    "operations": (
        lambda s: s.interfaces[0].operations.append(s.interfaces[0].operations[0]),
        "two operations of one name",
    ),
}


@pytest.mark.parametrize("change", CHANGES)
def test_invalid_schema_is_schema_error(change: str) -> None:
    schema = copy.deepcopy(VALID)
    apply, message = CHANGES[change]
    apply(schema)
    with pytest.raises(SchemaError) as failure:
        build(schema)
    assert message in str(failure.value)
    assert len(str(failure.value)) < 500


@given(st.data())
def test_random_change_of_schema_is_schema_error_or_valid(data: st.DataObject) -> None:
    schema = copy.deepcopy(VALID)
    info = data.draw(st.sampled_from(schema.types))
    text = st.text(max_size=20) | st.sampled_from(["int", "sequence<", "struct", "Names", ""])
    if info.fields:
        field = data.draw(st.sampled_from(info.fields))
        setattr(
            field, data.draw(st.sampled_from(["name", "type", "defaultValue"])), data.draw(text)
        )
    setattr(info, data.draw(st.sampled_from(["name", "kind", "doc"])), data.draw(text))
    try:
        build(schema)
    except SchemaError:
        return


def test_valid_schema_is_built() -> None:
    build(copy.deepcopy(VALID))
