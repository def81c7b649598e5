"""The methods of a proxy: one per operation, and `query`, `command`, `publish`.

In: an interface, its names and the ports that call it. Out: plain data for the template.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from robocomp_dsl.generate import docs, literals
from robocomp_dsl.generate.python.component_names import InterfaceNames
from robocomp_dsl.generate.python.layout import BODY
from robocomp_dsl.generate.python.python_types import PythonTypes
from robocomp_dsl.model.component import Port
from robocomp_dsl.model.interface import Interface, Operation, Pattern
from robocomp_dsl.model.types import Struct
from robocomp_dsl.record import ValueRecord


class MethodCode(ValueRecord):
    """One operation of a proxy. `call` are the arguments of `self._call`."""

    name: str
    parameters: str
    returns: str
    doc: str
    call: str


class FormCode(ValueRecord):
    """`query`, `command` or `publish` of a proxy; the argument's struct selects the operation.

    `request` is the parameter; `takers` are struct, result and method of each operation.
    """

    name: str
    request: str
    doc: str
    takers: tuple[tuple[str, str, str], ...]


def method_code(
    operation: Operation, interface_names: InterfaceNames, types: PythonTypes
) -> MethodCode:
    """The proxy method of an operation."""
    arguments = types.arguments(operation)
    doc = docs.of_operation(operation, types)
    return MethodCode(
        interface_names.methods[operation],
        ", ".join(["self", *_parameters(operation, arguments, types)]),
        types.returns(operation),
        literals.docstring(doc, BODY) if doc else "",
        ", ".join([literals.quoted(operation.name), *(a for a, _ in arguments)]),
    )


def _parameters(
    operation: Operation, arguments: list[tuple[str, str]], types: PythonTypes
) -> Iterable[str]:
    """Name and annotation of each argument, and the default of the last ones that have one."""
    optional = operation.optional_inputs
    for (name, annotation), param in zip(arguments, operation.inputs, strict=True):
        default = f" = {types.zero(param.type, param.default).text}" if param in optional else ""
        yield f"{name}: {annotation}{default}"


def form_codes(
    interface: Interface, interface_names: InterfaceNames, ports: list[Port], types: PythonTypes
) -> Iterable[FormCode]:
    """The calls by request struct: `query(req)`, `command(req)`, `publish(req)`."""
    for form in (Pattern.QUERY, Pattern.COMMAND, Pattern.PUBLISH):
        takers = [
            o
            for o in interface.operations
            if len(o.inputs) == 1
            and isinstance(o.inputs[0].type, Struct)
            and any(p.pattern(o) is form for p in ports)
        ]
        count = Counter(o.inputs[0].type for o in takers)
        clear = [o for o in takers if count[o.inputs[0].type] == 1]
        if clear and form.value not in interface_names.methods.values():
            yield _form(form.value, clear, interface_names, types)


def _form(
    name: str, takers: list[Operation], interface_names: InterfaceNames, types: PythonTypes
) -> FormCode:
    rows = tuple(
        (types.annotation(o.inputs[0].type), types.returns(o), interface_names.methods[o])
        for o in takers
    )
    listed = ", ".join(f"`{method}`" for _, _, method in rows)
    return FormCode(
        name,
        "request_" if "request" in types.scope.taken else "request",
        literals.docstring(f"The operation that takes the request: {listed}.", BODY),
        rows,
    )
