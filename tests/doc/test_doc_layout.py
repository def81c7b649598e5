"""Whatever the graph: nothing overlaps, lines begin and end at their nodes, and go to the right."""

from __future__ import annotations

from itertools import combinations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.generate.doc.layered import Edge, Layout, Node, layout, ranks_of, roomy

Rectangle = tuple[float, float, float, float]

NODES = st.builds(Node, st.floats(20, 200), st.floats(10, 80))


@st.composite
def graphs(draw: st.DrawFn) -> tuple[list[Node], list[Edge]]:
    """Any graph: cycles, loops, several edges between the same two, parts apart."""
    nodes = draw(st.lists(NODES, min_size=1, max_size=12))
    ends = st.integers(0, len(nodes) - 1)
    edge = st.builds(Edge, ends, ends, st.sampled_from([0.0, 40.0, 90.0]), st.just(17.0))
    return nodes, draw(st.lists(edge, max_size=24))


def _labels(edges: list[Edge], made: Layout) -> list[Rectangle]:
    return [
        (r.label[0] - e.width / 2, r.label[1] - e.height / 2, e.width, e.height)
        for e, r in zip(edges, made.routes, strict=True)
        if e.width
    ]


def _overlap(one: Rectangle, other: Rectangle) -> bool:
    return all(
        one[i] + one[i + 2] > other[i] + 1e-6 and other[i] + other[i + 2] > one[i] + 1e-6
        for i in (0, 1)
    )


@settings(max_examples=150)
@given(graphs())
def test_any_graph(graph: tuple[list[Node], list[Edge]]) -> None:
    nodes, edges = graph
    ranks = ranks_of(nodes, edges)
    made = layout(nodes, edges, ranks)
    boxes = [(*at, n.width, n.height) for n, at in zip(nodes, made.nodes, strict=True)]
    for one, other in combinations([*boxes, *_labels(edges, made)], 2):
        assert not _overlap(one, other)
    for i, (edge, route) in enumerate(zip(edges, made.routes, strict=True)):
        assert len(route.points) % 3 == 1
        _touches(route.points[0], boxes[edge.source])
        _touches(route.points[-1], boxes[edge.target])
        if edge.source != edge.target:
            left, right = ranks.ends(i, edge)
            assert ranks.of[left] < ranks.of[right]
            steps = [x for x, _ in route.points]
            assert steps == sorted(steps, reverse=i in ranks.turned)
    for x, y, width, height in boxes:
        assert -1e-6 <= x <= made.width - width + 1e-6
        assert -1e-6 <= y <= made.height - height + 1e-6
    assert layout(nodes, edges) == made


def _touches(point: tuple[float, float], box: Rectangle) -> None:
    x, y, width, height = box
    assert x - 1e-6 <= point[0] <= x + width + 1e-6
    assert y - 1e-6 <= point[1] <= y + height + 1e-6
    assert min(abs(point[0] - x), abs(point[0] - x - width), abs(point[1] - y)) < 1e-6


def _crossed(count: int, edges: list[tuple[int, int]]) -> Layout:
    return layout([Node(50, 20)] * count, [Edge(*ends) for ends in edges])


def test_a_chain_is_a_straight_line() -> None:
    made = _crossed(4, [(0, 1), (1, 2), (2, 3)])
    assert len({y for _, y in made.nodes}) == 1
    assert [x for x, _ in made.nodes] == sorted(x for x, _ in made.nodes)


def test_crossings_that_can_be_avoided_are() -> None:
    made = _crossed(6, [(0, 5), (1, 4), (2, 3)])
    right = [made.nodes[i][1] for i in (5, 4, 3)]
    assert right == sorted(right)


def test_only_the_edge_that_closes_a_cycle_is_turned() -> None:
    ranks = ranks_of([Node(9, 9)] * 3, [Edge(0, 1), Edge(1, 2), Edge(2, 0), Edge(1, 1)])
    assert (ranks.of, ranks.turned) == ([0, 1, 2], {2})


def test_border_nodes_are_outermost() -> None:
    nodes = [Node(0, 0, "first"), Node(9, 9), Node(9, 9), Node(0, 0, "last")]
    ranks = ranks_of(nodes, [Edge(1, 2), Edge(2, 0), Edge(1, 3)])
    assert ranks.of == [0, 1, 2, 3]
    assert ranks.turned == {1}


def test_a_fixed_place_on_the_border_is_kept() -> None:
    nodes = [Node(50, 100), Node(50, 20), Node(50, 20)]
    made = layout(nodes, [Edge(0, 1, leaves=90.0), Edge(0, 2)])
    assert made.routes[0].points[0][1] == pytest.approx(made.nodes[0][1] + 90)


def test_many_lines_make_a_node_higher() -> None:
    nodes = [Node(50, 20)] * 6
    edges = [Edge(i, 5) for i in range(5)]
    assert [n.height for n in roomy(nodes, edges, ranks_of(nodes, edges))] == [20] * 5 + [60]


def test_nothing_at_all() -> None:
    assert layout([], []) == Layout(0, 0, (), ())


def test_a_long_chain_does_not_exhaust_the_stack() -> None:
    count = 3000
    edges = [Edge(i, i + 1) for i in range(count - 1)]
    assert ranks_of([Node(9, 9)] * count, edges).of == list(range(count))
