"""Addresses and processes of old, as a deployment: who runs where, who calls whom.

In: the components that moved over, and the processes of a manager's file if there is one. Out: a
`Draft`: instances with their wires, and stand-ins for components that are only known by address.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import PurePosixPath

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate import codes
from robocomp_dsl.migrate.instances import COMMON, Draft, Instance, Names, host_name
from robocomp_dsl.migrate.manager import Node
from robocomp_dsl.migrate.moved import Moved, MovedConfig
from robocomp_dsl.migrate.wiring import wire
from robocomp_dsl.model.interface import Interface

FIRST_PORT, LAST_PORT = 1024, 65535


def draft(moved: Sequence[Moved], nodes: Sequence[Node], report: Report) -> Draft:
    """The deployment of some processes, or of one of each component where there is no manager."""
    names = Names()
    if nodes:
        made = [_of_node(one, names.claim(one.name), moved, report) for one in nodes]
        _order(made, nodes, report)
    else:
        made = [_of_component(one, names.claim(one.name)) for one in moved if one.component]
    found = Draft(made)
    for one in list(made):
        wire(one, found, names, report)
    _give_ports(found.instances)
    return found


def _of_component(moved: Moved, name: str) -> Instance:
    config = moved.configs[0] if moved.configs else None
    one = Instance(name, moved.span, moved, config)
    one.listens = list(config.ice.endpoints) if config else []
    return one


def _of_node(node: Node, name: str, moved: Sequence[Moved], report: Report) -> Instance:
    one = Instance(name, node.span, host=node.host, user=node.user)
    if node.address is not None:
        one.listens.append(node.address)
    one.moved = _component_of(node, moved)
    if one.moved is not None:
        one.config = _config_of(node, one.moved, report)
        one.listens += one.config.ice.endpoints if one.config else ()
    if node.command:
        said = f"`{node.name}` was started with `{node.command:.200}`"
        report.add(codes.COMMAND, node.span, said)
        one.remarks.append(f"was started with: {node.command}")
    return one


def called(node: Node) -> tuple[set[str], ...]:
    """What the component of a process may be called, in lower case; the surest first."""
    words = [re.split(r"[/\\]", word)[-1] for word in node.command.split()]
    programs = {re.sub(r"\.py$", "", word).lower() for word in words}
    return {node.folder.name.lower()}, programs, {node.name.lower()}


def _component_of(node: Node, moved: Sequence[Moved]) -> Moved | None:
    """The component of a process, by its folder, its program, its name; the surest first."""
    for wanted in called(node):
        for one in moved:
            if wanted & {one.folder.name.lower(), one.name.lower()}:
                return one
    return None


def _config_of(node: Node, moved: Moved, report: Report) -> MovedConfig | None:
    if node.config is None:
        return moved.configs[0] if moved.configs else None
    for one in moved.configs:
        if one.old.name == node.config.name:
            return one
    said = f"`{node.name}` had the configuration `{node.config}`, which {moved.name} does not have"
    report.add(codes.MANAGER_SETTING, node.span, said)
    return moved.configs[0] if moved.configs else None


def _order(made: Sequence[Instance], nodes: Sequence[Node], report: Report) -> None:
    """Fill `after`; what names nobody or closes a circle is left out."""
    by_name = {node.name: one for node, one in zip(nodes, made, strict=True)}
    for node, one in zip(nodes, made, strict=True):
        for name, span in node.after:
            other = by_name.get(name)
            if other is None:
                said = f"`{node.name}` depends on `{name}`, which is not in the deployment"
                report.add(codes.DEPENDENCE_DROPPED, span, said)
            elif one.name in _before(other, made):
                said = f"`{node.name}` depends on `{name}`, which waits for `{node.name}` itself"
                report.add(codes.DEPENDENCE_DROPPED, span, said)
            elif other.name not in one.after:
                one.after.append(other.name)


def _before(one: Instance, made: Sequence[Instance]) -> set[str]:
    """The names of `one` and of everything that it waits for."""
    by_name = {other.name: other for other in made}
    found, pending = {one.name}, [one]
    while pending:
        for name in pending.pop().after:
            if name not in found:
                found.add(name)
                pending.append(by_name[name])
    return found


def _give_ports(instances: Sequence[Instance]) -> None:
    """The TCP port of each instance: the first of its addresses that is free on its host."""
    taken: set[tuple[str, int]] = set()
    for one in instances:
        listed = [a for a in one.listens if not a.name.lower().endswith(COMMON)]
        listed = [a for a in listed if not a.identity.lower().endswith(COMMON)]
        for address in listed:
            key = (host_name(one.host), address.port)
            if FIRST_PORT <= address.port <= LAST_PORT and key not in taken and not one.port:
                taken.add(key)
                one.port = address.port
        rest = [a for a in listed if a.port and a.port != one.port]
        words = (f"{a.port} for {a.name}" if a.name else str(a.port) for a in rest)
        one.remarks += [f"listened on port {said}, too" for said in dict.fromkeys(words)]


def by_identity(name: str, known: Iterator[Interface]) -> Interface | None:
    """The interface whose name in lower case is the identity that Ice knew it by."""
    return next((one for one in known if one.name.lower() == name.lower()), None)


def relative(path: str, below: str) -> str:
    """A path in the folder of a component, from the folder of the deployment."""
    return str(PurePosixPath(below) / path) if below else path
