"""The graphs of pages: a deployment with its connections, a component with its ports.

In: model and site. Out: figures. Calls go from client to server, topics from publisher to
subscriber.
"""

from __future__ import annotations

from robocomp_dsl.generate.doc.graph import GraphEdge, GraphNode, draw_graph
from robocomp_dsl.generate.doc.nodes import Figure
from robocomp_dsl.generate.doc.site import DocumentationSite
from robocomp_dsl.generate.doc.target import Target
from robocomp_dsl.model.component import Component, Port, Role
from robocomp_dsl.model.deployment import Connection, Deployment, External, Group, Instance

CALL, TOPIC = "call", "topic"
LEGEND = ((CALL, "calls"), (TOPIC, "publishes to"))


def deployment_figure(deployment: Deployment, site: DocumentationSite) -> Figure:
    """Instances and groups outside of groups, and their connections; a group is one box."""
    title = f"Components of {deployment.name} and their connections"
    count = f"{len(deployment.instances)} components, {len(deployment.connections)} connections"
    return _figure(deployment, site, "", title, count, ".graph")


def group_figure(deployment: Deployment, group: Group, site: DocumentationSite) -> Figure:
    """The instances and groups in a group, and their connections with each other."""
    title = f"Components of the group {group.name} and their connections"
    count = f"{len(group.instances)} components"
    return _figure(deployment, site, group.name, title, count, f".{group.name}.graph")


def _figure(
    deployment: Deployment,
    site: DocumentationSite,
    scope: str,
    title: str,
    about: str,
    suffix: str,
) -> Figure:
    """What is in the group `scope`; connections between the same two boxes are one line."""
    nodes, position = _boxes(deployment, site, scope)
    bundles: dict[tuple[int, int, str], list[Connection]] = {}
    for connection in deployment.connections:
        kind = TOPIC if connection.source_port.role.is_topic else CALL
        source, target = (position.get(id(c)) for c in (connection.source, connection.target))
        if source is None or target is None or (source == target and _has_groups(connection)):
            continue
        bundles.setdefault((source, target, kind), []).append(connection)
    edges = [
        GraphEdge(source, target, kind, _labels(wires, site), _tooltip(wires))
        for (source, target, kind), wires in bundles.items()
    ]
    drawing = draw_graph(title, about, nodes, edges)
    return Figure(f"{site.page(deployment)}{suffix}", drawing, _legend(edges))


def _has_groups(connection: Connection) -> bool:
    """Whether it is a connection inside of a box, rather than of an instance with itself."""
    return connection.source is not connection.target


def _boxes(
    deployment: Deployment, site: DocumentationSite, scope: str
) -> tuple[list[GraphNode], dict[int, int]]:
    """The nodes in a scope, and the position of the node of each instance (by `id`)."""
    groups = {group.name: group for group in deployment.groups}
    nodes: list[GraphNode] = []
    of_group: dict[str, int] = {}
    position: dict[int, int] = {}
    for instance in (*deployment.instances, *(() if scope else deployment.externals)):
        if instance.group == scope:
            position[id(instance)] = len(nodes)
            nodes.append(_instance(instance, site))
        elif instance.group.startswith(f"{scope}-" if scope else ""):
            inner = instance.group.removeprefix(f"{scope}-" if scope else "").partition("-")[0]
            name = f"{scope}-{inner}" if scope else inner
            if name not in of_group:
                of_group[name] = len(nodes)
                nodes.append(_group(groups[name], site.page(deployment)))
            position[id(instance)] = of_group[name]
    return nodes, position


def _group(group: Group, page: str) -> GraphNode:
    kind = f"{group.definition}, " if group.definition else "group, "
    process = ", one process" if group.inprocess else ""
    subtitle = f"{kind}{len(group.instances)} components{process}"
    tooltip = f"{group.name}: {', '.join(group.instances)}"
    return GraphNode(group.name, "group", Target(page, "groups"), subtitle, tooltip, 2.0)


