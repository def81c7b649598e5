"""Layout of any graph: no overlaps, edges end at their nodes and run from left to right."""

from __future__ import annotations

from itertools import combinations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.generate.doc.layered.layout import (
    GraphLayout,
    LayoutEdge,
    LayoutNode,
    assign_ranks,
    fit_ports,
    layout,
)

Rectangle = tuple[float, float, float, float]

NODES = st.builds(LayoutNode, st.floats(20, 200), st.floats(10, 80))


@st.composite
def graphs(draw: st.DrawFn) -> tuple[list[LayoutNode], list[LayoutEdge]]:
    """Any graph: cycles, loops, parallel edges, separate components."""
    nodes = draw(st.lists(NODES, min_size=1, max_size=12))
    ends = st.integers(0, len(nodes) - 1)
    edge = st.builds(LayoutEdge, ends, ends, st.sampled_from([0.0, 40.0, 90.0]), st.just(17.0))
    return nodes, draw(st.lists(edge, max_size=24))


def _labels(edges: list[LayoutEdge], layout_: GraphLayout) -> list[Rectangle]:
    return [
        (r.label[0] - e.width / 2, r.label[1] - e.height / 2, e.width, e.height)
        for e, r in zip(edges, layout_.routes, strict=True)
        if e.width
    ]


def _overlap(first: Rectangle, other: Rectangle) -> bool:
    return all(
        first[i] + first[i + 2] > other[i] + 1e-6 and other[i] + other[i + 2] > first[i] + 1e-6
        for i in (0, 1)
    )


@settings(max_examples=150)
@given(graphs())
def test_layout_of_random_graph_is_valid(graph: tuple[list[LayoutNode], list[LayoutEdge]]) -> None:
    nodes, edges = graph
    ranks = assign_ranks(nodes, edges)
    layout_ = layout(nodes, edges, ranks)
    boxes = [(*index, n.width, n.height) for n, index in zip(nodes, layout_.nodes, strict=True)]
    for first, other in combinations([*boxes, *_labels(edges, layout_)], 2):
        assert not _overlap(first, other)
    for i, (edge, route) in enumerate(zip(edges, layout_.routes, strict=True)):
        assert len(route.points) % 3 == 1
        _touches(route.points[0], boxes[edge.source])
        _touches(route.points[-1], boxes[edge.target])
        if edge.source != edge.target:
            left, right = ranks.ends(i, edge)
            assert ranks.by_node[left] < ranks.by_node[right]
            steps = [x for x, _ in route.points]
            assert steps == sorted(steps, reverse=i in ranks.reversed_edges)
    for x, y, width, height in boxes:
        assert -1e-6 <= x <= layout_.width - width + 1e-6
        assert -1e-6 <= y <= layout_.height - height + 1e-6
    assert layout(nodes, edges) == layout_


def _touches(point: tuple[float, float], box: Rectangle) -> None:
    x, y, width, height = box
    assert x - 1e-6 <= point[0] <= x + width + 1e-6
    assert y - 1e-6 <= point[1] <= y + height + 1e-6
    assert min(abs(point[0] - x), abs(point[0] - x - width), abs(point[1] - y)) < 1e-6


def _crossed(count: int, edges: list[tuple[int, int]]) -> GraphLayout:
    return layout([LayoutNode(50, 20)] * count, [LayoutEdge(*ends) for ends in edges])


def test_layout_of_chain_is_straight_line() -> None:
    layout_ = _crossed(4, [(0, 1), (1, 2), (2, 3)])
    assert len({y for _, y in layout_.nodes}) == 1
    assert [x for x, _ in layout_.nodes] == sorted(x for x, _ in layout_.nodes)


def test_layout_avoids_crossings() -> None:
    layout_ = _crossed(6, [(0, 5), (1, 4), (2, 3)])
    right = [layout_.nodes[i][1] for i in (5, 4, 3)]
    assert right == sorted(right)


def test_assign_ranks_reverses_only_edge_that_closes_cycle() -> None:
    ranks = assign_ranks(
        [LayoutNode(9, 9)] * 3,
        [LayoutEdge(0, 1), LayoutEdge(1, 2), LayoutEdge(2, 0), LayoutEdge(1, 1)],
    )
    assert (ranks.by_node, ranks.reversed_edges) == ([0, 1, 2], {2})


def test_assign_ranks_puts_border_nodes_outermost() -> None:
    nodes = [
        LayoutNode(0, 0, "first"),
        LayoutNode(9, 9),
        LayoutNode(9, 9),
        LayoutNode(0, 0, "last"),
    ]
    ranks = assign_ranks(nodes, [LayoutEdge(1, 2), LayoutEdge(2, 0), LayoutEdge(1, 3)])
    assert ranks.by_node == [0, 1, 2, 3]
    assert ranks.reversed_edges == {1}


def test_layout_keeps_fixed_source_offset() -> None:
    nodes = [LayoutNode(50, 100), LayoutNode(50, 20), LayoutNode(50, 20)]
    layout_ = layout(nodes, [LayoutEdge(0, 1, source_offset=90.0), LayoutEdge(0, 2)])
    assert layout_.routes[0].points[0][1] == pytest.approx(layout_.nodes[0][1] + 90)


def test_fit_ports_enlarges_node_with_many_edges() -> None:
    nodes = [LayoutNode(50, 20)] * 6
    edges = [LayoutEdge(i, 5) for i in range(5)]
    assert [n.height for n in fit_ports(nodes, edges, assign_ranks(nodes, edges))] == [20] * 5 + [
        60
    ]


def test_layout_of_empty_graph() -> None:
    assert layout([], []) == GraphLayout(0, 0, (), ())


def test_assign_ranks_of_long_chain_is_iterative() -> None:
    count = 3000
    edges = [LayoutEdge(i, i + 1) for i in range(count - 1)]
    assert assign_ranks([LayoutNode(9, 9)] * count, edges).by_node == list(range(count))
