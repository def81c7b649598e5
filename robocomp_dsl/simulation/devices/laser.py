"""A simulated planar range finder: rays of MuJoCo from a site on the body that carries it.

In: the settings and the mounting pose. Out: scans at fixed times of simulated time, so that noise
does not depend on the callers.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.devices.errors import SceneError
from robocomp_dsl.hardware.devices.laser import LaserSettings, Scan
from robocomp_dsl.simulation.scene import axes
from robocomp_dsl.simulation.scene.axes import MM
from robocomp_dsl.simulation.world.noise import NoiseLevel

_PAST = 1e-4  # m behind a surface of the carrier, where a ray continues
_OWN_SURFACES = 8  # surfaces of the carrier that one ray may pass


@dataclass(frozen=True, slots=True)
class LaserMount:
    """Mounting of a device: a body of the model, and the pose in its frame in mm and rad."""

    body: str = "base"
    x: float = 0.0
    y: float = 250.0
    z: float = 150.0
    alpha: float = 0.0


def mount_on(model: Any, top: int) -> NDArray[np.bool_]:
    """Which bodies are `top` or its descendants, shape (number of bodies,)."""
    found = np.zeros(model.nbody, np.bool_)
    found[top] = True
    for body in range(top + 1, model.nbody):  # parents precede their children
        found[body] |= found[model.body_parentid[body]]
    return found


class Laser:
    """The device. `name` is the name of its site in the MuJoCo model.

    Rays ignore `carrier` with all its descendants: a body, by default the tree of bodies that
    the laser is mounted in. If that is the world, they ignore nothing. `level` is a factor on the
    noise.
    """

    def __init__(
        self,
        settings: LaserSettings,
        mount: LaserMount = LaserMount(),
        *,
        name: str = "laser",
        carrier: str = "",
        level: NoiseLevel | None = None,
    ) -> None:
        self._settings = settings
        self._mount = mount
        self.name = name
        self._carrier = carrier
        self._level = level or NoiseLevel()
        self._angles = settings.angles()
        self._angles.flags.writeable = False
        wide = self._angles.astype(np.float64)
        self._rays = np.stack([np.sin(wide), np.cos(wide), np.zeros_like(wide)], axis=1)

    # -- as a part of the world ---------------------------------------------------------------

    def build(self, spec: Any) -> None:
        """Add the site to the carrier. Raises `SceneError` if there is no such body."""
        at = self._mount
        carrier = spec.body(at.body)
        if carrier is None:
            raise SceneError(f"the laser `{self.name}` is mounted on `{at.body}`, which is no body")
        carrier.add_site(
            name=self.name, pos=axes.point(at.x, at.y, at.z), quat=axes.heading(at.alpha)
        )

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:
        """Find the site and take the first scan."""
        self._random = random
        self.find(model, data)
        self._due = self._settings.period
        self._scan = self._measure()

    def find(self, model: Any, data: Any) -> None:
        """The same site in another model."""
        self._model, self._data = model, data
        self._site = int(model.site(self.name).id)
        self._body = int(model.site_bodyid[self._site])
        if self._carrier:
            top = int(model.body(self._carrier).id)
        else:
            top = int(model.body_rootid[self._body])
        # a laser in the world itself is carried by nothing: it sees all shapes
        self._own = mount_on(model, top)[model.geom_bodyid] & (top > 0)
        self._ignored = self._body if top else -1
        self._in_its_way = bool(self._own.any())

    def after_step(self, dt: float) -> None:
        """Take a scan when it is due."""
        if self._data.time >= self._due - dt / 2:
            self._due += self._settings.period
            self._scan = self._measure()

    def _measure(self) -> Scan:
        it = self._settings
        distances = self._cast() / MM
        spread = it.noise * self._level.factor
        if spread:
            hit = distances < it.max_range
            noise = self._random.standard_normal(it.measures) * spread
            distances = np.where(hit, distances + noise, distances)
        found = np.minimum(np.maximum(distances, it.min_range), it.max_range).astype(np.float32)
        found.flags.writeable = False
        return Scan(float(self._data.time), self._angles, found)

    def _cast(self) -> NDArray[np.float64]:
        """Distance of every ray in m; infinite without a hit."""
        count = self._settings.measures
        rotation = self._data.site_xmat[self._site].reshape(3, 3)
        rays = self._rays @ rotation.T
        geoms = np.empty(count, np.int32)
        distances = np.empty(count)
        mujoco.mj_multiRay(
            self._model,
            self._data,
            self._data.site_xpos[self._site],
            rays.ravel(),
            None,
            True,
            self._ignored,
            geoms,
            distances,
            None,
            count,
            self._settings.max_range * MM,
        )
        if self._in_its_way:
            own = (geoms >= 0) & self._own[np.maximum(geoms, 0)]
            for i in np.flatnonzero(own):
                distances[i] = self._behind(rays[i], float(distances[i]))
        return np.where(distances < 0, np.inf, distances)

    def _behind(self, ray: NDArray[np.float64], reached: float) -> float:
        """Distance [m] of the first surface behind the carrier on one ray; -1: none."""
        origin = self._data.site_xpos[self._site]
        geom = np.empty(1, np.int32)
        for _ in range(_OWN_SURFACES):
            start = origin + ray * (reached + _PAST)
            more = mujoco.mj_ray(
                self._model, self._data, start, ray, None, True, self._ignored, geom
            )
            if more < 0:
                return -1.0
            reached += _PAST + more
            if not self._own[geom[0]]:
                return reached
        return -1.0

    # -- as a device --------------------------------------------------------------------------

    @property
    def settings(self) -> LaserSettings:
        """Configuration of the laser."""
        return self._settings

    def scan(self) -> Scan:
        """The latest scan."""
        return self._scan
