"""`--to json-schema`: valid schemas, and the instances that they accept and reject."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from jsonschema import Draft202012Validator

from robocomp_dsl.generate.export import export
from robocomp_dsl.resources import INTERFACES
from tests.generate.export import exported, random_idsl


def schema_of(path: Path, *, alone: bool = False) -> dict[str, Any]:
    """The schema of a file; every reference in it resolves."""
    files = export(exported.modules(path), "json-schema", alone=alone)
    assert not files.findings
    (file,) = files.files
    schema: dict[str, Any] = json.loads(file.text)
    Draft202012Validator.check_schema(schema)
    for name in schema["$defs"]:
        # Resolves all references in it, because validation goes through every branch.
        list(validator(schema, name).iter_errors(None))
    for reference in references(schema):
        assert reference.removeprefix("#/$defs/") in schema["$defs"]
    return schema


def references(schema: Any) -> list[str]:
    if isinstance(schema, dict):
        own = [schema["$ref"]] if isinstance(schema.get("$ref"), str) else []
        return own + [found for part in schema.values() for found in references(part)]
    return (
        [found for part in schema for found in references(part)] if isinstance(schema, list) else []
    )


def validator(schema: dict[str, Any], name: str) -> Draft202012Validator:
    return Draft202012Validator({"$ref": f"#/$defs/{name}", "$defs": schema["$defs"]})


@pytest.mark.parametrize("name", exported.SHIPPED)
def test_json_schema_of_shipped_interface_is_valid(name: str) -> None:
    schema_of(INTERFACES / name)


@settings(max_examples=40)
@given(texts=random_idsl.texts())
def test_json_schema_of_random_interface_is_valid(texts: dict[str, str]) -> None:
    with tempfile.TemporaryDirectory() as name:
        for file, text in texts.items():
            Path(name, file).write_text(text)
        schema_of(Path(name, "Text.idsl"))
        schema_of(Path(name, "Text.idsl"), alone=True)


TEXT = """
module M {
    enum E { Off, On = 5 };
    /** A thing. */
    struct S { byte b; short s; long l [mm]; E e; string t = "x"; double d; };
    sequence<S> Q;
    sequence<short> H;
    struct K { int a; };
    dictionary<int, H> ByInt;
    dictionary<E, bool> ByEnum;
    dictionary<bool, int> ByBool;
    dictionary<K, int> ByStruct;
    exception X { string why; };
    interface I { bool ask(S s, out H h) throws X; void tell(int n); };
};
"""
S = {"b": 1, "s": -1, "l": 0, "e": "On", "d": 0.5}
CASES: dict[str, tuple[str, Any, bool]] = {
    "struct, default left out": ("M.S", S, True),
    "struct with all": ("M.S", S | {"t": ""}, True),
    "byte 255": ("M.S", S | {"b": 255}, True),
    "byte 256": ("M.S", S | {"b": 256}, False),
    "byte -1": ("M.S", S | {"b": -1}, False),
    "short -32768": ("M.S", S | {"s": -32768}, True),
    "short -32769": ("M.S", S | {"s": -32769}, False),
    "long 2**63 - 1": ("M.S", S | {"l": 2**63 - 1}, True),
    "long 2**63": ("M.S", S | {"l": 2**63}, False),
    "fraction for an integer": ("M.S", S | {"l": 0.5}, False),
    "unknown enumerator": ("M.S", S | {"e": "Of"}, False),
    "unknown member": ("M.S", S | {"z": 1}, False),
    "missing member": ("M.S", {"b": 1}, False),
    "sequence": ("M.Q", [S, S], True),
    "sequence of another type": ("M.Q", [1], False),
    "int keys": ("M.ByInt", {"-3": [1, 2], "0": []}, True),
    "not an int as key": ("M.ByInt", {"x": []}, False),
    "enum keys": ("M.ByEnum", {"On": True}, True),
    "unknown enum key": ("M.ByEnum", {"on": True}, False),
    "bool keys": ("M.ByBool", {"true": 1}, True),
    "not a bool as key": ("M.ByBool", {"1": 1}, False),
    "struct keys": ("M.ByStruct", [{"key": {"a": 1}, "value": 2}], True),
    "request": ("M.I.ask.request", {"s": S}, True),
    "request of another type": ("M.I.ask.request", {"s": 1}, False),
    "response": ("M.I.ask.response", {"return": True, "h": [1]}, True),
    "response without the result": ("M.I.ask.response", {"h": [1]}, False),
    "exception": ("M.I.ask.response", {"throws M.X": {"why": "no"}}, True),
    "void response": ("M.I.tell.response", {}, True),
}


@pytest.fixture(scope="module")
def schema(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    path = tmp_path_factory.mktemp("schema") / "M.idsl"
    path.write_text(TEXT)
    return schema_of(path)


@pytest.mark.parametrize("case", CASES)
def test_json_schema_accepts_and_rejects_instances(case: str, schema: dict[str, Any]) -> None:
    name, value, fits = CASES[case]
    assert validator(schema, name).is_valid(value) is fits


def test_json_schema_has_descriptions(schema: dict[str, Any]) -> None:
    described = schema["$defs"]["M.S"]
    assert described["description"] == "A thing."
    assert described["properties"]["l"]["description"] == "[mm]"
    assert described["properties"]["t"]["default"] == "x"
    assert schema["$defs"]["M.E"]["$comment"] == "Off = 0, On = 5"


def test_json_schema_alone_omits_unused_types() -> None:
    whole, alone = (schema_of(INTERFACES / "Laser.idsl", alone=name) for name in (False, True))
    assert set(alone["$defs"]) < set(whole["$defs"])
    assert "RoboCompGenericBase.TBaseState" in alone["$defs"]
