"""What a body must be beyond its form: numbers that fit together, parts that have what they need.

In: a resolved `Body`. Out: findings.
"""

from __future__ import annotations

import math

from robocomp_dsl.check import codes_body as codes
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.body import (
    MOST_MODULES,
    Battery,
    Body,
    Gps,
    Joint,
    Laser,
    Mesh,
    Motor,
    Node,
    Patch,
    Plane,
    PrismaticJoint,
    Skin,
    Taxel,
    Transform,
    Ultrasound,
    children,
)
from robocomp_dsl.source import Span


def judge_innermodel(body: Body, report: Report) -> None:
    """Add what is wrong with `body` to `report`."""
    for node, parent in body.nodes():
        for said in _complaints(node, parent):
            report.add(codes.BODY_RULE, _place(node), said)
    if any(isinstance(node, Patch) for node, _ in body.nodes()):
        from robocomp_dsl.check.skins import judge_skins  # noqa: PLC0415 - numpy

        judge_skins(body, report)


def _place(node: Node) -> Span:
    source, start = node.span.source, node.span.start
    return source.span(start, start + 1 + len(node.tag))


def _complaints(node: Node, parent: Node | None) -> list[str]:
    match node:
        case Skin():
            return _skin(node, parent)
        case Patch():
            return _patch(node)
        case Taxel() if isinstance(parent, Patch):
            return _taxel(node, parent)
        case Ultrasound() | Battery() | Gps():
            return _sensor(node)
        case _:
            return _old_complaints(node, parent)


def _old_complaints(node: Node, parent: Node | None) -> list[str]:
    """What RoboComp's own tags and motors may not say."""
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


def _sensor(node: Ultrasound | Battery | Gps) -> list[str]:
    match node:
        case Ultrasound() if node.min > node.max:
            return [f"`min` ({node.min} mm) is above `max` ({node.max} mm)"]
        case Battery() if min(node.capacity, node.voltage) <= 0 or node.idle < 0:
            return ["`capacity` and `voltage` must be positive, `idle` not negative"]
        case Gps() if abs(node.latitude) > 84 or abs(node.longitude) > 180:
            return ["`latitude` is -84 to 84 degrees, `longitude` -180 to 180"]
    return []


def _mesh(node: Mesh) -> list[str]:
    said = [] if node.file else ["a mesh needs a `file`"]
    if 0 in node.scale or not all(map(math.isfinite, node.scale)):
        said.append(f"`scale` must be made of finite numbers and no 0, not {_shown(node.scale)}")
    return said


def _skin(node: Skin, parent: Node | None) -> list[str]:
    said = [] if node.children else [f"the skin `{node.id}` has no `<patch>`"]
    if node.rate <= 0:
        said.append(f"`rate` is {node.rate:g} Hz")
    first = next(one for one in children(parent) if isinstance(one, Skin)) if parent else node
    if first is not node:
        said.append(f"this frame has the skin `{first.id}` already: give it the patches here")
    return said


def _patch(node: Patch) -> list[str]:
    said = []
    forms = {"`rings`": node.rings, "a `file`": node.file, "`<taxel>` elements": node.children}
    given = [name for name, one in forms.items() if one]
    if len(given) != 1:
        found = "none of them" if not given else " and ".join(given)
        said.append(f"a patch is laid out by one of {', '.join(forms)}; this one has {found}")
    if node.cone and not node.x0 < node.x1:
        said.append(f"a cone goes from `x0` up to `x1`, not from {node.x0:g} to {node.x1:g}")
    if node.cone and min(node.r0, node.r1) <= 0:
        said.append("a cone needs the radii `r0` and `r1`, above 0")
    if node.rings and not node.cone:
        said.append("`rings` go round a cone: give `x0`, `x1`, `r0` and `r1`")
    if node.rings and node.count < 1:
        said.append("`rings` need the `count` of modules in each")
    if node.rings and node.count > MOST_MODULES:
        said.append(f"a ring has at most {MOST_MODULES} modules, not {node.count}")
    if node.firstid < 0:
        said.append(f"taxels are numbered from 0, not {node.firstid}")
    return said


def _taxel(node: Taxel, patch: Patch) -> list[str]:
    point = any((node.y, node.z, node.nx, node.ny, node.nz))
    if node.theta is not None:
        if point:
            return [
                "a taxel is given by `x` and `theta`, or by a point and its normal, not by both"
            ]
        return [] if patch.cone else ["`theta` needs the cone of the patch: `x0`, `x1`, `r0`, `r1`"]
    if not any((node.nx, node.ny, node.nz)):
        return ["a taxel needs `theta`, or its normal `nx`, `ny`, `nz`"]
    return []


def _shown(numbers: tuple[float, ...]) -> str:
    return ", ".join(f"{one:g}" for one in numbers)
