"""The drawing of a bridge: foreign peers, inputs, hubs, outputs.

In: model and site. Out: a figure; messages flow from left to right.
"""

from __future__ import annotations

from robocomp_dsl.generate.doc.graph import GraphEdge, GraphNode, draw_graph
from robocomp_dsl.generate.doc.nodes import Figure
from robocomp_dsl.generate.doc.site import DocumentationSite
from robocomp_dsl.model.bridge import Bridge
from robocomp_dsl.model.bridge_ports import BridgePort

_CORNER = 18.0
_FLOW, _CALL = "topic", "call"


class _FigureParts:
    """Collects nodes and edges."""

    def __init__(self) -> None:
        self.nodes: list[GraphNode] = []
        self.edges: list[GraphEdge] = []

    def add(self, node: GraphNode) -> int:
        """Add a node; returns its index."""
        self.nodes.append(node)
        return len(self.nodes) - 1

    def join(self, source: int, target: int, kind: str = _FLOW) -> None:
        """Add an edge."""
        self.edges.append(GraphEdge(source, target, kind))


def bridge_figure(bridge: Bridge, site: DocumentationSite) -> Figure:
    """What flows from which peer through which hub to which peer."""
    parts = _FigureParts()
    inputs: dict[str, int] = {}
    for item in bridge.inputs:
        inputs[item.name] = parts.add(_own(item.name, "input"))
        parts.join(parts.add(_peer(item.port)), inputs[item.name])
    hubs: dict[str, int] = {}
    for hub in bridge.hubs:
        hubs[hub.name] = parts.add(_own(hub.name, f"hub, {hub.policy.value}"))
        for item in hub.inputs:
            parts.join(inputs[item.name], hubs[hub.name])
    for output in bridge.outputs:
        index = parts.add(_own(output.name, "output"))
        for item in dict.fromkeys((*output.uses.inputs, *output.uses.stamps)):
            parts.join(inputs[item.name], index)
        for hub in output.uses.hubs:
            parts.join(hubs[hub.name], index)
        parts.join(index, parts.add(_peer(output.port)))
    for service in bridge.services:
        index = parts.add(_own(service.name, "service"))
        parts.join(parts.add(_peer(service.port)), index, _CALL)
        for call in service.calls:
            parts.join(index, parts.add(_peer(call.port)), _CALL)
    title = f"What flows through {bridge.name}"
    about = f"{len(bridge.inputs)} inputs, {len(bridge.hubs)} hubs, {len(bridge.outputs)} outputs"
    drawing = draw_graph(title, about, parts.nodes, parts.edges)
    return Figure(f"{site.page(bridge)}.graph", drawing)


def _own(name: str, what: str) -> GraphNode:
    return GraphNode(name, "component", None, what, f"{what} {name}")


def _peer(port: BridgePort) -> GraphNode:
    below = f"over {port.middleware}"
    name = port.address or port.name
    return GraphNode(name, "interface", None, below, f"{name}, {below}", _CORNER)
