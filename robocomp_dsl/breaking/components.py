"""Compares the ports of components of two versions.

In: the components of both versions, by name. Out: changes of kind `WIRE`.
"""

from __future__ import annotations

from collections.abc import Mapping

from robocomp_dsl.breaking import codes
from robocomp_dsl.breaking.changes import Changes
from robocomp_dsl.model.component import Component, Port, Role


def compare_components(
    old: Mapping[str, Component], new: Mapping[str, Component], changes: Changes
) -> None:
    """Compare the components with the same name."""
    for name, was in old.items():
        now = new.get(name)
        if now is None:
            changes.add(codes.WIRE, was, None, f"component `{name}` was removed")
            continue
        _ports(was, now, changes)
        if was.middleware != now.middleware:
            message = f"component `{name}` used {was.middleware}, now {now.middleware}"
            changes.add(codes.WIRE, was, now, message)


def _ports(was: Component, now: Component, changes: Changes) -> None:
    found = {(p.role, p.name): p for p in now.ports}
    for port in was.ports:
        after = found.pop((port.role, port.name), None)
        what = f"`{was.name}` {_verb(port)} `{port.interface.qualified}`"
        if after is None:
            changes.add(codes.WIRE, port, now, f"{what} no longer")
        elif after.interface.qualified != port.interface.qualified:
            message = f"port `{port.name}` was {port.interface.qualified}"
            changes.add(codes.WIRE, port, after, f"{message}, now {after.interface.qualified}")
        elif lost := _lost_middlewares((was, port), (now, after)):
            own = ", ".join(after.middlewares or (now.middleware,))
            message = f"port `{port.name}` used {', '.join(lost)}, now {own}"
            changes.add(codes.WIRE, port, after, message)
    for port in found.values():
        if port.role is Role.REQUIRES:
            message = f"`{was.name}` now requires `{port.interface.qualified}`: it needs a server"
            changes.add(codes.WIRE, was, port, message)


def _lost_middlewares(was: tuple[Component, Port], now: tuple[Component, Port]) -> list[str]:
    """The middlewares that a marked port used and uses no longer."""
    (old, port), (new, after) = was, now
    if not (port.middlewares or after.middlewares):
        return []
    present = after.middlewares or (new.middleware,)
    return [name for name in port.middlewares or (old.middleware,) if name not in present]


def _verb(port: Port) -> str:
    return "subscribes to" if port.role is Role.SUBSCRIBES else str(port.role)
