"""What a body must be beyond its form: numbers that fit together, parts that have what they need.

In: a resolved `Body`. Out: findings.
"""

from __future__ import annotations

import math

from robocomp_dsl.check import codes_body as codes
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.body import (
    Body,
    Joint,
    Laser,
    Mesh,
    Motor,
    Node,
    Plane,
    PrismaticJoint,
    Transform,
)
from robocomp_dsl.source import Span


def judge_innermodel(body: Body, report: Report) -> None:
    """Add what is wrong with `body` to `report`."""
    for node, parent in body.nodes():
        for said in _complaints(node, parent):
            report.add(codes.BODY_RULE, _place(node), said)


def _place(node: Node) -> Span:
    source, start = node.span.source, node.span.start
    return source.span(start, start + 1 + len(node.tag))


def _complaints(node: Node, parent: Node | None) -> list[str]:
    said: list[str] = []
    match node:
        case Joint() | PrismaticJoint() if node.min > node.max:
            said += [f"`min` ({node.min:g}) is above `max` ({node.max:g}): `{node.id}` cannot move"]
        case Motor() if not isinstance(parent, Joint | PrismaticJoint):
            said += ["a motor drives the joint it stands in; this one stands in none"]
        case Transform() if node.mass < 0:
            said += [f"`mass` is {node.mass:g} kg"]
        case Plane() if not all(map(math.isfinite, node.size)):
            said += [f"`size` must be made of finite numbers, not {_shown(node.size)}"]
        case Mesh():
            said += _mesh(node)
        case Laser() if node.min > node.max:
            said += [f"`min` ({node.min} mm) is above `max` ({node.max} mm)"]
        case Laser() if node.measures < 0 or node.angle < 0:
            said += ["`measures` and `angle` cannot be negative"]
    return said


def _mesh(node: Mesh) -> list[str]:
    said = [] if node.file else ["a mesh needs a `file`"]
    if 0 in node.scale or not all(map(math.isfinite, node.scale)):
        said.append(f"`scale` must be made of finite numbers and no 0, not {_shown(node.scale)}")
    return said


def _shown(numbers: tuple[float, ...]) -> str:
    return ", ".join(f"{one:g}" for one in numbers)
