"""A simulated inertial measurement unit on a frame: MuJoCo's sensors, in RoboComp's axes.

In: its mounting pose and its noise. Out: measurements. Errors are drawn 200 times a second,
independent of callers.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.devices.imu import Inertial
from robocomp_dsl.hardware.kinematics.rotations import angles
from robocomp_dsl.simulation.scene import axes
from robocomp_dsl.simulation.world.noise import NoiseLevel

_TEMPERATURE = 25.0  # °C
_PERIOD = 0.005  # s
_STILL = (0.0, 0.0, 0.0)
_EXCHANGED = axes.EXCHANGED.reshape(3, 3)
_SENSORS = {
    "acceleration": mujoco.mjtSensor.mjSENS_ACCELEROMETER,
    "angular_velocity": mujoco.mjtSensor.mjSENS_GYRO,
    "field": mujoco.mjtSensor.mjSENS_MAGNETOMETER,
}


@dataclass(frozen=True, slots=True)
class ImuNoise:
    """Standard deviations of accelerations (m/s²) and angular velocities (rad/s)."""

    acceleration: float = 0.0
    angular_velocity: float = 0.0


class Imu:
    """The device `name` on the body `body`; its initial reference is the world frame.

    It is mounted in the frame of the body, or at an existing `site`.
    """

    def __init__(
        self,
        body: str,
        *,
        name: str,
        site: str = "",
        noise: ImuNoise = ImuNoise(),
        level: NoiseLevel | None = None,
    ) -> None:
        self._at = body
        self.name = name
        self._noise = noise if noise != ImuNoise() else None
        self._level = level or NoiseLevel()
        self._errors = (_STILL, _STILL)
        self._model_site = bool(site)
        self._site_name = site or name
        self._back = np.eye(3)  # the inverse of the reference

    # -- as a part of the world ---------------------------------------------------------------

    def build(self, spec: Any) -> None:
        """Add a site and three sensors."""
        if not self._model_site:
            spec.body(self._at).add_site(name=self.name)
        for what, kind in _SENSORS.items():
            spec.add_sensor(
                name=f"{self.name}.{what}",
                type=kind,
                objtype=mujoco.mjtObj.mjOBJ_SITE,
                objname=self._site_name,
            )

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:
        """Find the sensors."""
        self._random, self._due = random, 0.0
        self.find(model, data)
        self.after_step(0.0)

    def find(self, model: Any, data: Any) -> None:
        """The same sensors in another model."""
        self._data = data
        self._site = int(model.site(self._site_name).id)
        first = [int(model.sensor(f"{self.name}.{what}").adr[0]) for what in _SENSORS]
        self._where = np.array([range(start, start + 3) for start in first]).ravel()

    def after_step(self, dt: float) -> None:
        """Draw new errors when they are due."""
        if self._noise is not None and self._data.time >= self._due - dt / 2:
            self._due += _PERIOD
            first, two, three, four, five, six = self._random.standard_normal(6).tolist()
            self._errors = ((first, two, three), (four, five, six))

    # -- as a device --------------------------------------------------------------------------

    def measure(self) -> Inertial:
        """The sensor values after the latest step."""
        data = self._data
        ax, ay, az, tx, ty, tz, fx, fy, fz = data.sensordata[self._where].tolist()
        length = math.hypot(fx, fy, fz) or 1.0
        if self._noise is not None:
            pushed, turned = self._errors
            push, turn = (
                self._noise.acceleration * self._level.factor,
                self._noise.angular_velocity * self._level.factor,
            )
            ax, ay, az = ax + push * pushed[0], ay + push * pushed[1], az + push * pushed[2]
            tx, ty, tz = tx + turn * turned[0], ty + turn * turned[1], tz + turn * turned[2]
        return Inertial(
            time=float(data.time),
            # y and z are exchanged; a mirror reverses the sign of a rotation axis
            acceleration=(ax, az, ay),
            angular_velocity=(-tx, -tz, -ty),
            field=(fx / length, fz / length, fy / length),
            orientation=angles(self._back.dot(self._rotation())),
            temperature=_TEMPERATURE,
        )

    def reset(self) -> None:
        """Make the current orientation the reference."""
        self._back = self._rotation().T.copy()

    def _rotation(self) -> NDArray[np.float64]:
        turned: NDArray[np.float64] = self._data.site_xmat[self._site][_EXCHANGED]
        return turned
