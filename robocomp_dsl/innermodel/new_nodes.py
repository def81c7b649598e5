"""Adds nodes to an InnerModel, with RoboComp's constructors.

In: an id, the node that holds the new one (itself or its id), and the attributes, in RoboComp's
order and with its defaults. Out: the node, or the handle of a joint. Lengths are mm, angles rad.
An id that exists and an attribute that `rcgen check` would reject raise `InnerModelError`.
"""

# ruff: noqa: N802  names as in RoboComp

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from robocomp_dsl.check.innermodel.rules import violations
from robocomp_dsl.check.innermodel.tags import TAGS
from robocomp_dsl.innermodel.attribute_values import checked_text, checked_value
from robocomp_dsl.innermodel.errors import InnerModelError
from robocomp_dsl.innermodel.joints import InnerModelJoint, InnerModelPrismaticJoint
from robocomp_dsl.innermodel.shared_state import NodeOrId, id_of, locked
from robocomp_dsl.innermodel.updates import PoseUpdates
from robocomp_dsl.model.innermodel import Node
from robocomp_dsl.source import Source

_NO_FILE = Source(Path("new"), "").file_span
_RENDER = {0: "normal", 1: "wireframe"}


class NewNodes(PoseUpdates):
    """The part of `InnerModel` that adds nodes."""

    def newTransform(
        self,
        id: str,
        engine: str,
        parent: NodeOrId,
        tx: float = 0,
        ty: float = 0,
        tz: float = 0,
        rx: float = 0,
        ry: float = 0,
        rz: float = 0,
        mass: float = 0,
    ) -> Node:
        """Add a transform; `engine` is `static` or `bullet`."""
        pose = {"tx": tx, "ty": ty, "tz": tz, "rx": rx, "ry": ry, "rz": rz}
        return self._new("transform", id, parent, engine=engine, mass=mass, **pose)

    def newJoint(
        self,
        id: str,
        parent: NodeOrId,
        lx: float = 0,
        ly: float = 0,
        lz: float = 0,
        hx: float = 0,
        hy: float = 0,
        hz: float = 0,
        tx: float = 0,
        ty: float = 0,
        tz: float = 0,
        rx: float = 0,
        ry: float = 0,
        rz: float = 0,
        min: float = -math.inf,
        max: float = math.inf,
        port: int = 0,
        axis: str = "z",
        home: float = 0,
    ) -> InnerModelJoint:
        """Add a hinge; `lx` … `hz` are stored only."""
        pose = {"tx": tx, "ty": ty, "tz": tz, "rx": rx, "ry": ry, "rz": rz}
        ends = {"lx": lx, "ly": ly, "lz": lz, "hx": hx, "hy": hy, "hz": hz}
        limits = {"min": min, "max": max, "home": home, "axis": axis, "port": port}
        self._new("joint", id, parent, **limits, **pose, **ends)
        return self.getJoint(id.strip())

    def newPrismaticJoint(
        self,
        id: str,
        parent: NodeOrId,
        min: float = -math.inf,
        max: float = math.inf,
        value: float = 0,
        offset: float = 0,
        port: int = 0,
        axis: str = "z",
        home: float = 0,
    ) -> InnerModelPrismaticJoint:
        """Add a slide at `value` + `offset`."""
        limits = {"min": min, "max": max, "home": home, "axis": axis, "port": port}
        self._new("prismaticjoint", id, parent, position=value, offset=offset, **limits)
        return self.getPrismaticJoint(id.strip())

    def newDifferentialRobot(
        self,
        id: str,
        parent: NodeOrId,
        tx: float = 0,
        ty: float = 0,
        tz: float = 0,
        rx: float = 0,
        ry: float = 0,
        rz: float = 0,
        port: int = 0,
        noise: float = 0,
        collide: bool = False,
    ) -> Node:
        """Add a differential base."""
        pose = {"tx": tx, "ty": ty, "tz": tz, "rx": rx, "ry": ry, "rz": rz}
        own = {"port": port, "noise": noise, "collide": collide}
        return self._new("differentialrobot", id, parent, **own, **pose)

    def newOmniRobot(
        self,
        id: str,
        parent: NodeOrId,
        tx: float = 0,
        ty: float = 0,
        tz: float = 0,
        rx: float = 0,
        ry: float = 0,
        rz: float = 0,
        port: int = 0,
        noise: float = 0,
        collide: bool = False,
    ) -> Node:
        """Add an omnidirectional base."""
        pose = {"tx": tx, "ty": ty, "tz": tz, "rx": rx, "ry": ry, "rz": rz}
        own = {"port": port, "noise": noise, "collide": collide}
        return self._new("omnirobot", id, parent, **own, **pose)

    def newTouchSensor(
        self,
        id: str,
        parent: NodeOrId,
        type: str,
        nx: float = 0,
        ny: float = 0,
        nz: float = 0,
        min: float = 0,
        max: float = math.inf,
        port: int = 0,
    ) -> Node:
        """Add a touch sensor with its normal."""
        own = {"type": type, "min": min, "max": max, "port": port}
        return self._new("touchsensor", id, parent, nx=nx, ny=ny, nz=nz, **own)

    def newCamera(self, id: str, parent: NodeOrId, width: int, height: int, focal: float) -> Node:
        """Add a camera; all three are pixels."""
        return self._new("camera", id, parent, width=width, height=height, focal=focal)

    def newRGBD(
        self,
        id: str,
        parent: NodeOrId,
        width: int,
        height: int,
        focal: float,
        noise: float,
        port: int = 0,
        ifconfig: str = "",
    ) -> Node:
        """Add a camera with depth."""
        picture = {"width": width, "height": height, "focal": focal, "noise": noise}
        return self._new("rgbd", id, parent, port=port, ifconfig=ifconfig, **picture)

    def newIMU(self, id: str, parent: NodeOrId, port: int = 0) -> Node:
        """Add an inertial measurement unit."""
        return self._new("imu", id, parent, port=port)

    def newLaser(
        self,
        id: str,
        parent: NodeOrId,
        port: int = 0,
        min: int = 0,
        max: int = 30000,
        angle: float = math.pi,
        measures: int = 360,
        ifconfig: str = "",
    ) -> Node:
        """Add a laser that sees from `min` to `max` mm in `angle` rad."""
        own = {"port": port, "min": min, "max": max, "measures": measures, "ifconfig": ifconfig}
        return self._new("laser", id, parent, angle=angle, **own)

    def newPlane(
        self,
        id: str,
        parent: NodeOrId,
        texture: str,
        width: float,
        height: float,
        depth: float,
        repeat: int,
        nx: float = 0,
        ny: float = 0,
        nz: float = 0,
        px: float = 0,
        py: float = 0,
        pz: float = 0,
        collidable: bool = False,
    ) -> Node:
        """Add a box with its centre and normal; without a normal it is (0, 0, -1)."""
        normal = {"nx": nx, "ny": ny, "nz": nz, "px": px, "py": py, "pz": pz}
        own = {"size": (width, height, depth), "repeat": repeat, "collide": collidable}
        return self._new("plane", id, parent, texture=texture, **own, **normal)

    def newDisplay(
        self,
        id: str,
        port: int,
        parent: NodeOrId,
        texture: str,
        width: float,
        height: float,
        depth: float,
        repeat: int,
        nx: float = 0,
        ny: float = 0,
        nz: float = 0,
        px: float = 0,
        py: float = 0,
        pz: float = 0,
        collidable: bool = False,
    ) -> Node:
        """Add a plane that shows pictures."""
        normal = {"nx": nx, "ny": ny, "nz": nz, "px": px, "py": py, "pz": pz}
        own = {"size": (width, height, depth), "repeat": repeat, "collide": collidable}
        return self._new("display", id, parent, texture=texture, port=port, **own, **normal)

    def newMesh(
        self,
        id: str,
        parent: NodeOrId,
        path: str,
        scale: float | Sequence[float] = 1,
        render: int | str = 0,
        tx: float = 0,
        ty: float = 0,
        tz: float = 0,
        rx: float = 0,
        ry: float = 0,
        rz: float = 0,
        collidable: bool = False,
    ) -> Node:
        """Add a mesh; `scale` is a factor or three, `render` 0 (normal) or 1 (wireframe)."""
        pose = {"tx": tx, "ty": ty, "tz": tz, "rx": rx, "ry": ry, "rz": rz}
        factors = (scale,) * 3 if isinstance(scale, (int, float)) else scale
        mode = _RENDER.get(render, render) if isinstance(render, int) else render
        own = {"file": path, "scale": factors, "render": mode, "collide": collidable}
        return self._new("mesh", id, parent, **own, **pose)

    def newPointCloud(self, id: str, parent: NodeOrId) -> Node:
        """Add a point cloud."""
        return self._new("pointcloud", id, parent)

    @locked
    def _new(self, tag: str, id: str, parent: NodeOrId, **attributes: Any) -> Node:
        """Add a node of `tag` and return it."""
        known = TAGS[tag].attributes
        values: dict[str, Any] = {
            name: checked_value(name, v, known[name]) for name, v in attributes.items()
        }
        name = checked_text("id", id) if isinstance(id, str) else ""
        if not name:
            raise InnerModelError(f"the id of a node is a non-empty string, not {id!r:.80}")
        holder = id_of(parent)
        node = TAGS[tag].node_class(id=name, tag=tag, span=_NO_FILE, **values)
        if messages := violations(node, self._tree.entry(holder).node):
            raise InnerModelError(f"`{id}`: {messages[0]}")
        self._tree.add(node, holder)
        return node
