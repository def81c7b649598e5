"""Artificial skin on a simulated robot: taxel forces whose sum is the force of the contacts.

In: MuJoCo's contacts at every physics step, averaged over one frame. Out: `SkinFrame`, about 50
times a second. MuJoCo's own touch sensors are unsuitable: they count a force for every site that it
passes, or for none.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Self

import mujoco
import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.devices.errors import CommandRefused, SceneError, require_finite
from robocomp_dsl.hardware.devices.skin import SkinFrame, SkinSettings
from robocomp_dsl.simulation.devices.contact_forces import ContactRecorder, merge
from robocomp_dsl.simulation.world.noise import NoiseLevel
from robocomp_dsl.tactile.skin.contacts import SkinContact, Touches, contacts, touches
from robocomp_dsl.tactile.skin.electronics import SkinElectronics
from robocomp_dsl.tactile.skin.geometry import LimbFrame, SkinGeometry
from robocomp_dsl.tactile.skin.kernel import ForceKernel
from robocomp_dsl.tactile.skin.touches import TaxelGraph
from robocomp_dsl.tactile.skin.triangle import Raw

Floats = NDArray[np.float64]

LONGEST_CALIBRATION = 600.0
"""Seconds."""


class Subscribers(list[Callable[[SkinFrame], None]]):
    """Callbacks for new frames. A copy of a world has no subscribers."""

    def __deepcopy__(self, memo: object) -> Self:
        return type(self)()


class SimulatedSkin:
    """A part of a `World`. `frame` is the latest frame; `subscribe` adds a callback for new ones.

    `geometry` is the geometry of the frames; `mounts` are its limbs in MuJoCo's axes, if these
    differ.
    """

    def __init__(
        self,
        geometry: SkinGeometry,
        settings: SkinSettings | None = None,
        *,
        prefix: str = "",
        mounts: Sequence[LimbFrame] | None = None,
        level: NoiseLevel | None = None,
    ) -> None:
        self.geometry, self.settings = geometry, settings or SkinSettings()
        self.mounts = geometry.frames if mounts is None else tuple(mounts)
        self.kernel = self._kernel()
        self.neighbours = TaxelGraph.of(geometry.points, geometry.limb)
        self.frame: SkinFrame | None = None
        self.sequence = 0
        self._level = level or NoiseLevel()
        self._prefix = prefix
        self._subscribers = Subscribers()
        self._steps, self._elapsed, self._phase = 0, 0.0, 0.0

    def build(self, spec: Any) -> None:
        """Nothing to add: the skin has no body of its own."""

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:
        """Find the limbs' bodies; raises `SceneError` for missing ones."""
        self.electronics = SkinElectronics(self.geometry, self.settings.imperfections, random)
        self.find(model, data)

    def find(self, model: Any, data: Any) -> None:
        """The same limbs in another model."""
        self._model, self._data = model, data
        bodies = [self._find(limb.body) for limb in self.mounts]
        limb_of_body = np.full(model.nbody, -1)
        for i, limb in enumerate(self.mounts):
            for name in (limb.body, *limb.covers):
                body = self._find(name)
                if limb_of_body[body] >= 0:
                    raise SceneError(f"the body `{name}` belongs to two limbs of the skin")
                limb_of_body[body] = i
        self._limb_of_geom = limb_of_body[model.geom_bodyid]
        self._recorder = ContactRecorder(
            model,
            self._limb_of_geom,
            np.array(bodies, dtype=np.int64),
            np.array([limb.origin for limb in self.mounts]).reshape(-1, 3),
            np.array([limb.axes for limb in self.mounts]).reshape(-1, 3, 3),
        )

    def configure(self, settings: SkinSettings) -> None:
        """Change the settings."""
        sigma, self.settings = self.settings.sigma, settings
        if settings.sigma != sigma:
            self.kernel = self._kernel()
        self.electronics.adjust(settings.imperfections)

    def subscribe(self, on_frame: Callable[[SkinFrame], None]) -> None:
        """Call `on_frame` with every new frame."""
        self._subscribers.append(on_frame)

    def calibrate(self, seconds: float = 5.0) -> None:
        """Measure the baseline during the next `seconds`; the skin must not be touched meanwhile.

        Raises `CommandRefused` if compensation is off.
        """
        require_finite(seconds=seconds)
        if not 0.0 < seconds <= LONGEST_CALIBRATION:
            most = f"{LONGEST_CALIBRATION:g}"
            raise CommandRefused(f"`seconds` is {seconds:g}, it must be above 0 and at most {most}")
        if self.settings.compensation is None:
            raise CommandRefused("the skin is not compensated, so there is nothing to calibrate")
        self.electronics.calibrate(seconds)

    def contacts(self) -> list[SkinContact]:
        """The touches of the latest frame."""
        frame = self.frame
        if frame is None:
            return []
        return contacts(self.geometry, self.neighbours, frame.force, frame.shear)

    def touches(self, frame: SkinFrame) -> Touches:
        """The touches of a frame of this geometry."""
        return touches(self.geometry, self.neighbours, frame.force, frame.shear)

    def after_step(self, dt: float) -> None:
        """Add the contacts of this step, and emit a frame when it is due."""
        self._recorder.record(self._data)
        self._steps += 1
        self._elapsed += dt
        self._phase += dt * self.settings.rate
        if self._phase >= 1.0 - 1e-9:
            self._phase = max(self._phase - 1.0, 0.0) % 1.0
            self.frame = self._make_frame()
            for on_frame in self._subscribers:
                on_frame(self.frame)

    def _make_frame(self) -> SkinFrame:
        dt, steps = self._elapsed, self._steps
        force, shear, missed = self._contact_forces(steps)
        self._steps, self._elapsed = 0, 0.0
        self.sequence += 1
        measured, raw = self._measured(force, dt)
        return SkinFrame(
            sequence=self.sequence,
            time=float(self._data.time),
            geometry=self.geometry.version,
            force=measured,
            shear=shear,
            raw=raw,
            off_skin=missed,
        )

    def _contact_forces(self, steps: int) -> tuple[Floats, Floats | None, float]:
        """Mean forces over so many steps: normal and shear per taxel, and off-skin force."""
        n, both = self.geometry.size, self.settings.shear
        taken = self._recorder.take()
        if taken is None:
            return np.zeros(n), np.zeros((n, 3)) if both else None, 0.0
        touch = merge(taken)
        forces = np.empty((len(touch.limb), 4 if both else 1))
        forces[:, 0] = touch.normal
        if both:
            forces[:, 1:] = touch.along
        share = self.kernel.distribute(touch.points, touch.limb, forces / steps)
        return (
            share.taxel_forces[:, 0],
            share.taxel_forces[:, 1:] if both else None,
            float(share.off_skin[0]),
        )

    def _measured(self, force: Floats, dt: float) -> tuple[Floats, Raw | None]:
        """The sensor values of the true forces: newtons, and raw values if enabled."""
        settings, noise, electronics = self.settings, self._level.factor, self.electronics
        if settings.compensation is None:
            raw = electronics.raw(force, dt, noise) if settings.raw else None
            return electronics.read(force, noise), raw
        raw = electronics.raw(force, dt, noise)
        compensated = electronics.compensated(raw, dt, settings.compensation)
        return compensated, raw if settings.raw else None

    def _kernel(self) -> ForceKernel:
        geometry = self.geometry
        limbs = len(geometry.limbs)
        return ForceKernel(geometry.points, geometry.limb, limbs, self.settings.sigma)

    def _find(self, name: str) -> int:
        body = mujoco.mj_name2id(self._model, mujoco.mjtObj.mjOBJ_BODY, self._prefix + name)
        if body < 0:
            raise SceneError(f"the world has no body `{self._prefix + name}` for the skin")
        return int(body)
