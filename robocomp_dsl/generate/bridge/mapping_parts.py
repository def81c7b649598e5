"""What all functions of `mapping.py` share: their data, and the names of received messages."""

from __future__ import annotations

from collections.abc import Iterable

from robocomp_dsl.generate.bridge.bridge_names import BridgeNames
from robocomp_dsl.model.bridge_ports import BridgeInput
from robocomp_dsl.record import ValueRecord

CONTEXT = ("at: MessageContext", "user: BridgeWorker")
"""The first parameters of functions that build messages."""


class MappingFunction(ValueRecord):
    """One function; `places` has the place of each assigned field of the message by its path."""

    name: str
    parameters: str
    returns: str
    doc: str
    lines: tuple[str, ...]
    places: tuple[tuple[str, str], ...] = ()


def input_locals(
    inputs: Iterable[BridgeInput], names: BridgeNames
) -> tuple[dict[tuple[str, str], str], list[str]]:
    """The local names of the parameters of inputs, and the lines that unpack several of them."""
    found: dict[tuple[str, str], str] = {}
    lines = []
    for item in inputs:
        variable = names.variables[item.name]
        parameters = item.parameters
        if len(parameters) == 1:
            found[item.name, parameters[0].name] = variable
            continue
        parts = [f"{variable}_{parameter.name}" for parameter in parameters]
        found |= {(item.name, p.name): part for p, part in zip(parameters, parts, strict=True)}
        lines.append(f"{', '.join(parts)} = {variable}")
    return found, lines


def annotation_of(item: BridgeInput, names: BridgeNames) -> str:
    """The annotation of the value of an input."""
    kinds = [names.annotation(parameter.type) for parameter in item.parameters]
    return kinds[0] if len(kinds) == 1 else f"tuple[{', '.join(kinds) or '()'}]"
