"""A simulated inertial measurement unit on a frame: MuJoCo's sensors, in RoboComp's axes."""

from __future__ import annotations

import math
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.imu import Inertial
from robocomp_dsl.hardware.mujoco import axes
from robocomp_dsl.hardware.rotations import angles
from robocomp_dsl.hardware.scene import Triple

_TEMPERATURE = 25.0  # °C
_SENSORS = {
    "acceleration": mujoco.mjtSensor.mjSENS_ACCELEROMETER,
    "turning": mujoco.mjtSensor.mjSENS_GYRO,
    "field": mujoco.mjtSensor.mjSENS_MAGNETOMETER,
}


class Imu:
    """The device `name` on the body `body`; its reference is the frame of the world.

    It sits in the frame of the body, or at a `site` that is there.
    """

    def __init__(self, body: str, *, name: str, site: str = "") -> None:
        self._at = body
        self.name = name
        self._given = bool(site)
        self._site_name = site or name
        self._reference = np.eye(3)

    # -- as a part of the world ---------------------------------------------------------------

    def build(self, spec: Any) -> None:
        """A site and three sensors."""
        if not self._given:
            spec.body(self._at).add_site(name=self.name)
        for what, kind in _SENSORS.items():
            spec.add_sensor(
                name=f"{self.name}.{what}",
                type=kind,
                objtype=mujoco.mjtObj.mjOBJ_SITE,
                objname=self._site_name,
            )

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:  # noqa: ARG002
        """Find the sensors."""
        self.find(model, data)

    def find(self, model: Any, data: Any) -> None:
        """The same sensors in another model."""
        self._data = data
        self._site = int(model.site(self._site_name).id)
        self._first = {what: int(model.sensor(f"{self.name}.{what}").adr[0]) for what in _SENSORS}

    def before_step(self, dt: float) -> None:
        """Nothing to drive."""

    def after_step(self, dt: float) -> None:
        """Nothing to sum up."""

    # -- as a device --------------------------------------------------------------------------

    def measure(self) -> Inertial:
        """What the sensors say after the latest step."""
        (ax, ay, az), (tx, ty, tz), (fx, fy, fz) = (self._read(what) for what in _SENSORS)
        length = math.hypot(fx, fy, fz) or 1.0
        return Inertial(
            time=float(self._data.time),
            # y and z are exchanged; an axis of rotation changes its sign in a mirror
            acceleration=(ax, az, ay),
            turning=(-tx, -tz, -ty),
            field=(fx / length, fz / length, fy / length),
            orientation=angles(self._reference.T @ self._rotation()),
            temperature=_TEMPERATURE,
        )

    def reset(self) -> None:
        """The present orientation becomes the reference."""
        self._reference = self._rotation()

    def _rotation(self) -> NDArray[np.float64]:
        turned: NDArray[np.float64] = self._data.site_xmat[self._site][axes.EXCHANGED]
        return turned.reshape(3, 3)

    def _read(self, what: str) -> Triple:
        """In MuJoCo's axes."""
        first = self._first[what]
        x, y, z = self._data.sensordata[first : first + 3].tolist()
        return x, y, z
