"""The names of middlewares in a file, and what is shown of a middleware.

In: a tree. Out: its names of middlewares; Markdown for one of them.
"""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.check.workspace.middlewares import KnownMiddlewares
from robocomp_dsl.syntax.ast import bdsl, cdsl, ddsl
from robocomp_dsl.syntax.ast.base import Name


def middleware_names(tree: object) -> Iterator[Name]:
    """All names of middlewares in the tree of a CDSL, DDSL or BDSL file."""
    match tree:
        case cdsl.File(component=cdsl.Component() as component):
            if component.middleware:
                yield component.middleware
            for port in component.ports:
                yield from port.middlewares
        case ddsl.File():
            yield from _of_deployments(tree)
        case bdsl.File(bridge=bdsl.Bridge() as bridge):
            if bridge.middleware:
                yield bridge.middleware
            calls = (call.place for service in bridge.services for call in service.calls)
            places = [item.place for item in bridge.inputs]
            places += [item.place for item in bridge.outputs]
            places += [item.place for item in bridge.services]
            yield from (p.middleware for p in (*places, *calls) if p.middleware)


def _of_deployments(tree: ddsl.File) -> Iterator[Name]:
    deployment = tree.deployment
    if deployment is not None:
        if deployment.middleware:
            yield deployment.middleware
        yield from (external.over for external in deployment.externals)
        yield from (link.middleware for link in deployment.external_connections)
        yield from _in_block(deployment)
    for group in tree.groups:
        yield from _in_block(group)


def _in_block(block: ddsl.Deployment | ddsl.Group) -> Iterator[Name]:
    for instance in block.instances:
        if instance.middleware:
            yield instance.middleware
        yield from (own.over for own in instance.own_ports)
    yield from (connection.over for connection in block.connections if connection.over)
    for group in block.groups:
        yield from _in_block(group)


def describe_middleware(written: str, known: KnownMiddlewares) -> str:
    """The summary and capabilities of a middleware as Markdown; empty if it is unknown."""
    name = known.find(written)
    description = known.describe(name) if name else None
    if description is None:
        return ""
    can = description.capabilities
    lines = [
        "services and topics"
        if can.services and can.topics
        else "services only"
        if can.services
        else "topics only",
        "between machines"
        if can.between_hosts
        else "on one machine"
        if can.between_processes
        else "within one process",
    ]
    if can.external_peers:
        lines.append("external programs")
    if can.external_port_names:
        lines.append("connects external programs with each other")
    if can.qos:
        lines.append(f"quality of service: {', '.join(sorted(can.qos))}")
    if description.requires:
        lines.append(f"needs {', '.join(f'`{module}`' for module in description.requires)}")
    listed = "\n".join(f"- {line}" for line in lines)
    return f"**{description.name}**: {description.summary}\n\n{listed}"
