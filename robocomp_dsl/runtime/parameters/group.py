"""Groups of parameters with values.

In: checked values. Out: objects of the generated classes, and a walk over all parameters.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, TypeVar

from robocomp_dsl.runtime.parameters.schema import Group, Parameter, ParameterGroup

GroupT = TypeVar("GroupT", bound=ParameterGroup)


def build_group(kind: type[GroupT], values: Mapping[str, Any]) -> GroupT:
    """An object of `kind` with the checked `values`."""
    group = kind.__new__(kind)
    for entry in kind.SCHEMA:
        object.__setattr__(group, entry.attribute, _attribute(entry, values[entry.name]))
    return group


def _attribute(entry: Parameter | Group, value: Any) -> Any:
    if isinstance(entry, Parameter):
        return list(value) if entry.is_list else value
    if entry.single:
        return build_group(entry.type, value)
    return [build_group(entry.type, group) for group in value]


def walk_parameters(
    owner: ParameterGroup, prefix: str = ""
) -> Iterator[tuple[str, ParameterGroup, Parameter]]:
    """Every parameter below `owner` with its path and the group that holds its value."""
    for entry in owner.SCHEMA:
        path = f"{prefix}{entry.name}"
        if isinstance(entry, Parameter):
            yield path, owner, entry
            continue
        below = getattr(owner, entry.attribute)
        if entry.single:
            yield from walk_parameters(below, f"{path}.")
        else:
            for i, group in enumerate(below):
                yield from walk_parameters(group, f"{path}[{i}].")
