"""JSON Schema (draft 2020-12) of a component's configuration, for YAML editors.

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
    """The schema as JSON text with a final newline."""
    head = {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": title}
    if doc:
        head["description"] = "\n".join(lines(doc))
    return json.dumps({**head, **_object(parameters)}, indent=2) + "\n"


def _object(parameters: tuple[Parameter, ...]) -> dict[str, Any]:
    """An object with exactly these keys; keys without a default are required."""
    schema: dict[str, Any] = {
        "type": "object",
        "properties": {p.name: _property(p) for p in parameters},
        "additionalProperties": False,
    }
    required = [p.name for p in parameters if _is_required(p)]
    return {**schema, "required": required} if required else schema


def _is_required(parameter: Parameter) -> bool:
    if parameter.kind is not Kind.GROUP:
        return parameter.default is None
    if parameter.single:
        return any(_is_required(p) for p in parameter.members)
    return bool(parameter.low)


def _property(parameter: Parameter) -> dict[str, Any]:
    schema: dict[str, Any] = {}
    description = "\n".join(
        [*lines(parameter.doc), *([f"Unit: {parameter.unit}"] if parameter.unit else [])]
    )
    if description:
        schema["description"] = description
    if parameter.kind is Kind.GROUP:
        return {**schema, **(_object(parameter.members) if parameter.single else _array(parameter))}
    if parameter.is_list:
        schema |= _list(parameter)
    else:
        schema |= _value(parameter)
    if parameter.default is not None:
        schema["default"] = parameter.default
    return schema


def _list(parameter: Parameter) -> dict[str, Any]:
    bounds = {"minItems": parameter.shortest or None, "maxItems": parameter.longest}
    limits = {key: bound for key, bound in bounds.items() if bound is not None}
    return {"type": "array", "items": _value(parameter), **limits}


def _value(parameter: Parameter) -> dict[str, Any]:
    """One value: of a parameter, or of a list."""
    schema: dict[str, Any] = {"type": _TYPES[parameter.kind]}
    if parameter.choices:
        schema["enum"] = list(parameter.choices)
    if parameter.kind in (Kind.INT, Kind.FLOAT):
        bounds = {"minimum": parameter.low, "maximum": parameter.high}
        schema |= {key: _bound(parameter, b) for key, b in bounds.items() if b is not None}
    return schema


def _array(parameter: Parameter) -> dict[str, Any]:
    bounds = {"minItems": parameter.low, "maxItems": parameter.high}
    limits = {key: int(b) for key, b in bounds.items() if b is not None}
    return {"type": "array", "items": _object(parameter.members), **limits}


def _bound(parameter: Parameter, bound: float) -> float:
    return int(bound) if parameter.kind is Kind.INT else bound
