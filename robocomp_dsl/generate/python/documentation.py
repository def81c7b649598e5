"""`interfaces.json`: names, units and doc comments that running components pass on.

In: the types and interfaces of a component. Out: JSON, which only `getInterfaces` reads, by
`robocomp_dsl.runtime.dynamic.documentation`.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from typing import Any

from robocomp_dsl.generate.python.python_types import PythonTypes
from robocomp_dsl.model.interface import Interface, Operation, Param
from robocomp_dsl.model.types import Declaration, Enum, ExceptionType, Field, Struct


def documentation(interfaces: Iterable[Interface], types: PythonTypes) -> str:
    """The text of the file. Entries without any text are left out."""
    named = [d for d in types.ordered if isinstance(d, Struct | ExceptionType | Enum)]
    data = {
        "interfaces": {i.qualified: _interface(i) for i in interfaces},
        "types": {types.names[d]: _type(d) for d in named},
    }
    return json.dumps(data, indent=1, sort_keys=True) + "\n"


def _without_empty(texts: Mapping[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in texts.items() if value}


def _type(declaration: Declaration) -> dict[str, Any]:
    texts: dict[str, Any] = {"name": declaration.qualified, "doc": declaration.doc}
    match declaration:
        case Struct() | ExceptionType():
            texts["fields"] = _without_empty({f.name: _field(f) for f in declaration.fields})
        case Enum():
            enumerators = declaration.enumerators
            texts["values"] = _without_empty({e.name.strip("_"): e.doc for e in enumerators})
    return _without_empty(texts)


def _field(field: Field) -> dict[str, str]:
    return _without_empty({"unit": field.unit, "doc": field.doc})


def _interface(interface: Interface) -> dict[str, Any]:
    operations = {o.name: _operation(o) for o in interface.operations}
    return _without_empty({"doc": interface.doc, "operations": _without_empty(operations)})


def _operation(operation: Operation) -> dict[str, Any]:
    return _without_empty(
        {
            "doc": operation.doc,
            "inputs": _units(operation.inputs),
            "outputs": _units(operation.outputs),
        }
    )


def _units(parameters: Iterable[Param]) -> dict[str, str]:
    return _without_empty({p.name: p.unit for p in parameters})
