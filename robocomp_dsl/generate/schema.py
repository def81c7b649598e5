"""JSON Schema (draft 2020-12) of a component's configuration, for editors that know YAML.

In: the parameters. Out: the text of `etc/config.schema.json`.
"""

from __future__ import annotations

import json
from typing import Any

from robocomp_dsl.generate.literals import lines
from robocomp_dsl.model.parameter import Kind, Parameter

_TYPES = {
    Kind.STRING: "string",
    Kind.INT: "integer",
    Kind.FLOAT: "number",
    Kind.BOOL: "boolean",
    Kind.CHOICE: "string",
}


def config_schema(title: str, doc: str, parameters: tuple[Parameter, ...]) -> str:
    """The schema as JSON text, ending in a line end."""
    head = {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": title}
    if doc:
        head["description"] = "\n".join(lines(doc))
    return json.dumps({**head, **_object(parameters)}, indent=2) + "\n"


def _object(parameters: tuple[Parameter, ...]) -> dict[str, Any]:
    """An object with exactly these keys; those without a default must be there."""
    made: dict[str, Any] = {
        "type": "object",
        "properties": {p.name: _property(p) for p in parameters},
        "additionalProperties": False,
    }
    required = [p.name for p in parameters if _must_be_given(p)]
    return {**made, "required": required} if required else made


def _must_be_given(one: Parameter) -> bool:
    if one.kind is not Kind.GROUP:
        return one.default is None
    if one.single:
        return any(_must_be_given(p) for p in one.members)
    return bool(one.low)


def _property(one: Parameter) -> dict[str, Any]:
    made: dict[str, Any] = {}
    description = "\n".join([*lines(one.doc), *([f"Unit: {one.unit}"] if one.unit else [])])
    if description:
        made["description"] = description
    if one.kind is Kind.GROUP:
        return {**made, **(_object(one.members) if one.single else _array(one))}
    made["type"] = _TYPES[one.kind]
    if one.choices:
        made["enum"] = list(one.choices)
    if one.kind in (Kind.INT, Kind.FLOAT):
        bounds = {"minimum": one.low, "maximum": one.high}
        made |= {key: _whole(one, b) for key, b in bounds.items() if b is not None}
    if one.default is not None:
        made["default"] = one.default
    return made


def _array(one: Parameter) -> dict[str, Any]:
    bounds = {"minItems": one.low, "maxItems": one.high}
    limits = {key: int(b) for key, b in bounds.items() if b is not None}
    return {"type": "array", "items": _object(one.members), **limits}


def _whole(one: Parameter, bound: float) -> float:
    return int(bound) if one.kind is Kind.INT else bound
