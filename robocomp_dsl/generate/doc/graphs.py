"""The graphs of pages: a deployment with its wires, a component with its ports.

In: model and site. Out: figures. A call goes from the one that requires to the one that implements,
a topic from the one that publishes to those that subscribe.
"""

from __future__ import annotations

from robocomp_dsl.generate.doc.graph import GraphEdge, GraphNode, drawn
from robocomp_dsl.generate.doc.site import Site
from robocomp_dsl.generate.doc.words import Figure, Target
from robocomp_dsl.model.component import Component, Port, Role
from robocomp_dsl.model.deployment import Connection, Deployment, Instance

CALL, TOPIC = "call", "topic"
LEGEND = ((CALL, "calls"), (TOPIC, "publishes to"))


def deployment_figure(deployment: Deployment, site: Site) -> Figure:
    """Instances, and what is wired between them; wires between the same two are one line."""
    at = {id(one): i for i, one in enumerate(deployment.instances)}
    nodes = [_instance(one, site) for one in deployment.instances]
    bundles: dict[tuple[int, int, str], list[Connection]] = {}
    for one in deployment.connections:
        kind = TOPIC if one.source_port.role.is_topic else CALL
        ends = at[id(one.source)], at[id(one.target)]
        bundles.setdefault((*ends, kind), []).append(one)
    edges = [
        GraphEdge(source, target, kind, _labels(wires, site), _about(wires))
        for (source, target, kind), wires in bundles.items()
    ]
    title = f"Components of {deployment.name} and how they are wired"
    count = f"{len(nodes)} components, {len(deployment.connections)} wires"
    drawing = drawn(title, count, nodes, edges)
    return Figure(f"{site.page(deployment)}.graph", drawing, _legend(edges))


def _instance(one: Instance, site: Site) -> GraphNode:
    host = f" on {one.host.name}" if one.host.name else ""
    below = f"{one.component.name if one.component.name != one.name else ''}{host}".strip()
    about = f"{one.name}: component {one.component.name}{host}"
    return GraphNode(one.name, "component", Target(site.page(one.component)), below, about)


def _labels(wires: list[Connection], site: Site) -> tuple[tuple[str, Target | None], ...]:
    shown: dict[str, Target | None] = {}
    for one in wires:
        shown.setdefault(one.source_port.name, site.target(one.source_port.interface))
    return tuple(shown.items())


def _about(wires: list[Connection]) -> str:
    return "; ".join(
        f"{w.source.name}.{w.source_port.name} to {w.target.name}.{w.target_port.name}"
        for w in wires
    )


def _legend(edges: list[GraphEdge]) -> tuple[tuple[str, str], ...]:
    used = {edge.kind for edge in edges}
    return tuple((kind, said) for kind, said in LEGEND if kind in used)


def component_figure(component: Component, site: Site) -> Figure:
    """The component between what it serves and hears, and what it calls and tells."""
    nodes = [GraphNode(component.name, "component", None, "", component.name)]
    edges = []
    for port in component.ports:
        nodes.append(_port(port, site))
        kind = TOPIC if port.role.is_topic else CALL
        inward = port.role in (Role.IMPLEMENTS, Role.SUBSCRIBES)
        ends = (len(nodes) - 1, 0) if inward else (0, len(nodes) - 1)
        edges.append(GraphEdge(*ends, kind, ((_WORDS[port.role], None),)))
    title = f"Ports of {component.name}"
    drawing = drawn(title, f"{len(component.ports)} ports", nodes, edges)
    return Figure(f"{site.page(component)}.ports", drawing)


def fitting_figure(site: Site) -> Figure | None:
    """Which components could work together; None where no two have an interface in common."""
    components = site.subject.components
    found: dict[tuple[int, int, str], dict[str, Target | None]] = {}
    for i, client in enumerate(components):
        for port in (*client.with_role(Role.REQUIRES), *client.with_role(Role.PUBLISHES)):
            wanted = Role.SUBSCRIBES if port.role.is_topic else Role.IMPLEMENTS
            target = site.target(port.interface)
            for j, server in enumerate(components):
                if any(site.target(p.interface) == target for p in server.with_role(wanted)):
                    kind = TOPIC if port.role.is_topic else CALL
                    found.setdefault((i, j, kind), {})[port.interface.name] = target
    if not found:
        return None
    nodes = [GraphNode(c.name, "component", Target(site.page(c)), "", c.name) for c in components]
    edges = [
        GraphEdge(*key, tuple(names.items()), ", ".join(names)) for key, names in found.items()
    ]
    title = "Components and what they can use of each other"
    drawing = drawn(title, f"{len(nodes)} components", nodes, edges)
    return Figure("components/all.graph", drawing, _legend(edges))


_WORDS = {
    Role.IMPLEMENTS: "implements",
    Role.REQUIRES: "requires",
    Role.PUBLISHES: "publishes",
    Role.SUBSCRIBES: "subscribes to",
}


def _port(port: Port, site: Site) -> GraphNode:
    below = port.interface.name if port.name != port.interface.name else ""
    about = f"{port.name}: interface {port.interface.qualified}"
    target = site.target(port.interface)
    return GraphNode(port.name, "interface", target, below, about, corner=18.0)
