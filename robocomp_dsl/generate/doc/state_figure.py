"""The diagram of a state machine: states within states as boxes within boxes.

In: a state machine. Out: a figure.
"""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.generate.doc.drawing import Box, Drawing, Label, Line, line, shifted
from robocomp_dsl.generate.doc.graph import MARGIN, plate
from robocomp_dsl.generate.doc.layered import Node, Point
from robocomp_dsl.generate.doc.state_levels import DOT, HEAD, Level, Way, levels_of
from robocomp_dsl.generate.doc.state_words import shown
from robocomp_dsl.generate.doc.words import Figure
from robocomp_dsl.model.statemachine import State, StateMachine

RING = 3.5
"""Distance of the two borders of an end state."""


def state_figure(machine: StateMachine, name: str) -> Figure:
    """The diagram, in a file of this name."""
    root = levels_of(machine)
    drawing = Drawing(
        root.width + 2 * MARGIN,
        root.height + 2 * MARGIN,
        f"State machine {machine.name}",
        f"{_count(machine.states)} states, {len(machine.transitions)} transitions",
        tuple(_painted(root, MARGIN, MARGIN)),
    )
    return Figure(name, drawing)


def _count(states: tuple[State, ...]) -> int:
    return len(states) + sum(_count(one.inside) for one in states)


def _painted(level: Level, x: float, y: float) -> Iterator[Box | Line]:
    """The contents of a box whose upper left corner is at (x, y)."""
    left, top = x + level.left, y + level.top
    for i, state in enumerate(level.states):
        dx, dy = level.made.nodes[i]
        inner = level.inner.get(i)
        if inner is None:
            yield from _state(state, level.nodes[i], left + dx, top + dy)
        else:
            yield from _composite(state, inner, left + dx, top + dy)
    for dx, dy in level.made.nodes[len(level.states) + len(level.crossings) :]:
        yield Box(left + dx, top + dy, DOT, DOT, "dot", "initial", DOT / 2)
    for way, route in zip(level.ways, level.made.routes, strict=True):
        points = shifted(route.points, left, top)
        yield line(_to_border(points, way, level), "step", _about(way), arrow=way.arrow)
    for way, route in zip(level.ways, level.made.routes, strict=True):
        if way.labels:
            said = [(one, None) for one in way.labels]
            yield plate(said, "step", route.label[0] + left, route.label[1] + top)


def _state(state: State, node: Node, x: float, y: float) -> Iterator[Box]:
    name = Label(x + node.width / 2, y + node.height / 2, shown(state), "name")
    about = f"{state.name}: an end" if state.final else state.name
    corner = node.height / 2 if state.history else 10.0
    yield Box(x, y, node.width, node.height, "state", about, corner, (name,))
    if state.final:
        width, height = node.width - 2 * RING, node.height - 2 * RING
        yield Box(x + RING, y + RING, width, height, "ring", corner=10.0 - RING)


def _composite(state: State, inner: Level, x: float, y: float) -> Iterator[Box | Line]:
    """A box with a head, and what is inside it."""
    kind = "parallel" if state.parallel else "states"
    name = Label(x + inner.width / 2, y + HEAD / 2, shown(state), "name")
    yield Box(x, y, inner.width, inner.height, kind, state.name, 10.0, (name,))
    ends = ((x, y + HEAD), (x + inner.width, y + HEAD))
    yield line((ends[0], *ends, ends[1]), "rule", arrow=False)
    yield from _painted(inner, x, y)


def _to_border(points: tuple[Point, ...], way: Way, level: Level) -> tuple[Point, ...]:
    """A line that crosses the border of the box goes on to where that is drawn."""
    first, last = len(level.states), len(level.states) + len(level.crossings)
    if first <= way.source < last:
        end = _beyond(points[0], level.crossings[way.source - first].right, level)
        points = (end, end, points[0], *points)
    if first <= way.target < last:
        end = _beyond(points[-1], level.crossings[way.target - first].right, level)
        points = (*points, points[-1], points[-1], end)
    return points


def _beyond(point: Point, right: bool, level: Level) -> Point:
    return (point[0] + (level.left if right else -level.left), point[1])


def _about(way: Way) -> str:
    source, target = way.pair
    fired = f": {', '.join(way.labels)}" if way.labels else ""
    return f"{source} to {target}{fired}" if source else f"{target} is the first"
