"""The complete state of a simulation, for snapshots and forks.

In: a state. Out: an independent copy, including the physics and the random generators; only the
objects in `shared` are shared.
"""

from __future__ import annotations

from collections.abc import Iterable
from copy import deepcopy
from dataclasses import dataclass, field
from typing import Any

import mujoco

from robocomp_dsl.hardware.description.scene import Scene
from robocomp_dsl.hardware.devices.errors import FrameError
from robocomp_dsl.hardware.kinematics.rotations import Matrix
from robocomp_dsl.simulation.models.model_to_transforms import ModelTransforms, model_transforms
from robocomp_dsl.simulation.scene import axes
from robocomp_dsl.simulation.scene.scene_spec import body_name
from robocomp_dsl.simulation.world.world import World


@dataclass(slots=True)
class SimulationState:
    """`devices` by id are parts of `world`, which was built from `scene`."""

    scene: Scene
    world: World
    devices: dict[str, Any]
    _transforms: ModelTransforms | None = field(default=None, repr=False)
    _bodies: dict[str, int] = field(default_factory=dict, repr=False)

    def fork(self, shared: Iterable[object] = ()) -> SimulationState:
        """An independent copy that continues identically."""
        model = deepcopy(self.world.model)
        data = mujoco.MjData(model)
        mujoco.mj_copyData(data, model, self.world.data)
        known: dict[int, Any] = {
            id(shared_object): shared_object for shared_object in (self.scene, *shared)
        }
        known |= {id(self.world.model): model, id(self.world.data): data}
        world, devices = deepcopy((self.world, self.devices), known)
        return SimulationState(self.scene, world, devices)

    def matrix(self, frame: str) -> Matrix:
        """The transform from `frame` to the root, shape (4, 4), mm. Raises `FrameError`."""
        mirrored = self._model_transforms()
        if mirrored is None or frame in self._bodies or frame not in mirrored.tree:
            return self._pose(self.body(frame))
        # a joint or a mark: its pose in the body above, which a mocap body may carry
        holder = next(above for above in mirrored.tree.path(frame) if above in self._bodies)
        mirrored.follow(self.world.data.qpos)
        seen: Matrix = self._pose(self.body(holder)) @ mirrored.tree.matrix(frame, holder)
        return seen

    def body(self, frame: str) -> int:
        """The body of a frame. Raises `FrameError`."""
        self._model_transforms()
        if frame in self._bodies:
            return self._bodies[frame]
        name = body_name(frame)
        found = mujoco.mj_name2id(self.world.model, mujoco.mjtObj.mjOBJ_BODY, name)
        if found < 0:
            raise FrameError(f"there is no frame `{frame}`")
        return int(found)

    def joint(self, frame: str) -> float:
        """The value of a joint in rad or mm. Raises `FrameError`."""
        model = self.world.model
        joints = [node for node in self.scene.devices if node.kind.endswith("joint")]
        served = {node.settings.get("joint", node.id) for node in joints}
        known = served | {node.id for node in self.scene.frames if node.motion}
        if frame not in known:
            raise FrameError(f"there is no joint `{frame}`")
        joint = model.joint(frame)
        value = float(self.world.data.qpos[joint.qposadr[0]])
        return value / axes.MM if joint.type[0] == mujoco.mjtJoint.mjJNT_SLIDE else value

    def _model_transforms(self) -> ModelTransforms | None:
        """The frames of the model file and of added nodes."""
        if self._transforms is None and self.scene.model is not None:
            self._transforms = model_transforms(self.world.model)
            self._bodies = {name: i for i, name in enumerate(self._transforms.bodies)}
        return self._transforms

    def _pose(self, body: int) -> Matrix:
        data = self.world.data
        return axes.matrix(data.xpos[body], data.xmat[body])

    def set_physics(self, on: bool) -> None:
        """Enable or disable gravity and contacts."""
        off = mujoco.mjtDisableBit.mjDSBL_GRAVITY | mujoco.mjtDisableBit.mjDSBL_CONTACT
        flags = self.world.model.opt.disableflags
        self.world.model.opt.disableflags = flags & ~off if on else flags | off
