"""The methods of a proxy: one for each operation, and `query`, `command`, `publish`.

In: an interface, its names and the ports that call it. Out: plain data for the template.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

from robocomp_dsl.generate import docs, layout, literals
from robocomp_dsl.generate.component_names import InterfaceNames
from robocomp_dsl.generate.layout import BODY, INNER
from robocomp_dsl.generate.python_types import PythonTypes
from robocomp_dsl.model.component import Port
from robocomp_dsl.model.interface import Interface, Operation, Pattern
from robocomp_dsl.model.types import Struct
from robocomp_dsl.record import Value


class MethodCode(Value):
    """One operation of a proxy: its slot, the line that binds it, its definition."""

    slot: str
    bind: str
    definition: str
    doc: str
    statement: str


class FormCode(Value):
    """`query`, `command` or `publish` of a proxy: one signature for each struct it takes."""

    overloads: tuple[str, ...]
    definition: str
    doc: str
    statements: tuple[str, ...]


def method_code(
    position: int, one: Operation, called: InterfaceNames, types: PythonTypes
) -> MethodCode:
    """The method of the operation at `position` of its interface."""
    name = called.methods[one]
    slot = f"_call_{name}"
    returns = types.returns(one)
    hint = layout.subscript("Callable", "...", returns)
    arguments = types.arguments(one)
    made = layout.call(f"self.{slot}", *(a for a, _ in arguments))
    doc = docs.of_operation(one, types)
    keyword = "" if returns == "None" else "return "
    parameters = ("self", *(f"{a}: {t}" for a, t in arguments))
    bound = layout.call("bind", f"{called.constant}.operations[{position}]")
    return MethodCode(
        layout.statement(f"{slot}: ", hint, INNER),
        layout.statement(f"self.{slot} = ", bound, BODY),
        layout.definition(name, parameters, returns),
        literals.docstring(doc, BODY) if doc else "",
        layout.statement(keyword, made, BODY),
    )


def form_codes(
    interface: Interface, called: InterfaceNames, ports: list[Port], types: PythonTypes
) -> Iterable[FormCode]:
    """The calls by request: `query(req)`, `command(req)`, `publish(req)`."""
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
        if clear and form.value not in called.methods.values():
            yield _form(form.value, clear, called, types)


def _form(
    name: str, takers: list[Operation], called: InterfaceNames, types: PythonTypes
) -> FormCode:
    given = "request_" if "request" in types.scope.taken else "request"
    rows = [
        (types.annotation(o.inputs[0].type), types.returns(o), called.methods[o]) for o in takers
    ]
    listed = ", ".join(f"`{method}`" for _, _, method in rows)
    doc = literals.docstring(f"The operation that takes the request: {listed}.", BODY)
    if len(rows) == 1:
        taken, returns, method = rows[0]
        keyword = "" if returns == "None" else "return "
        body = layout.statement(keyword, layout.call(f"self.{method}", given), BODY)
        return FormCode(
            (), layout.definition(name, ("self", f"{given}: {taken}"), returns), doc, (body,)
        )
    overloads = tuple(
        layout.definition(name, ("self", f"{given}: {taken}"), returns, after=len(" ..."))
        for taken, returns, _ in rows
    )
    statements = [
        f"if isinstance({given}, {taken}):\n{BODY}    return self.{method}({given})"
        for taken, _, method in rows
    ]
    failure = f'raise TypeError(f"no operation takes a {{type({given}).__name__}}")'
    general = layout.definition(name, ("self", f"{given}: Any"), "Any")
    return FormCode(overloads, general, doc, (*statements, failure))
