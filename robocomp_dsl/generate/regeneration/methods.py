"""The methods that the user's class should have: names, signatures, and texts of stubs.

In: a component and its names. Out: `Method`s in the order of the ports.
"""

from __future__ import annotations

from robocomp_dsl.diagnostics import Note
from robocomp_dsl.generate.python.component_names import PythonNames
from robocomp_dsl.generate.python.machine_code import StateMethod
from robocomp_dsl.generate.python.worker import HandlerCode, handler_code, machine_of
from robocomp_dsl.generate.python.worker_imports import mentioned
from robocomp_dsl.model.component import Component
from robocomp_dsl.record import ValueRecord


class Signature(ValueRecord):
    """Arguments without `self`, each with its annotation, and the annotation of the result."""

    arguments: tuple[tuple[str, str], ...]
    returns: str

    def __str__(self) -> str:
        arguments = ", ".join(f"{name}: {type_}" for name, type_ in self.arguments)
        return f"({arguments}) -> {self.returns}"


class Method(ValueRecord):
    """The method of an operation, or of a state.

    `types` are the names of `interfaces` in its signature; `origin` is the declaration; a method
    with the same `prefix` may be a misspelling of it. An `optional` method needs no stub.
    """

    name: str
    signature: Signature
    types: tuple[str, ...]
    code: HandlerCode
    what: str
    origin: Note
    prefix: str
    optional: bool = False


def methods_of(component: Component, py_names: PythonNames) -> dict[str, Method]:
    """All methods that other components or the state machine call, by name."""
    operations = {
        name: Method(
            name,
            Signature(
                tuple(py_names.types.arguments(operation)),
                py_names.types.returns(operation),
            ),
            tuple(dict.fromkeys(mentioned(operation, py_names.types))),
            handler_code(port, operation, py_names),
            f"the operation `{operation.name}`",
            Note(operation.span, f"`{port.interface.qualified}` has this operation"),
            f"{port.name}_",
        )
        for (port, operation), name in py_names.handlers.items()
    }
    machine = machine_of(component)
    return operations | {m.name: _of_state(m) for m in (machine.methods if machine else ())}


def _of_state(method: StateMethod) -> Method:
    return Method(
        method.name,
        Signature((), "None"),
        (),
        HandlerCode(method.name, "self", "None", method.doc, "", answers=False),
        f"the state `{method.state.name}`",
        Note(method.state.span, "this is the state"),
        f"{method.verb}_",
        optional=method.verb != "state",
    )
