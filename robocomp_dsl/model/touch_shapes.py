"""The shapes that a touch sensor of InnerModel feels with.

In: a resolved touch sensor. Out: the planes and meshes in it, and whether one of them collides.
"""

from __future__ import annotations

from collections.abc import Iterator

from robocomp_dsl.model.innermodel import Mesh, Node, Plane, TouchSensor, children


def shapes_in(sensor: TouchSensor) -> Iterator[Plane | Mesh]:
    """The shapes in a sensor and in all frames below it."""
    todo: list[Node] = [sensor]
    while todo:
        node = todo.pop()
        if isinstance(node, Plane | Mesh):
            yield node
        todo.extend(reversed(children(node)))


def feels(sensor: TouchSensor) -> bool:
    """Whether a shape of the sensor collides; otherwise nothing could touch it."""
    return any(shape.collide for shape in shapes_in(sensor))
