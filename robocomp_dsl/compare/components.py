"""Components of two versions compared: the ports that others rely on.

In: the components of both, by name. Out: changes of kind wire.
"""

from __future__ import annotations

from collections.abc import Mapping

from robocomp_dsl.compare import codes
from robocomp_dsl.compare.changes import Changes
from robocomp_dsl.model.component import Component, Port, Role


def compare_components(
    old: Mapping[str, Component], new: Mapping[str, Component], changes: Changes
) -> None:
    """Each component with the one of the same name."""
    for name, was in old.items():
        now = new.get(name)
        if now is None:
            changes.add(codes.WIRE, was, None, f"component `{name}` is gone")
            continue
        _ports(was, now, changes)
        if was.middleware != now.middleware:
            said = f"component `{name}` spoke {was.middleware}, now {now.middleware}"
            changes.add(codes.WIRE, was, now, said)


def _ports(was: Component, now: Component, changes: Changes) -> None:
    found = {(p.role, p.name): p for p in now.ports}
    for port in was.ports:
        after = found.pop((port.role, port.name), None)
        what = f"`{was.name}` {_verb(port)} `{port.interface.qualified}`"
        if after is None:
            changes.add(codes.WIRE, port, now, f"{what} no more")
        elif after.interface.qualified != port.interface.qualified:
            said = f"port `{port.name}` was {port.interface.qualified}"
            changes.add(codes.WIRE, port, after, f"{said}, now {after.interface.qualified}")
    for port in found.values():
        if port.role is Role.REQUIRES:
            said = f"`{was.name}` requires `{port.interface.qualified}`: it needs a server now"
            changes.add(codes.WIRE, was, port, said)


def _verb(port: Port) -> str:
    return "subscribes to" if port.role is Role.SUBSCRIBES else str(port.role)
