"""A simulated base of a scene: it slides on the floor and turns, driven by three velocity motors.

In: commands of the Protocol. Out: states. The odometry integrates the motion in the base frame with
a relative error that is drawn once (`drift`) and a random walk (`noise`, mm after one metre); the
corrected pose is the true one unless `correct` has changed it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.hardware.devices.errors import require_finite
from robocomp_dsl.hardware.devices.full_pose import FullPose
from robocomp_dsl.hardware.devices.mobile_base import BaseLimits, MobileBaseState, check_speed
from robocomp_dsl.hardware.kinematics.planar import ORIGIN, Pose, wrap_angle
from robocomp_dsl.hardware.kinematics.rotations import Matrix
from robocomp_dsl.simulation.devices.true_pose import TruePose
from robocomp_dsl.simulation.scene import axes
from robocomp_dsl.simulation.scene.axes import MM
from robocomp_dsl.simulation.world.noise import NoiseLevel

_INERTIA = (20.0, 20.0, 2.0)  # kg, kg, kg·m²: the base without its load
_GAIN = (1000.0, 1000.0, 100.0)  # N per m/s: 20 ms to a new speed
_STALL = (400.0, 400.0, 100.0)  # N, N, N·m
_ACCELERATION = (2.0, 2.0, 6.0)  # m/s², m/s², rad/s²
_STILL = (1e-3, 1e-3, 1e-3)  # m/s, m/s, rad/s: slower counts as standing
_DRIFT = 0.004


class MobileBase:
    """The device on the body `at`, whose joints are x, z and alpha, in this order."""

    def __init__(
        self,
        limits: BaseLimits,
        level: NoiseLevel,
        at: str,
        *,
        name: str,
        noise: float = 0.0,
        drift: float = _DRIFT,
    ) -> None:
        self._limits = limits
        self._level = level
        self._at = at
        self.name = name
        self._noise = noise
        self._drift = drift
        self._odometry = ORIGIN
        self._correction = ORIGIN
        self._goal = [0.0, 0.0, 0.0]  # side, ahead, turn in m/s and rad/s, in the frame of the base
        self._speed = [0.0, 0.0, 0.0]
        self._truth = TruePose()

    # -- as a part of the world ---------------------------------------------------------------

    def build(self, spec: Any) -> None:
        """Add motors and inertia to the joints of the scene."""
        for i, joint in enumerate(spec.body(self._at).joints):
            joint.armature = _INERTIA[i]
            motor = spec.add_actuator(
                name=joint.name,
                target=joint.name,
                trntype=mujoco.mjtTrn.mjTRN_JOINT,
                forcelimited=True,
            )
            motor.gainprm[0] = _GAIN[i]
            motor.biastype = mujoco.mjtBias.mjBIAS_AFFINE
            motor.biasprm[2] = -_GAIN[i]
            motor.forcerange = [-_STALL[i], _STALL[i]]

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:
        """Start at rest, and draw the odometry errors."""
        self._random = random
        self._errors = random.standard_normal(3).tolist()
        self.find(model, data)
        self._last = self._now()

    def find(self, model: Any, data: Any) -> None:
        """The same joints in another model."""
        body = model.body(self._at)
        joints = [model.joint(int(body.jntadr[0]) + i) for i in range(int(body.jntnum[0]))]
        self._where = [int(joint.qposadr[0]) for joint in joints]
        self._rates = [int(joint.dofadr[0]) for joint in joints]
        self._motors = [int(model.actuator(joint.name).id) for joint in joints]
        self._body = int(body.id)
        self._data = data
        self._truth.find(model, data, self._body)

    def update_frame(self, frame: str) -> None:  # noqa: ARG002 - it has one frame
        """The base was moved externally, which the wheels do not measure."""
        self._last = self._now()

    def before_step(self, dt: float) -> None:
        """Ramp the motors to the commanded speeds."""
        speed = self._speed
        for i, goal in enumerate(self._goal):  # scalars are faster than arrays of three
            most = _ACCELERATION[i] * dt
            speed[i] += min(max(goal - speed[i], -most), most)
        side, ahead, turn = speed
        alpha = float(self._data.qpos[self._where[2]])
        sine, cosine = math.sin(alpha), math.cos(alpha)
        control, (x, z, about) = self._data.ctrl, self._motors
        control[x] = side * cosine + ahead * sine
        control[z] = ahead * cosine - side * sine
        control[about] = turn

    def after_step(self, dt: float) -> None:  # noqa: ARG002  the Protocol's, not needed here
        """Integrate the odometry."""
        now, before = self._now(), self._last
        if now == before:
            return
        self._last = now
        x, z, turn = now[0] - before[0], now[1] - before[1], now[2] - before[2]
        alpha = before[2] + turn / 2  # at the middle of the step
        sine, cosine = math.sin(alpha), math.cos(alpha)
        side, ahead, turn = self._state(x * cosine - z * sine, x * sine + z * cosine, turn)
        known = self._odometry
        alpha = known.alpha + turn / 2
        sine, cosine = math.sin(alpha), math.cos(alpha)
        self._odometry = Pose(
            known.x + (side * cosine + ahead * sine) / MM,
            known.z + (ahead * cosine - side * sine) / MM,
            wrap_angle(known.alpha + turn),
        )

    def _state(self, *moved: float) -> Iterator[float]:
        """The odometry of a motion (m, m, rad): with errors and noise."""
        drift = self._drift * self._level.factor
        spread = self._noise * MM * self._level.factor
        noise = self._random.standard_normal(3).tolist() if spread else (0.0, 0.0, 0.0)
        for way, error, random in zip(moved, self._errors, noise, strict=True):
            way *= 1 + drift * error  # noqa: PLW2901
            yield way + spread * math.sqrt(abs(way)) * random

    def _now(self) -> tuple[float, float, float]:
        """x, z and alpha of the joints in m and rad."""
        place, (x, z, about) = self._data.qpos, self._where
        return float(place[x]), float(place[z]), float(place[about])

    # -- as a device --------------------------------------------------------------------------

    @property
    def limits(self) -> BaseLimits:
        """The speed limits."""
        return self._limits

    def true_pose(self) -> Pose:
        """Its true pose in the world."""
        return axes.pose(self._data.xpos[self._body], self._data.xmat[self._body])

    def full_pose(self) -> FullPose:
        """Its true pose and motion."""
        return self._truth.measure()

    def set_full_pose(self, matrix: Matrix) -> None:
        """Set the full pose to `matrix`, shape (4, 4), in mm."""
        self._truth.set(matrix)

    def state(self) -> MobileBaseState:
        """The state after the latest step."""
        x, z, turn = (float(rate) for rate in self._data.qvel[self._rates])
        alpha = float(self._data.qpos[self._where[2]])
        sine, cosine = math.sin(alpha), math.cos(alpha)
        return MobileBaseState(
            time=float(self._data.time),
            odometry=self._odometry,
            corrected=self._correction.then(self.true_pose()),
            side=(x * cosine - z * sine) / MM,
            adv=(x * sine + z * cosine) / MM,
            rot=turn,
            moving=any(abs(v) > still for v, still in zip((x, z, turn), _STILL, strict=True)),
        )

    def set_speed(self, side: float, adv: float, rot: float) -> None:
        """Drive in mm/s while turning at rad/s. Raises `CommandRefused`."""
        check_speed(self._limits, side, adv, rot)
        self._goal[:] = side * MM, adv * MM, rot

    def stop(self) -> None:
        """Stop as fast as possible."""
        self._goal[:] = self._speed[:] = 0.0, 0.0, 0.0

    def set_odometry(self, pose: Pose) -> None:
        """Set the odometry to `pose`. Raises `CommandRefused`."""
        require_finite(x=pose.x, z=pose.z, alpha=pose.alpha)
        self._odometry = Pose(pose.x, pose.z, wrap_angle(pose.alpha))

    def correct(self, pose: Pose) -> None:
        """Set the corrected pose to `pose`. Raises `CommandRefused`."""
        require_finite(x=pose.x, z=pose.z, alpha=pose.alpha)
        self._correction = pose.then(self.true_pose().inverse())
