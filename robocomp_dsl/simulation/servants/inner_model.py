"""`InnerModelManager` over a running world: read and change its nodes.

A new joint is on the `JointMotor` and `ControlBoard` of the world, whatever its `port`. Attributes
and point clouds are stored here; they have no physics.
"""

# ruff: noqa: N802, N803  called as in the interface

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from robocomp_dsl.hardware.description.scene import Axis, Box, Frame, Mesh, Motion, Scene
from robocomp_dsl.hardware.description.scene_edit import (
    NodeError,
    NodeErrorCode,
    add_box,
    add_frame,
    add_mesh,
    box_of,
    frame_of,
    parents,
    remove_node,
    replace_box,
    rescale_node,
)
from robocomp_dsl.hardware.description.world_files import FileSearch
from robocomp_dsl.hardware.devices.errors import (
    CommandRefused,
    FrameError,
    HardwareError,
    SceneError,
    require_finite,
)
from robocomp_dsl.hardware.formats.mesh_file import read_mesh
from robocomp_dsl.hardware.formats.surface import MeshError
from robocomp_dsl.hardware.servants.servant import Servant
from robocomp_dsl.simulation.world import nodes

_TYPES = {
    "differentialrobot": "DifferentialRobot",
    "omnirobot": "OmniRobot",
    "joint": "Joint",
    "prismaticjoint": "Joint",
    "passivejoint": "Joint",
    "followingjoint": "Joint",
    "touchsensor": "TouchSensor",
    "camera": "Camera",
    "rgbd": "RGBD",
    "imu": "IMU",
    "laser": "Laser",
    "pointcloud": "PointCloud",
    "display": "DisplayII",
    "model_camera": "Camera",
    "model_rgbd": "RGBD",
    "model_imu": "IMU",
    "model_touch": "TouchSensor",
}
_AXES: dict[str, Axis] = {"x": "x", "y": "y", "z": "z"}
_FALLING = 1.0
"""Default mass in kg of a new transform with physics: the interface has no field for it."""


