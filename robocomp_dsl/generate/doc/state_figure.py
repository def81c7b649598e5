"""The diagram of a state machine: states within states as boxes within boxes.

In: a state machine. Out: a figure.
"""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.generate.doc.drawing import (
    Curve,
    Drawing,
    Label,
    Rectangle,
    draw_curve,
    translate,
)
from robocomp_dsl.generate.doc.graph import MARGIN, label_plate
from robocomp_dsl.generate.doc.layered.layout import LayoutNode, Point
from robocomp_dsl.generate.doc.nodes import Figure
from robocomp_dsl.generate.doc.state_levels import (
    HEADER_HEIGHT,
    INITIAL_DOT_SIZE,
    Level,
    LevelEdge,
    build_levels,
)
from robocomp_dsl.generate.doc.state_words import state_label
from robocomp_dsl.model.statemachine import State, StateMachine

RING_GAP = 3.5
"""Distance of the two borders of an end state."""


def state_figure(machine: StateMachine, name: str) -> Figure:
    """The state diagram, in a file named `name`."""
    root = build_levels(machine)
    drawing = Drawing(
        root.width + 2 * MARGIN,
        root.height + 2 * MARGIN,
        f"State machine {machine.name}",
        f"{_count(machine.states)} states, {len(machine.transitions)} transitions",
        tuple(_paint_level(root, MARGIN, MARGIN)),
    )
    return Figure(name, drawing)


def _count(states: tuple[State, ...]) -> int:
    return len(states) + sum(_count(state.substates) for state in states)


def _paint_level(level: Level, x: float, y: float) -> Iterator[Rectangle | Curve]:
    """Paint the contents of a box whose upper left corner is at (x, y)."""
    left, top = x + level.left, y + level.top
    for i, state in enumerate(level.states):
        dx, dy = level.layout.nodes[i]
        inner = level.sublevels.get(i)
        if inner is None:
            yield from _paint_state(state, level.nodes[i], left + dx, top + dy)
        else:
            yield from _paint_composite(state, inner, left + dx, top + dy)
    for dx, dy in level.layout.nodes[len(level.states) + len(level.crossings) :]:
        yield Rectangle(
            left + dx,
            top + dy,
            INITIAL_DOT_SIZE,
            INITIAL_DOT_SIZE,
            "dot",
            "initial",
            INITIAL_DOT_SIZE / 2,
        )
    for edge, route in zip(level.edges, level.layout.routes, strict=True):
        points = translate(route.points, left, top)
        yield draw_curve(
            _extend_to_border(points, edge, level), "step", _tooltip(edge), arrow=edge.arrow
        )
    for edge, route in zip(level.edges, level.layout.routes, strict=True):
        if edge.labels:
            labels = [(label, None) for label in edge.labels]
            yield label_plate(labels, "step", route.label[0] + left, route.label[1] + top)


def _paint_state(state: State, node: LayoutNode, x: float, y: float) -> Iterator[Rectangle]:
    name = Label(x + node.width / 2, y + node.height / 2, state_label(state), "name")
    about = f"{state.name}: final state" if state.final else state.name
    corner = node.height / 2 if state.history else 10.0
    yield Rectangle(x, y, node.width, node.height, "state", about, corner, (name,))
    if state.final:
        width, height = node.width - 2 * RING_GAP, node.height - 2 * RING_GAP
        yield Rectangle(x + RING_GAP, y + RING_GAP, width, height, "ring", corner=10.0 - RING_GAP)


def _paint_composite(state: State, inner: Level, x: float, y: float) -> Iterator[Rectangle | Curve]:
    """Paint a composite state: a box with a header, and its contents."""
    kind = "parallel" if state.parallel else "states"
    name = Label(x + inner.width / 2, y + HEADER_HEIGHT / 2, state_label(state), "name")
    yield Rectangle(x, y, inner.width, inner.height, kind, state.name, 10.0, (name,))
    ends = ((x, y + HEADER_HEIGHT), (x + inner.width, y + HEADER_HEIGHT))
    yield draw_curve((ends[0], *ends, ends[1]), "rule", arrow=False)
    yield from _paint_level(inner, x, y)


def _extend_to_border(
    points: tuple[Point, ...], edge: LevelEdge, level: Level
) -> tuple[Point, ...]:
    """Extend a line that crosses the border of the box to the drawn border."""
    first, last = len(level.states), len(level.states) + len(level.crossings)
    if first <= edge.source < last:
        end = _border_point(points[0], level.crossings[edge.source - first].right, level)
        points = (end, end, points[0], *points)
    if first <= edge.target < last:
        end = _border_point(points[-1], level.crossings[edge.target - first].right, level)
        points = (*points, points[-1], points[-1], end)
    return points


def _border_point(point: Point, right: bool, level: Level) -> Point:
    return (point[0] + (level.left if right else -level.left), point[1])


def _tooltip(edge: LevelEdge) -> str:
    source, target = edge.pair
    fired = f": {', '.join(edge.labels)}" if edge.labels else ""
    return f"{source} to {target}{fired}" if source else f"{target} is initial"
