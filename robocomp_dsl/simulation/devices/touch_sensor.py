"""A simulated touch sensor: the contact forces on the shapes in its frame.

In: the frame, and the normal for a sensor with a single direction. Out: a force in N within the
bounds; for a bumper 1 when pressed, else 0.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.hardware.description.scene import Triple
from robocomp_dsl.hardware.devices.errors import SceneError
from robocomp_dsl.simulation.devices.laser import mount_on
from robocomp_dsl.simulation.scene import axes

_PRESSED = 1e-3  # N


def feels(spec: Any, body: str) -> bool:
    """Whether a shape of the body, or of bodies in it, collides; one without could never touch."""
    todo = [spec.body(body)]
    for holder in todo:
        if any(geom.contype or geom.conaffinity for geom in holder.geoms):
            return True
        todo.extend(holder.bodies)
    return False


@dataclass(frozen=True, slots=True)
class TouchSettings:
    """`normal` points out of the sensor; all zero: all directions. Bounds are in N."""

    normal: Triple = (0.0, 0.0, 0.0)
    low: float = 0.0
    high: float = math.inf
    bumper: bool = False


class TouchSensor:
    """The device on the body `body`."""

    def __init__(self, settings: TouchSettings, body: str, *, name: str) -> None:
        self._settings = settings
        self._at = body
        self.name = name
        normal = np.array(axes.direction(settings.normal))
        length = float(np.linalg.norm(normal))
        self._normal = normal / length if length else None

    # -- as a part of the world ---------------------------------------------------------------

    def build(self, spec: Any) -> None:
        """Nothing to add: the shapes in its frame are the sensor. Raises `SceneError` without."""
        if not feels(spec, self._at):
            raise SceneError(f"`{self.name}` would never feel anything: no shape in it collides")

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:  # noqa: ARG002
        """Find the frame."""
        self.find(model, data)

    def find(self, model: Any, data: Any) -> None:
        """The same frame in another model."""
        self._model, self._data = model, data
        self._body = int(model.body(self._at).id)
        self._own = mount_on(model, self._body)[model.geom_bodyid]

    # -- as a device --------------------------------------------------------------------------

    def value(self) -> float:
        """The force of all contacts after the latest step."""
        force = self._force()
        if self._settings.bumper:
            return float(force > _PRESSED)
        return min(max(force, self._settings.low), self._settings.high)

    def _force(self) -> float:
        data = self._data
        if not data.ncon or not len(self._own):
            return 0.0
        own = self._own[data.contact.geom]
        total, wrench = np.zeros(3), np.empty(6)
        for i in np.flatnonzero(own[:, 0] != own[:, 1]):
            mujoco.mj_contactForce(self._model, data, int(i), wrench)
            frame = data.contact.frame[i].reshape(3, 3)
            # the contact's first axis points from the first geom to the second
            total += (frame.T @ wrench[:3]) * (-1.0 if own[i, 0] else 1.0)
        if self._normal is None:
            return float(np.linalg.norm(total))
        normal = data.xmat[self._body].reshape(3, 3) @ self._normal
        return max(-float(normal @ total), 0.0)
