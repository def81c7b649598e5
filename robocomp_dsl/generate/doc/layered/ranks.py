"""Which column each node stands in: an edge goes to the right, unless it closes a cycle.

In: nodes and edges. Out: ranks, and the edges that are turned round for it. After Sugiyama, Tagawa
and Toda, "Methods for visual understanding of hierarchical system structures" (1981), with
depth-first search for the cycles and longest paths for the ranks.
"""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Sequence
from dataclasses import dataclass, replace

from robocomp_dsl.generate.doc.layered.graph import Edge, Node

PORT = 10.0
"""Distance of two edges where they touch a node."""


@dataclass(frozen=True, slots=True)
class Ranks:
    """The rank of each node; `turned` are the indices of edges that go to the left."""

    of: list[int]
    turned: frozenset[int]

    def ends(self, index: int, edge: Edge) -> tuple[int, int]:
        """The left and the right end of an edge."""
        turned = index in self.turned
        return (edge.target, edge.source) if turned else (edge.source, edge.target)


def ranks_of(nodes: Sequence[Node], edges: Sequence[Edge]) -> Ranks:
    """Ranks from 0; an edge from a node to itself counts for nothing."""
    fixed = {
        i
        for i, edge in enumerate(edges)
        if nodes[edge.target].border == "first" or nodes[edge.source].border == "last"
    }
    made = Ranks([0] * len(nodes), frozenset(fixed | _closing(len(nodes), edges, fixed)))
    after: list[list[int]] = [[] for _ in nodes]
    for i, edge in enumerate(edges):
        left, right = made.ends(i, edge)
        if left != right:
            after[left].append(right)
    _longest(made.of, after)
    _borders(made.of, nodes)
    return made


def roomy(nodes: Sequence[Node], edges: Sequence[Edge], ranks: Ranks) -> list[Node]:
    """The nodes, higher where many edges come to one side."""
    sides = Counter(
        (end, side)
        for i, edge in enumerate(edges)
        for side, end in enumerate(ranks.ends(i, edge))
        if edge.source != edge.target
    )
    most = (max(sides[i, 0], sides[i, 1]) for i in range(len(nodes)))
    return [
        node if count < 2 else replace(node, height=max(node.height, PORT * (count + 1)))
        for node, count in zip(nodes, most, strict=True)
    ]


def _closing(count: int, edges: Sequence[Edge], fixed: set[int]) -> set[int]:
    """Edges that lead back to a node from which the search came."""
    out: list[list[tuple[int, int]]] = [[] for _ in range(count)]
    entered = [False] * count
    for i, edge in enumerate(edges):
        if i not in fixed and edge.source != edge.target:
            out[edge.source].append((i, edge.target))
            entered[edge.target] = True
    found: set[int] = set()
    state = [0] * count  # 0 not seen, 1 on the way, 2 done
    for start in sorted(range(count), key=lambda node: entered[node]):
        way = [(start, iter(out[start]))] if not state[start] else []
        state[start] = state[start] or 1
        while way:
            node, rest = way[-1]
            step = next(rest, None)
            if step is None:
                state[node] = 2
                way.pop()
            elif state[step[1]] == 1:
                found.add(step[0])
            elif not state[step[1]]:
                state[step[1]] = 1
                way.append((step[1], iter(out[step[1]])))
    return found


def _longest(of: list[int], after: Sequence[Sequence[int]]) -> None:
    waits = [0] * len(of)
    for targets in after:
        for one in targets:
            waits[one] += 1
    begins = [node for node, count in enumerate(waits) if not count]
    todo = deque(begins)
    while todo:
        node = todo.popleft()
        for one in after[node]:
            of[one] = max(of[one], of[node] + 1)
            waits[one] -= 1
            if not waits[one]:
                todo.append(one)
    for node in begins:  # close to what they lead to
        if after[node]:
            of[node] = min(of[one] for one in after[node]) - 1


def _borders(of: list[int], nodes: Sequence[Node]) -> None:
    inner = [rank for rank, node in zip(of, nodes, strict=True) if not node.border] or [0]
    low, high = min(inner), max(inner)
    shift = 1 - low if any(node.border == "first" for node in nodes) else -low
    for i, node in enumerate(nodes):
        of[i] = {"first": 0, "last": high + shift + 1}.get(node.border, of[i] + shift)
