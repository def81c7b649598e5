"""A simulated base with two driven wheels: velocity motors, friction, two sliding casters.

In: commands of the Protocol. Out: states; the odometry counts encoder steps, the corrected pose is
the true one unless `correct` has changed it.
"""

from __future__ import annotations

import math
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.devices.differential_robot import (
    BaseState,
    Mechanics,
    check_speed,
    wheel_speeds,
)
from robocomp_dsl.hardware.devices.errors import SceneError, require_finite
from robocomp_dsl.hardware.kinematics.planar import ORIGIN, Pose, arc
from robocomp_dsl.simulation.scene import axes
from robocomp_dsl.simulation.scene.axes import MM

_GAIN = 4.0  # N·m per rad/s of error: follows a ramp within a few steps, without oscillation
_STALL = 6.0  # N·m
_STILL = 1.0  # mm/s at the wheels: slower counts as standing
_CASTER = 30.0  # mm
_CLEARANCE = 60.0  # mm between the floor and the body
_OVERLAP = -0.005  # m: permitted penetration at the start


class DifferentialRobot:
    """The device. `start` is its initial pose; `name` prefixes its parts in the MuJoCo model.

    `drift` is the standard deviation of the relative error of each wheel's radius in the odometry;
    the errors are drawn once, at the start. `watchdog` in s: the base stops this long after the
    last command; 0: never.
    """

    def __init__(
        self,
        mechanics: Mechanics,
        start: Pose = ORIGIN,
        *,
        drift: float = 0.0,
        watchdog: float = 0.0,
        name: str = "base",
    ) -> None:
        self._mechanics = mechanics
        self._start = start
        self._drift = drift
        self._watchdog = watchdog
        self.name = name
        self._odometry = ORIGIN
        self._correction = ORIGIN
        self._goal = np.zeros(2)
        self._target = np.zeros(2)
        self._since_command = 0.0
        self._travelled = np.zeros(2)

    # -- as a part of the world ---------------------------------------------------------------

    def build(self, spec: Any) -> None:
        """Add body, wheels, casters and motors to the world."""
        it = self._mechanics
        body = spec.worldbody.add_body(
            name=self.name,
            pos=axes.point(self._start.x, 0, self._start.z),
            quat=axes.heading(self._start.alpha),
        )
        body.add_freejoint()
        body.add_geom(
            name=f"{self.name}_hull",
            type=mujoco.mjtGeom.mjGEOM_CYLINDER,
            size=[it.body_radius * MM, it.body_height * MM / 2, 0],
            pos=[0, 0, (_CLEARANCE + it.body_height / 2) * MM],
            mass=it.mass_kg,
            friction=[0.2, 0.005, 0.0001],
        )
        for z in (it.body_radius - 2 * _CASTER, 2 * _CASTER - it.body_radius):
            body.add_geom(
                type=mujoco.mjtGeom.mjGEOM_SPHERE,
                size=[_CASTER * MM, 0, 0],
                pos=axes.point(0, _CASTER, z),
                mass=0.2,
                condim=1,
                priority=1,  # otherwise the floor's friction would brake the caster
            )
        for side, x in (("left", -it.axis / 2), ("right", it.axis / 2)):
            self._add_wheel(spec, body, side, x)

    def _add_wheel(self, spec: Any, body: Any, side: str, x: float) -> None:
        radius = self._mechanics.wheel_radius
        joint = f"{self.name}_{side}"
        wheel = body.add_body(name=f"{joint}_wheel", pos=axes.point(x, radius, 0))
        # with the axis to the left, a positive turn rolls ahead
        wheel.add_joint(
            name=joint, type=mujoco.mjtJoint.mjJNT_HINGE, axis=[-1, 0, 0], armature=0.01
        )
        # an ellipsoid touches the floor in one point and does not scrub in turns
        wheel.add_geom(
            type=mujoco.mjtGeom.mjGEOM_ELLIPSOID,
            size=[0.25 * radius * MM, radius * MM, radius * MM],
            mass=0.5,
            friction=[1.0, 0.005, 0.0001],
        )
        motor = spec.add_actuator(
            name=joint, target=joint, trntype=mujoco.mjtTrn.mjTRN_JOINT, forcelimited=True
        )
        motor.gainprm[0] = _GAIN
        motor.biastype = mujoco.mjtBias.mjBIAS_AFFINE
        motor.biasprm[2] = -_GAIN
        motor.forcerange = [-_STALL, _STALL]

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:
        """Find the parts. Raises `SceneError` if the start is inside an obstacle."""
        joints = [model.joint(f"{self.name}_{side}") for side in ("left", "right")]
        motors = [model.actuator(f"{self.name}_{side}").id for side in ("left", "right")]
        self._motors = np.array(motors)
        self._angles = np.array([int(joint.qposadr[0]) for joint in joints])
        self._rates = np.array([int(joint.dofadr[0]) for joint in joints])
        self._body = int(model.body(self.name).id)
        self._data = data
        self._radii = self._mechanics.wheel_radius * (1 + self._drift * random.standard_normal(2))
        self._refuse_overlap(model, data)

    def _refuse_overlap(self, model: Any, data: Any) -> None:
        for contact in data.contact:
            bodies = [int(model.geom_bodyid[geom]) for geom in contact.geom]
            inside = [int(model.body_rootid[body]) == self._body for body in bodies]
            if inside[0] != inside[1] and contact.dist < _OVERLAP:
                other = model.geom(int(contact.geom[0 if inside[1] else 1])).name or "something"
                raise SceneError(
                    f"the robot starts inside `{other}`: "
                    f"x {self._start.x:g} mm, z {self._start.z:g} mm"
                )

    def before_step(self, dt: float) -> None:
        """Ramp the motors' targets to the commanded speeds."""
        self._since_command += dt
        if self._watchdog and self._since_command > self._watchdog:
            self._goal[:] = 0.0
        most = self._mechanics.max_acceleration * dt
        self._target += np.clip(self._goal - self._target, -most, most)
        self._data.ctrl[self._motors] = self._target / self._mechanics.wheel_radius

    def after_step(self, dt: float) -> None:  # noqa: ARG002  the Protocol's, not needed here
        """Read the encoders and integrate the odometry."""
        rolled = self._encoder() * self._radii
        left, right = rolled - self._travelled
        if left or right:
            self._travelled = rolled
            step = arc(float(left), float(right), self._mechanics.axis)
            self._odometry = self._odometry.then(step)

    def _encoder(self) -> NDArray[np.float64]:
        angles = np.asarray(self._data.qpos[self._angles])
        steps = self._mechanics.encoder_steps * self._mechanics.gear_ratio / math.tau
        return np.floor(angles * steps) / steps if steps else angles

    # -- as a device --------------------------------------------------------------------------

    @property
    def mechanics(self) -> Mechanics:
        """The dimensions and limits of the base."""
        return self._mechanics

    def true_pose(self) -> Pose:
        """Its true pose in the room."""
        return axes.pose(self._data.xpos[self._body], self._data.xmat[self._body])

    def state(self) -> BaseState:
        """The state after the latest step."""
        left, right = self._data.qvel[self._rates] * self._mechanics.wheel_radius
        return BaseState(
            time=float(self._data.time),
            odometry=self._odometry,
            corrected=self._correction.then(self.true_pose()),
            adv=float(left + right) / 2,
            rot=float(left - right) / self._mechanics.axis,
            moving=bool(max(abs(left), abs(right)) > _STILL),
        )

    def set_speed(self, adv: float, rot: float) -> None:
        """Drive at `adv` mm/s while turning at `rot` rad/s. Raises `CommandRefused`."""
        check_speed(self._mechanics, adv, rot)
        self._goal[:] = wheel_speeds(self._mechanics, adv, rot)
        self._since_command = 0.0

    def stop(self) -> None:
        """Stop as fast as possible."""
        self._goal[:] = 0.0
        self._target[:] = 0.0
        self._since_command = 0.0

    def set_odometry(self, pose: Pose) -> None:
        """Set the odometry to `pose`. Raises `CommandRefused`."""
        require_finite(x=pose.x, z=pose.z, alpha=pose.alpha)
        self._odometry = pose

    def correct(self, pose: Pose) -> None:
        """Set the corrected pose to `pose`. Raises `CommandRefused`."""
        require_finite(x=pose.x, z=pose.z, alpha=pose.alpha)
        self._correction = pose.then(self.true_pose().inverse())