def _instance(instance: Instance, site: DocumentationSite) -> GraphNode:
    host = f" on {instance.host.name}" if instance.host.name else ""
    if isinstance(instance, External):
        below = f"over {instance.middleware}"
        return GraphNode(instance.name, "interface", None, below, instance.address or below)
    if instance.is_program:
        return GraphNode(instance.name, "component", None, f"program{host}", instance.executable)
    component = instance.component.name
    subtitle = f"{component if component != instance.name else ''}{host}".strip()
    tooltip = f"{instance.name}: component {component}{host}"
    return GraphNode(
        instance.name, "component", Target(site.page(instance.component)), subtitle, tooltip
    )


def _labels(
    wires: list[Connection], site: DocumentationSite
) -> tuple[tuple[str, Target | None], ...]:
    shown: dict[str, Target | None] = {}
    for wire in wires:
        shown.setdefault(wire.source_port.name, site.target(wire.source_port.interface))
    return tuple(shown.items())


def _tooltip(wires: list[Connection]) -> str:
    return "; ".join(
        f"{w.source.name}.{w.source_port.name} to {w.target.name}.{w.target_port.name}"
        for w in wires
    )


def _legend(edges: list[GraphEdge]) -> tuple[tuple[str, str], ...]:
    used = {edge.kind for edge in edges}
    return tuple((kind, label) for kind, label in LEGEND if kind in used)


def component_figure(component: Component, site: DocumentationSite) -> Figure:
    """The component with its ports: inputs on the left, outputs on the right."""
    nodes = [GraphNode(component.name, "component", None, "", component.name)]
    edges = []
    for port in component.ports:
        nodes.append(_port(port, site))
        kind = TOPIC if port.role.is_topic else CALL
        inward = port.role in (Role.IMPLEMENTS, Role.SUBSCRIBES)
        ends = (len(nodes) - 1, 0) if inward else (0, len(nodes) - 1)
        edges.append(GraphEdge(*ends, kind, ((_ROLE_LABELS[port.role], None),)))
    title = f"Ports of {component.name}"
    drawing = draw_graph(title, f"{len(component.ports)} ports", nodes, edges)
    return Figure(f"{site.page(component)}.ports", drawing)


def compatibility_figure(site: DocumentationSite) -> Figure | None:
    """Components with matching interfaces; None if there are none."""
    components = site.subject.components
    matches: dict[tuple[int, int, str], dict[str, Target | None]] = {}
    for i, client in enumerate(components):
        for port in (*client.with_role(Role.REQUIRES), *client.with_role(Role.PUBLISHES)):
            role = Role.SUBSCRIBES if port.role.is_topic else Role.IMPLEMENTS
            target = site.target(port.interface)
            for j, server in enumerate(components):
                if any(site.target(p.interface) == target for p in server.with_role(role)):
                    kind = TOPIC if port.role.is_topic else CALL
                    matches.setdefault((i, j, kind), {})[port.interface.name] = target
    if not matches:
        return None
    nodes = [GraphNode(c.name, "component", Target(site.page(c)), "", c.name) for c in components]
    edges = [
        GraphEdge(*key, tuple(names.items()), ", ".join(names)) for key, names in matches.items()
    ]
    title = "Components with matching interfaces"
    drawing = draw_graph(title, f"{len(nodes)} components", nodes, edges)
    return Figure("components/all.graph", drawing, _legend(edges))


_ROLE_LABELS = {
    Role.IMPLEMENTS: "implements",
    Role.REQUIRES: "requires",
    Role.PUBLISHES: "publishes",
    Role.SUBSCRIBES: "subscribes to",
}


def _port(port: Port, site: DocumentationSite) -> GraphNode:
    below = port.interface.name if port.name != port.interface.name else ""
    about = f"{port.name}: interface {port.interface.qualified}"
    target = site.target(port.interface)
    return GraphNode(port.name, "interface", target, below, about, corner=18.0)
