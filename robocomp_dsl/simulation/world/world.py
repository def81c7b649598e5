"""A simulated world: physics, time and the devices in it.

In: a scene as `MjSpec`, and devices that add their bodies to it. Out: `advance(seconds)`, after
which the devices have new states. The same scene, devices, seed and commands give bit-identical
numbers.
"""

from __future__ import annotations

import warnings
from collections.abc import Collection, Iterable
from typing import Any, Protocol

import mujoco
import numpy as np

from robocomp_dsl.hardware.description.scene import Model
from robocomp_dsl.hardware.devices.errors import Diverged, SceneError

_SENSORS = int(mujoco.mjtDisableBit.mjDSBL_SENSOR)
_BAD = tuple(
    (int(kind), kind.name)
    for kind in (
        mujoco.mjtWarning.mjWARN_BADQPOS,
        mujoco.mjtWarning.mjWARN_BADQVEL,
        mujoco.mjtWarning.mjWARN_BADQACC,
    )
)


class WorldPart(Protocol):
    """A device in a world: first `build`, then `bind`.

    A device that acts at every step has `before_step(dt)`, which drives its motors for the next
    `dt` seconds, or `after_step(dt)`, which reads its sensors after these.
    """

    def build(self, spec: Any) -> None:
        """Add bodies, joints and motors to `spec` (an `MjSpec`)."""

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:
        """Find its elements in the compiled `MjModel` and `MjData`, at rest at time 0."""


class World:
    """Bodies under physics. Not thread-safe: one thread, or one lock, drives it.

    `step` is the physics time step in s.

    `start` sets the initial state. A world that replaces another one (`before`) continues its time
    and the state of all joints in bodies of the same name except those in `forget`; devices of both
    worlds are rebound by `find`.
    """

    def __init__(
        self,
        spec: Any,
        parts: Iterable[WorldPart] = (),
        *,
        seed: int = 0,
        before: World | None = None,
        forget: Collection[str] = (),
        start: Model | None = None,
    ) -> None:
        self._parts = tuple(parts)
        for part in self._parts:
            part.build(spec)
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # reported when the model file was read
                self.model = spec.compile()
        except ValueError as error:
            raise SceneError(f"MuJoCo cannot build the world: {error}") from None
        self.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
        self.data = mujoco.MjData(self.model)
        self.step = float(self.model.opt.timestep)
        self._pending = 0.0
        if start is not None:
            self._set_start(start)
        previous: tuple[Any, ...] = ()
        if before is not None:
            previous = before._parts
            self._take_over(before, forget)
        mujoco.mj_forward(self.model, self.data)
        for i, part in enumerate(self._parts):
            if part in previous:
                previous[previous.index(part)].find(self.model, self.data)
                continue
            # separate random generators, so that devices do not affect each other's noise
            part.bind(self.model, self.data, np.random.default_rng([seed, i]))

    @property
    def time(self) -> float:
        """Simulated time in s."""
        return float(self.data.time)

    @property
    def advanced_to(self) -> float:
        """The time to which it was advanced [s]: `time` plus a remainder below one step."""
        return self.time + self._pending

    def advance(self, seconds: float) -> None:
        """Advance by `seconds`; a remainder below one step is kept for the next call.

        Raises `Diverged` if the state contains a number that is not finite.
        """
        self._pending += seconds
        dt = self.step
        steps = int(self._pending / dt + 1e-9)
        self._pending -= steps * dt
        try:
            self._steps(steps, dt)
        except (ValueError, ArithmeticError):  # devices fail on numbers that are not finite
            self._check()
            raise
        self._check()

    def _steps(self, count: int, dt: float) -> None:
        before = [part.before_step for part in self._parts if hasattr(part, "before_step")]
        after = [part.after_step for part in self._parts if hasattr(part, "after_step")]
        model, data = self.model, self.data
        flags = model.opt.disableflags
        model.opt.disableflags = flags | _SENSORS  # sensors are computed in the last step only
        try:
            for left in range(count, 0, -1):
                for drive in before:
                    drive(dt)
                if left == 1:
                    model.opt.disableflags = flags
                mujoco.mj_step(model, data)
                for read in after:
                    read(dt)
        finally:
            model.opt.disableflags = flags

    def _set_start(self, start: Model) -> None:
        """The initial joints and motors of a model file's first key frame."""
        for joint, places in start.start.items():
            self.data.joint(joint).qpos[:] = places
        for motor, command in start.held.items():
            self.data.actuator(motor).ctrl = command

    def _take_over(self, before: World, forget: Collection[str]) -> None:
        """Copy positions, speeds and forces of joints that are in both worlds."""
        self.data.time, self._pending = before.data.time, before._pending
        self.model.opt.disableflags = before.model.opt.disableflags
        old, new = before.model, self.model
        for joint in range(old.njnt):
            at = _same_joint(old, joint, new)
            if at < 0 or old.joint(joint).name in forget:
                continue
            there, here = old.joint(joint), new.joint(at)
            before_joint, this_joint = before.data.joint(there.id), self.data.joint(here.id)
            this_joint.qpos[:] = before_joint.qpos
            this_joint.qvel[:] = before_joint.qvel
            this_joint.qacc_warmstart[:] = before_joint.qacc_warmstart
        for body in np.flatnonzero(old.body_mocapid >= 0):
            at = mujoco.mj_name2id(new, mujoco.mjtObj.mjOBJ_BODY, old.body(body).name)
            there, here = old.body_mocapid[body], new.body_mocapid[at]
            self.data.mocap_pos[here] = before.data.mocap_pos[there]
            self.data.mocap_quat[here] = before.data.mocap_quat[there]

    def _check(self) -> None:
        numbers = self.data.warning.number
        for kind, name in _BAD:
            if numbers[kind]:
                raise Diverged(f"the simulation diverged before {self.time:.3f} s ({name})")


def _same_joint(old: Any, joint: int, new: Any) -> int:
    """The joint of the model `new` at the same place in its body, or -1.

    Its name may differ: that of a base's joint yields to the name of an added node.
    """
    body = old.jnt_bodyid[joint]
    at = mujoco.mj_name2id(new, mujoco.mjtObj.mjOBJ_BODY, old.body(body).name)
    order = joint - old.body_jntadr[body]
    if at < 0 or order >= new.body_jntnum[at]:
        return -1
    found = int(new.body_jntadr[at] + order)
    return found if new.jnt_type[found] == old.jnt_type[joint] else -1