class InnerModelServant(Servant):
    """The device is the simulation."""

    FAILURES: ClassVar[tuple[tuple[type[HardwareError], str], ...]] = (
        (HardwareError, "InnerModelManagerError"),
    )

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self._attributes: dict[str, dict[str, tuple[str, str]]] = {}
        self.clouds: dict[str, Any] = {}

    def declared_error(self, declared: type[Any], error: HardwareError) -> Exception:
        """The declared exception, with its error code."""
        name = "InternalError"
        if isinstance(error, NodeError):
            name = error.code.value
        elif isinstance(error, FrameError):
            name = NodeErrorCode.MISSING.value
        elif isinstance(error, CommandRefused | SceneError):
            name = NodeErrorCode.VALUES.value
        exception: Exception = declared(err=self.types.ErrorType[name], text=str(error))
        return exception

    @property
    def _scene(self) -> Scene:
        found: Scene = self.device().state.scene
        return found

    # -- add ----------------------------------------------------------------------------------

    def addTransform(self, item: str, engine: str, base: str, pose: Any) -> bool:
        """Add a frame; with the engine `bullet` it falls, unless a frame above it moves."""
        if engine not in {"", "static", "bullet"}:
            message = f"there is no engine `{engine}`: static or bullet"
            raise NodeError(NodeErrorCode.ENGINE, message)
        physics = engine == "bullet"
        place, turn = _pose(pose)
        frame = Frame(item, base, place, turn, physics=physics, mass=_FALLING if physics else 0.0)
        return self._rebuild(add_frame(self._scene, frame))

    def addJoint(self, item: str, base: str, j: Any) -> bool:
        """Add a hinge."""
        axis = _AXES.get(j.axis or "z")
        if axis is None:
            raise NodeError(NodeErrorCode.VALUES, f"there is no axis `{j.axis}`: x, y or z")
        if math.isnan(j.min) or math.isnan(j.max):
            raise NodeError(NodeErrorCode.VALUES, "a limit is no number")
        require_finite(mass=j.mass)
        place, turn = _pose(j.pose)
        motion = Motion("hinge", axis, j.min, j.max, home=turn["xyz".index(axis)])
        frame = Frame(item, base, place, turn, motion, mass=max(j.mass, 0.0))
        return self._rebuild(add_frame(self._scene, frame))

    def addMesh(self, item: str, base: str, m: Any) -> bool:
        """Add a mesh from a readable file, which is also searched in ROBOCOMP_FILES."""
        scale = _scale(m.scaleX, m.scaleY, m.scaleZ)
        place, turn = _pose(m.pose)
        file = FileSearch(Path()).find(Path(m.meshPath))
        scene = add_mesh(self._scene, Mesh(item, base, str(file), place, turn, scale))
        try:
            read_mesh(file)
        except MeshError as error:
            raise NodeError(NodeErrorCode.PATH, f"`{m.meshPath}`: {error}") from None
        return self._rebuild(scene)

    def addPlane(self, item: str, base: str, plane: Any) -> bool:
        """Add a box that collides."""
        return self._rebuild(add_box(self._scene, _box(Box(item, base, (1, 1, 1)), plane)))

    # -- read ---------------------------------------------------------------------------------

    def getAllNodeInformation(self) -> list[Any]:
        """All nodes, depth first."""
        scene = self._scene
        kinds = {box.id: "Plane" for box in scene.boxes}
        kinds |= {mesh.id: "Mesh" for mesh in scene.meshes}
        kinds |= {frame.id: "Joint" for frame in scene.frames if frame.motion}
        kinds |= {  # a joint of a model file may share the name of a node, but not its frame
            device.frame if device.kind.endswith("joint") else device.id: _TYPES[device.kind]
            for device in scene.devices
            if device.kind in _TYPES
        }
        return [
            self.types.NodeInformation(
                id=node,
                parentId=parent,
                nType=self.types.NodeType[kinds.get(node, "Transform")],
                attributes={
                    name: self.types.AttributeType(*value)
                    for name, value in self._attributes.get(node, {}).items()
                },
            )
            for node, parent in parents(scene).items()
        ]

    def getPose(self, base: str, item: str) -> tuple[bool, Any]:
        """The pose of a frame in another one."""
        matrix = nodes.between(self.device().state, base, item)
        return True, self.types.Pose3D(*nodes.pose_of(matrix))

    def getPoseFromParent(self, item: str) -> tuple[bool, Any]:
        """The pose of a frame in its parent; that of the root is the identity."""
        return self.getPose(frame_of(self._scene, item).parent or item, item)

    def transform(self, base: str, item: str, coordInItem: Any) -> tuple[bool, Any]:
        """A point of `item`, expressed in `base`."""
        require_finite(x=coordInItem.x, y=coordInItem.y, z=coordInItem.z)
        matrix = nodes.between(self.device().state, base, item)
        point = matrix[:3, :3] @ (coordInItem.x, coordInItem.y, coordInItem.z) + matrix[:3, 3]
        return True, self.types.coord3D(*map(float, point))

    def getTransformationMatrix(self, base: str, item: str) -> Any:
        """The transform from `item` to `base`, as the interface declares it."""
        matrix = nodes.between(self.device().state, base, item)
        return self.types.Matrix(cols=4, rows=4, data=matrix.ravel().astype(np.float32))

    def collide(self, a: str, b: str) -> bool:
        """Whether two subtrees touch."""
        found: bool = nodes.touching(self.device().state, a, b)
        return found

    # -- change -------------------------------------------------------------------------------

    def setPose(self, base: str, item: str, pose: Any) -> bool:
        """Set the pose of a frame in `base`."""
        place, turn = _pose(pose)
        nodes.place(self.device(), base, item, (*place, *turn))
        return True

    def setPoseFromParent(self, item: str, pose: Any) -> bool:
        """Set the pose of a frame in its parent."""
        return self.setPose(frame_of(self._scene, item).parent or item, item, pose)

    def setPlane(self, item: str, plane: Any) -> bool:
        """Change a box."""
        return self._rebuild(replace_box(self._scene, _box(box_of(self._scene, item), plane)))

    def setScale(self, item: str, scaleX: float, scaleY: float, scaleZ: float) -> bool:
        """Change the scale of a mesh."""
        return self._rebuild(rescale_node(self._scene, item, _scale(scaleX, scaleY, scaleZ)))

    def removeNode(self, item: str) -> bool:
        """Remove a node and its subtree."""
        self._rebuild(remove_node(self._scene, item))
        left = parents(self._scene)
        for store in (self._attributes, self.clouds):
            for gone in [removed for removed in store if removed not in left]:
                del store[gone]
        return True

    def moveNode(self, src: str, dst: str) -> bool:
        """Move a node to another parent."""
        nodes.move(self.device(), src, dst)
        return True

    def setPointCloudData(self, id: str, cloud: Any) -> None:
        """Replace the points of a cloud."""
        self.clouds[id] = cloud.copy()

    # -- attributes ---------------------------------------------------------------------------

    def addAttribute(self, idNode: str, name: str, type: str, value: str) -> bool:
        """Add an attribute."""
        known = self._attributes_of(idNode)
        if name in known:
            raise NodeError(NodeErrorCode.ATTRIBUTE_EXISTS, f"`{idNode}` has an attribute `{name}`")
        known[name] = (type, value)
        return True

    def removeAttribute(self, idNode: str, name: str) -> bool:
        """Remove an attribute."""
        del self._attributes_of(idNode)[self._attribute(idNode, name)]
        return True

    def setAttribute(self, idNode: str, name: str, type: str, value: str) -> bool:
        """Change an attribute."""
        self._attributes_of(idNode)[self._attribute(idNode, name)] = (type, value)
        return True

    def getAttribute(self, idNode: str, name: str) -> tuple[bool, str, str]:
        """Type and value of an attribute."""
        return (True, *self._attributes_of(idNode)[self._attribute(idNode, name)])

    def _attributes_of(self, id: str) -> dict[str, tuple[str, str]]:
        if id not in parents(self._scene):
            raise NodeError(NodeErrorCode.MISSING, f"there is no node `{id}`")
        return self._attributes.setdefault(id, {})

    def _attribute(self, id: str, name: str) -> str:
        if name not in self._attributes_of(id):
            raise NodeError(NodeErrorCode.NO_ATTRIBUTE, f"`{id}` has no attribute `{name}`")
        return name

    def _rebuild(self, scene: Scene) -> bool:
        self.device().rebuild(scene)
        return True


