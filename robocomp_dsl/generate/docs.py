"""Docstrings of generated fields and operations: doc comments, units and exceptions.

In: model objects. Out: text, which `literals` quotes.
"""

from __future__ import annotations

from robocomp_dsl.generate.literals import lines
from robocomp_dsl.generate.python.python_types import PythonTypes
from robocomp_dsl.model.interface import Operation
from robocomp_dsl.model.types import Field


def of_field(field: Field) -> str:
    """The unit of a field and its doc comment, in one line; empty without either."""
    unit = [f"[{field.unit}]"] if field.unit else []
    return " ".join([*unit, *lines(field.doc)])


def of_operation(operation: Operation, types: PythonTypes, qualified: str = "") -> str:
    """The doc comment of an operation, then units, the order of several results, exceptions.

    Without a comment it starts with `qualified` and the operation's name, if `qualified` is set.
    """
    results = [name or "the result" for name, _ in types.results(operation)]
    units = [f"{p.name} in {p.unit}" for p in (*operation.inputs, *operation.outputs) if p.unit]
    rows = [f"Units: {', '.join(units)}."] if units else []
    rows += [f"Returns {', '.join(results)}."] if len(results) > 1 else []
    rows += (
        [f"May raise {', '.join(types.names[t] for t in operation.throws)}."]
        if operation.throws
        else []
    )
    title = [f"{qualified}: {operation.name}."] if qualified else []
    return _join_sections(lines(operation.doc) or title, rows)


def _join_sections(title: list[str], rows: list[str]) -> str:
    return "\n".join([*title, *([""] if title and rows else []), *rows])
