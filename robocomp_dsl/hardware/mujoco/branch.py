"""A world and its devices as one state: what a snapshot keeps and a fork goes on from.

In: a branch. Out: a copy of it, from the physics to the noise still to come, that shares nothing
with it but what `shared` lists.
"""

from __future__ import annotations

from collections.abc import Iterable
from copy import deepcopy
from dataclasses import dataclass, field
from typing import Any

import mujoco

from robocomp_dsl.hardware.errors import FrameError
from robocomp_dsl.hardware.mujoco import axes
from robocomp_dsl.hardware.mujoco.mirror import Mirror, mirror
from robocomp_dsl.hardware.mujoco.scene_spec import body_name
from robocomp_dsl.hardware.mujoco.world import World
from robocomp_dsl.hardware.rotations import Matrix
from robocomp_dsl.hardware.scene import Scene


@dataclass(slots=True)
class Branch:
    """`devices` by their ids are parts of `world`, which was built from `scene`."""

    scene: Scene
    world: World
    devices: dict[str, Any]
    _mirror: Mirror | None = field(default=None, repr=False)
    _bodies: dict[str, int] = field(default_factory=dict, repr=False)

    def copy(self, shared: Iterable[object] = ()) -> Branch:
        """Another world that would go on in the same way."""
        model = deepcopy(self.world.model)
        data = mujoco.MjData(model)
        mujoco.mj_copyData(data, model, self.world.data)
        known: dict[int, Any] = {id(one): one for one in (self.scene, *shared)}
        known |= {id(self.world.model): model, id(self.world.data): data}
        world, devices = deepcopy((self.world, self.devices), known)
        return Branch(self.scene, world, devices)

    def matrix(self, frame: str) -> Matrix:
        """What takes points of `frame` to the root, shape (4, 4), mm. Raises `FrameError`."""
        mirrored = self._mirrored()
        if mirrored is None or frame in self._bodies or frame not in mirrored.tree:
            return self._place(self.body(frame))
        # a joint or a mark: its place in the body that holds it, which a mocap body may carry
        holder = next(one for one in mirrored.tree.path(frame) if one in self._bodies)
        mirrored.follow(self.world.data.qpos)
        seen: Matrix = self._place(self.body(holder)) @ mirrored.tree.matrix(frame, holder)
        return seen

    def body(self, frame: str) -> int:
        """The body of a frame. Raises `FrameError`."""
        self._mirrored()
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
        joints = [one for one in self.scene.devices if one.kind.endswith("joint")]
        given = {one.settings.get("joint", one.id) for one in joints}
        known = given | {one.id for one in self.scene.frames if one.motion}
        if frame not in known:
            raise FrameError(f"there is no joint `{frame}`")
        joint = model.joint(frame)
        value = float(self.world.data.qpos[joint.qposadr[0]])
        return value / axes.MM if joint.type[0] == mujoco.mjtJoint.mjJNT_SLIDE else value

    def _mirrored(self) -> Mirror | None:
        """The frames of a model file and of what was added to it."""
        if self._mirror is None and self.scene.model is not None:
            self._mirror = mirror(self.world.model)
            self._bodies = {name: i for i, name in enumerate(self._mirror.bodies)}
        return self._mirror

    def _place(self, body: int) -> Matrix:
        data = self.world.data
        return axes.matrix(data.xpos[body], data.xmat[body])

    def set_physics(self, on: bool) -> None:
        """Gravity and contacts, or neither."""
        off = mujoco.mjtDisableBit.mjDSBL_GRAVITY | mujoco.mjtDisableBit.mjDSBL_CONTACT
        flags = self.world.model.opt.disableflags
        self.world.model.opt.disableflags = flags & ~off if on else flags | off
