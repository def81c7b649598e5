"""The rules for a resolved InnerModel: consistent numbers and required parts.

In: a resolved `InnerModel`. Out: diagnostics.
"""

from __future__ import annotations

import math

from robocomp_dsl.check.codes import innermodel as codes
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.model.innermodel import (
    MAX_MODULES,
    Battery,
    Gps,
    InnerModel,
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
    TouchSensor,
    Transform,
    Ultrasound,
    children,
)
from robocomp_dsl.model.touch_shapes import feels, shapes_in
from robocomp_dsl.source import Span


def check_innermodel_rules(model: InnerModel, report: Report) -> None:
    """Check the rules of `model`."""
    check_nodes(model, report)
    for node, _ in model.nodes():
        if isinstance(node, TouchSensor) and not feels(node):
            _report_touch(node, report)
        if isinstance(node, Joint | PrismaticJoint):
            _check_home(node, report)
    if any(isinstance(node, Patch) for node, _ in model.nodes()):
        from robocomp_dsl.check.innermodel.skins import check_skins  # noqa: PLC0415 - numpy

        check_skins(model, report)


def _report_touch(node: TouchSensor, report: Report) -> None:
    shape = next(shapes_in(node), None)
    remedy = (
        f'set `collide="1"` on `{shape.id}`'
        if shape
        else 'put a `<plane>` or a `<mesh>` with `collide="1"` into it'
    )
    message = f"`{node.id}` would never feel anything: no shape in it collides"
    report.add(codes.INNERMODEL_TOUCH, _place(node), message, help=remedy)


def check_nodes(model: InnerModel, report: Report) -> None:
    """Check the attributes of all nodes; files that they name are not read."""
    for node, parent in model.nodes():
        for message in violations(node, parent):
            report.add(codes.INNERMODEL_RULE, _place(node), message)


def _check_home(joint: Joint | PrismaticJoint, report: Report) -> None:
    home, low, high = joint.home, joint.min, joint.max
    if home is None or low > high or low <= home <= high:
        return
    near = low if home < low else high
    message = f"`home` ({home:g}) is outside `min` … `max`: that of `{joint.id}` is {near:g}"
    report.add(codes.INNERMODEL_HOME, _place(joint), message)


def _place(node: Node) -> Span:
    source, start = node.span.source, node.span.start
    return source.span(start, start + 1 + len(node.tag))


def violations(node: Node, parent: Node | None) -> list[str]:
    """What is inconsistent in the attributes of a node, one message each."""
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
            return _robocomp_violations(node, parent)


def _robocomp_violations(node: Node, parent: Node | None) -> list[str]:
    """Violations of RoboComp's own tags and of motors."""
    messages: list[str] = []
    match node:
        case Joint() | PrismaticJoint() if node.min > node.max:
            messages += [
                f"`min` ({node.min:g}) exceeds `max` ({node.max:g}): `{node.id}` cannot move"
            ]
        case Motor() if not isinstance(parent, Joint | PrismaticJoint):
            messages += ["a motor must be a child of the joint that it drives"]
        case Motor() if min(node.force, node.gear, node.velocity) <= 0:
            messages += ["`force`, `gear` and `velocity` of a motor must be positive"]
        case Transform() if node.mass < 0:
            messages += [f"`mass` must not be negative, not {node.mass:g} kg"]
        case Plane() if not all(map(math.isfinite, node.size)):
            messages += [f"`size` must contain finite numbers, not {_shown(node.size)}"]
        case Mesh():
            messages += _mesh(node)
        case Laser() if node.min > node.max:
            messages += [f"`min` ({node.min} mm) is greater than `max` ({node.max} mm)"]
        case Laser() if node.measures < 0 or node.angle < 0:
            messages += ["`measures` and `angle` cannot be negative"]
    return messages


def _sensor(node: Ultrasound | Battery | Gps) -> list[str]:
    match node:
        case Ultrasound() if node.min > node.max:
            return [f"`min` ({node.min} mm) is greater than `max` ({node.max} mm)"]
        case Battery() if min(node.capacity, node.voltage) <= 0 or node.idle < 0:
            return ["`capacity` and `voltage` must be positive, `idle` not negative"]
        case Gps() if abs(node.latitude) > 84 or abs(node.longitude) > 180:
            return ["`latitude` is -84 to 84 degrees, `longitude` -180 to 180"]
    return []


def _mesh(node: Mesh) -> list[str]:
    messages = [] if node.file else ["a mesh needs a `file`"]
    if 0 in node.scale or not all(map(math.isfinite, node.scale)):
        messages.append(
            f"`scale` must contain finite numbers other than 0, not {_shown(node.scale)}"
        )
    return messages


def _skin(node: Skin, parent: Node | None) -> list[str]:
    messages = [] if node.children else [f"the skin `{node.id}` has no `<patch>`"]
    if node.rate <= 0:
        messages.append(f"`rate` must be positive, not {node.rate:g} Hz")
    first = next(child for child in children(parent) if isinstance(child, Skin)) if parent else node
    if first is not node:
        messages.append(f"this frame already has the skin `{first.id}`: move the patches to it")
    return messages


def _patch(node: Patch) -> list[str]:
    messages = []
    forms = {"`rings`": node.rings, "a `file`": node.file, "`<taxel>` elements": node.children}
    used = [name for name, value in forms.items() if value]
    if len(used) != 1:
        found = "none of them" if not used else " and ".join(used)
        messages.append(
            f"the taxels of a patch are given by one of {', '.join(forms)}; this one has {found}"
        )
    if node.cone and not node.x0 < node.x1:
        messages.append(f"`x0` must be less than `x1`, not {node.x0:g} to {node.x1:g}")
    if node.cone and min(node.r0, node.r1) <= 0:
        messages.append("a cone needs the radii `r0` and `r1`, above 0")
    if node.rings and not node.cone:
        messages.append("`rings` go round a cone: give `x0`, `x1`, `r0` and `r1`")
    if node.rings and node.count < 1:
        messages.append("`rings` need the `count` of modules in each")
    if node.rings and node.count > MAX_MODULES:
        messages.append(f"a ring has at most {MAX_MODULES} modules, not {node.count}")
    if node.firstid < 0:
        messages.append(f"taxels are numbered from 0, not {node.firstid}")
    return messages


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
    return ", ".join(f"{number:g}" for number in numbers)
