"""What docstrings say of structs and operations: the doc comment, and below it units and failures.

In: model objects. Out: text; quoting it is left to `literals`.
"""

from __future__ import annotations

from robocomp_dsl.generate.literals import lines
from robocomp_dsl.generate.python_types import PythonTypes
from robocomp_dsl.model.interface import Operation
from robocomp_dsl.model.types import ExceptionType, Field, Struct


def of_record(one: Struct | ExceptionType, attributes: tuple[str, ...]) -> str:
    """The doc comment of a struct or exception, then a line for each field that has more to say."""
    pairs = zip(attributes, one.fields, strict=True)
    rows = [_field(name, field) for name, field in pairs if field.unit or lines(field.doc)]
    return _above(lines(one.doc) or [f"{one.qualified}."], rows)


def _field(name: str, field: Field) -> str:
    unit = f" [{field.unit}]" if field.unit else ""
    doc = " ".join(lines(field.doc))
    return f"{name}{unit}: {doc}" if doc else f"{name}{unit}"


def of_operation(one: Operation, types: PythonTypes, qualified: str = "") -> str:
    """The doc comment of an operation, then units, the order of several results, exceptions.

    Without a comment it begins with the name of the interface, where that is given.
    """
    results = [name or "the result" for name, _ in types.results(one)]
    units = [f"{p.name} in {p.unit}" for p in (*one.inputs, *one.outputs) if p.unit]
    rows = [f"Units: {', '.join(units)}."] if units else []
    rows += [f"Returns {', '.join(results)}."] if len(results) > 1 else []
    rows += [f"May raise {', '.join(types.names[t] for t in one.throws)}."] if one.throws else []
    title = [f"{qualified}: {one.name}."] if qualified else []
    return _above(lines(one.doc) or title, rows)


def _above(title: list[str], rows: list[str]) -> str:
    return "\n".join([*title, *([""] if title and rows else []), *rows])
