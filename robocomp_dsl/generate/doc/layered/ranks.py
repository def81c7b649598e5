"""Assign nodes to columns: an edge goes to the right, unless it closes a cycle.

In: nodes and edges. Out: ranks, and the edges that are reversed. After Sugiyama, Tagawa
and Toda, "Methods for visual understanding of hierarchical system structures" (1981), with
depth-first search for the cycles and longest paths for the ranks.
"""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Sequence
from dataclasses import dataclass, replace

from robocomp_dsl.generate.doc.layered.graph import LayoutEdge, LayoutNode

PORT_SPACING = 10.0
"""Distance between the end points of two edges on a node."""


@dataclass(frozen=True, slots=True)
class Ranks:
    """The rank of each node; `reversed_edges` are the indices of edges that go to the left."""

    by_node: list[int]
    reversed_edges: frozenset[int]

    def ends(self, index: int, edge: LayoutEdge) -> tuple[int, int]:
        """The left and the right end of an edge."""
        turned = index in self.reversed_edges
        return (edge.target, edge.source) if turned else (edge.source, edge.target)


def assign_ranks(nodes: Sequence[LayoutNode], edges: Sequence[LayoutEdge]) -> Ranks:
    """Ranks from 0; self-loops are ignored."""
    fixed = {
        i
        for i, edge in enumerate(edges)
        if nodes[edge.target].border == "first" or nodes[edge.source].border == "last"
    }
    ranks = Ranks([0] * len(nodes), frozenset(fixed | _cycle_edges(len(nodes), edges, fixed)))
    after: list[list[int]] = [[] for _ in nodes]
    for i, edge in enumerate(edges):
        left, right = ranks.ends(i, edge)
        if left != right:
            after[left].append(right)
    _assign_longest_paths(ranks.by_node, after)
    _assign_border_ranks(ranks.by_node, nodes)
    return ranks


def fit_ports(
    nodes: Sequence[LayoutNode], edges: Sequence[LayoutEdge], ranks: Ranks
) -> list[LayoutNode]:
    """The nodes, enlarged in height if many edges end on one side."""
    sides = Counter(
        (end, side)
        for i, edge in enumerate(edges)
        for side, end in enumerate(ranks.ends(i, edge))
        if edge.source != edge.target
    )
    most = (max(sides[i, 0], sides[i, 1]) for i in range(len(nodes)))
    return [
        node if count < 2 else replace(node, height=max(node.height, PORT_SPACING * (count + 1)))
        for node, count in zip(nodes, most, strict=True)
    ]


def _cycle_edges(count: int, edges: Sequence[LayoutEdge], fixed: set[int]) -> set[int]:
    """Edges that lead back to a node on the current search path."""
    out: list[list[tuple[int, int]]] = [[] for _ in range(count)]
    entered = [False] * count
    for i, edge in enumerate(edges):
        if i not in fixed and edge.source != edge.target:
            out[edge.source].append((i, edge.target))
            entered[edge.target] = True
    closing: set[int] = set()
    state = [0] * count  # 0 unvisited, 1 on the search path, 2 finished
    for start in sorted(range(count), key=lambda node: entered[node]):
        path = [(start, iter(out[start]))] if not state[start] else []
        state[start] = state[start] or 1
        while path:
            node, rest = path[-1]
            step = next(rest, None)
            if step is None:
                state[node] = 2
                path.pop()
            elif state[step[1]] == 1:
                closing.add(step[0])
            elif not state[step[1]]:
                state[step[1]] = 1
                path.append((step[1], iter(out[step[1]])))
    return closing


def _assign_longest_paths(of: list[int], after: Sequence[Sequence[int]]) -> None:
    waits = [0] * len(of)
    for targets in after:
        for target in targets:
            waits[target] += 1
    begins = [node for node, count in enumerate(waits) if not count]
    todo = deque(begins)
    while todo:
        node = todo.popleft()
        for successor in after[node]:
            of[successor] = max(of[successor], of[node] + 1)
            waits[successor] -= 1
            if not waits[successor]:
                todo.append(successor)
    for node in begins:  # close to their successors
        if after[node]:
            of[node] = min(of[successor] for successor in after[node]) - 1


def _assign_border_ranks(of: list[int], nodes: Sequence[LayoutNode]) -> None:
    inner = [rank for rank, node in zip(of, nodes, strict=True) if not node.border] or [0]
    low, high = min(inner), max(inner)
    shift = 1 - low if any(node.border == "first" for node in nodes) else -low
    for i, node in enumerate(nodes):
        of[i] = {"first": 0, "last": high + shift + 1}.get(node.border, of[i] + shift)
