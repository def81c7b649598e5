"""A world and its devices as one state: what a snapshot keeps and a fork goes on from.

In: a branch. Out: a copy of it, from the physics to the noise still to come, that shares nothing
with it but what `shared` lists.
"""

from __future__ import annotations

from collections.abc import Iterable
from copy import deepcopy
from dataclasses import dataclass
from typing import Any

import mujoco

from robocomp_dsl.hardware.errors import FrameError
from robocomp_dsl.hardware.mujoco import axes
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
        body = self.body(frame)
        data = self.world.data
        return axes.matrix(data.xpos[body], data.xmat[body])

    def body(self, frame: str) -> int:
        """The body of a frame. Raises `FrameError`."""
        name = body_name(frame)
        found = mujoco.mj_name2id(self.world.model, mujoco.mjtObj.mjOBJ_BODY, name)
        if found < 0:
            raise FrameError(f"there is no frame `{frame}`")
        return int(found)

    def joint(self, frame: str) -> float:
        """The value of a joint in rad or mm. Raises `FrameError`."""
        motion = next((one.motion for one in self.scene.frames if one.id == frame), None)
        if motion is None:
            raise FrameError(f"there is no joint `{frame}`")
        model = self.world.model
        value = float(self.world.data.qpos[model.joint(frame).qposadr[0]])
        return value / axes.MM if motion.kind == "slide" else value

    def set_physics(self, on: bool) -> None:
        """Gravity and contacts, or neither."""
        off = mujoco.mjtDisableBit.mjDSBL_GRAVITY | mujoco.mjtDisableBit.mjDSBL_CONTACT
        flags = self.world.model.opt.disableflags
        self.world.model.opt.disableflags = flags & ~off if on else flags | off
