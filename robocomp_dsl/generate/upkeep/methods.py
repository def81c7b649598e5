"""The methods that the user's class should have: names, signatures, and the text of a stub.

In: the names of a component. Out: `Method`s in the order of the ports.
"""

from __future__ import annotations

from dataclasses import dataclass

from robocomp_dsl.generate import layout
from robocomp_dsl.generate.component_names import Called
from robocomp_dsl.generate.worker import HandlerCode, handler_code
from robocomp_dsl.generate.worker_imports import mentioned
from robocomp_dsl.model.component import Port
from robocomp_dsl.model.interface import Operation


@dataclass(frozen=True, slots=True)
class Signature:
    """Arguments without `self`, each with its annotation, and the annotation of the result."""

    arguments: tuple[tuple[str, str], ...]
    returns: str

    def __str__(self) -> str:
        given = ", ".join(f"{name}: {type_}" for name, type_ in self.arguments)
        return f"({given}) -> {self.returns}"


@dataclass(frozen=True, slots=True)
class Method:
    """One method. `types` are the names of `generated.interfaces` that its signature mentions."""

    name: str
    signature: Signature
    types: tuple[str, ...]
    code: HandlerCode
    port: Port
    operation: Operation


def methods_of(called: Called) -> dict[str, Method]:
    """All methods that others call, by name."""
    return {
        name: Method(
            name,
            Signature(
                tuple(called.types.arguments(operation)),
                layout.flat(called.types.returns(operation)),
            ),
            tuple(dict.fromkeys(mentioned(operation, called.types))),
            handler_code(port, operation, called),
            port,
            operation,
        )
        for (port, operation), name in called.handlers.items()
    }
