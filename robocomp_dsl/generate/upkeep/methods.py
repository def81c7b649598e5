"""The methods that the user's class should have: names, signatures, and the text of a stub.

In: a component and its names. Out: `Method`s in the order of the ports.
"""

from __future__ import annotations

from robocomp_dsl.diagnostics import Note
from robocomp_dsl.generate import layout
from robocomp_dsl.generate.component_names import Called
from robocomp_dsl.generate.machine_code import StateMethod
from robocomp_dsl.generate.worker import HandlerCode, handler_code, machine_of
from robocomp_dsl.generate.worker_imports import mentioned
from robocomp_dsl.model.component import Component
from robocomp_dsl.record import Value


class Signature(Value):
    """Arguments without `self`, each with its annotation, and the annotation of the result."""

    arguments: tuple[tuple[str, str], ...]
    returns: str

    def __str__(self) -> str:
        given = ", ".join(f"{name}: {type_}" for name, type_ in self.arguments)
        return f"({given}) -> {self.returns}"


class Method(Value):
    """One method: that of an operation, or of a state.

    `types` are the names of `generated.interfaces` that its signature mentions; `origin` says
    where it comes from; methods of the same `prefix` may be meant for it. One that is `optional`
    needs no stub.
    """

    name: str
    signature: Signature
    types: tuple[str, ...]
    code: HandlerCode
    what: str
    origin: Note
    prefix: str
    optional: bool = False


def methods_of(component: Component, called: Called) -> dict[str, Method]:
    """All methods that others or the state machine call, by name."""
    operations = {
        name: Method(
            name,
            Signature(
                tuple(called.types.arguments(operation)),
                layout.flat(called.types.returns(operation)),
            ),
            tuple(dict.fromkeys(mentioned(operation, called.types))),
            handler_code(port, operation, called),
            f"the operation `{operation.name}`",
            Note(operation.span, f"`{port.interface.qualified}` has this operation"),
            f"{port.name}_",
        )
        for (port, operation), name in called.handlers.items()
    }
    machine = machine_of(component)
    return operations | {m.name: _of_state(m) for m in (machine.methods if machine else ())}


def _of_state(one: StateMethod) -> Method:
    return Method(
        one.name,
        Signature((), "None"),
        (),
        HandlerCode(layout.definition(one.name, ("self",), "None"), one.doc, "", ""),
        f"the state `{one.state.name}`",
        Note(one.state.span, "this is the state"),
        f"{one.verb}_",
        optional=one.verb != "state",
    )