def _pose(pose: Any) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    """Position and rotation of a `Pose3D`. Raises `CommandRefused`."""
    require_finite(x=pose.x, y=pose.y, z=pose.z, rx=pose.rx, ry=pose.ry, rz=pose.rz)
    return (pose.x, pose.y, pose.z), (pose.rx, pose.ry, pose.rz)


def _scale(x: float, y: float, z: float) -> tuple[float, float, float]:
    """Raises `NodeError` for a negative value."""
    require_finite(scaleX=x, scaleY=y, scaleZ=z)
    if min(x, y, z) < 0:
        raise NodeError(NodeErrorCode.VALUES, "a scale cannot be negative")
    return x, y, z


def _box(box: Box, plane: Any) -> Box:
    """The box with the values of a `Plane3D`."""
    require_finite(px=plane.px, py=plane.py, pz=plane.pz, nx=plane.nx, ny=plane.ny, nz=plane.nz)
    require_finite(width=plane.width, height=plane.height, thickness=plane.thickness)
    normal = (plane.nx, plane.ny, plane.nz)
    return replace(
        box,
        size=(plane.width, plane.height, plane.thickness),
        place=(plane.px, plane.py, plane.pz),
        normal=normal if any(normal) else (0.0, 0.0, -1.0),
        colour=plane.texture if plane.texture.startswith("#") else "",
        collide=True,
    )
