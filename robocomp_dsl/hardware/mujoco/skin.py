"""Artificial skin on a simulated robot: taxel forces whose sum is the force of the contacts.

In: MuJoCo's contacts at every physics step, averaged over one frame. Out: `SkinFrame`, some 50
times a second. MuJoCo's own touch sensors cannot do this: they count a force once for every site
that it passes, or not at all.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.errors import SceneError
from robocomp_dsl.hardware.mujoco.contact_forces import ContactRecorder, merge
from robocomp_dsl.tactile.skin.contacts import SkinContact, contacts
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from robocomp_dsl.tactile.skin.kernel import SIGMA, Kernel
from robocomp_dsl.tactile.skin.manager import Compensation, SkinManager
from robocomp_dsl.tactile.skin.sensor import COUNTS_PER_NEWTON, PERFECT, Imperfections, Sensor
from robocomp_dsl.tactile.skin.touches import Neighbours
from robocomp_dsl.tactile.skin.triangle import Raw

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class SkinSettings:
    """How the skin is simulated: `rate` [Hz] of its frames, `sigma` [m] of its kernel.

    With `raw`, frames also hold what the electronics would send; with `compensation`, forces are
    worked out from that, as on the robot, once `calibrate` was called; `shear` adds the forces
    along the skin.
    """

    rate: float = 50.0
    sigma: float = SIGMA
    shear: bool = True
    raw: bool = False
    imperfections: Imperfections = PERFECT
    compensation: Compensation | None = None


@dataclass(frozen=True, slots=True, eq=False)
class SkinFrame:
    """One frame; arrays (n,) in the order of the geometry, `shear` (n, 3) in the limbs' frames.

    `time` [s] is that of the last physics step in it; `off_skin` [N] is the contact force on the
    covered bodies that no taxel was near to. `raw` and `shear` are None unless asked for.
    """

    sequence: int
    time: float
    geometry: int
    force: Floats
    shear: Floats | None
    raw: Raw | None
    off_skin: float


class SimulatedSkin:
    """A part of a `World`. `frame` is the last one; `subscribe` hears of every new one."""

    def __init__(
        self, geometry: SkinGeometry, settings: SkinSettings | None = None, *, prefix: str = ""
    ) -> None:
        self.geometry, self.settings = geometry, settings or SkinSettings()
        self.kernel = Kernel(
            geometry.points, geometry.limb, len(geometry.limbs), self.settings.sigma
        )
        self.neighbours = Neighbours.of(geometry.points, geometry.limb)
        self.frame: SkinFrame | None = None
        self.manager: SkinManager | None = None
        self._prefix = prefix
        self._heard: list[Callable[[SkinFrame], None]] = []
        self._samples: list[Raw] = []
        self._calibrating = 0
        self._steps, self._elapsed, self._sequence = 0, 0.0, 0

    def build(self, spec: Any) -> None:
        """Nothing to add: the skin has no body of its own."""

    def bind(self, model: Any, data: Any, random: np.random.Generator) -> None:
        """Find the limbs' bodies; raises `SceneError` for one that is not there."""
        self._model, self._data = model, data
        self._sensor = Sensor(self.geometry.size, self.settings.imperfections, random)
        frames = self.geometry.frames
        bodies = [self._find(limb.body) for limb in frames]
        origins = np.array([limb.origin for limb in frames]).reshape(-1, 3)
        axes = np.array([limb.axes for limb in frames]).reshape(-1, 3, 3)
        limb_of_body = np.full(model.nbody, -1)
        for i, limb in enumerate(frames):
            for name in (limb.body, *limb.covers):
                body = self._find(name)
                if limb_of_body[body] >= 0:
                    raise SceneError(f"the body `{name}` belongs to two limbs of the skin")
                limb_of_body[body] = i
        self._limb_of_geom = limb_of_body[model.geom_bodyid]
        self._recorder = ContactRecorder(
            model, self._limb_of_geom, np.array(bodies, dtype=np.int64), origins, axes
        )

    def subscribe(self, hear: Callable[[SkinFrame], None]) -> None:
        """Call `hear` with every new frame."""
        self._heard.append(hear)

    def calibrate(self, seconds: float = 5.0) -> None:
        """Take the baseline from the frames of the next `seconds`; nothing may touch the skin."""
        self._calibrating = max(1, round(seconds * self.settings.rate))
        self._samples = []

    def contacts(self) -> list[SkinContact]:
        """The touches of the last frame."""
        if self.frame is None:
            return []
        return contacts(self.geometry, self.neighbours, self.frame.force, self.frame.shear)

    def before_step(self, dt: float) -> None:
        """Nothing to drive."""

    def after_step(self, dt: float) -> None:
        """Take in the contacts of this step, and tell a frame when its time has come."""
        self._recorder.record(self._data)
        self._steps += 1
        self._elapsed += dt
        if self._elapsed * self.settings.rate >= 1.0 - 1e-9:
            self.frame = self._make_frame()
            for hear in self._heard:
                hear(self.frame)

    def _make_frame(self) -> SkinFrame:
        n, steps, dt = self.geometry.size, self._steps, self._elapsed
        force, shear, missed = np.zeros(n), np.zeros((n, 3)), 0.0
        taken = self._recorder.take()
        if taken is not None:
            touch = merge(taken)
            columns = np.column_stack((touch.normal, touch.along))
            used = columns if self.settings.shear else touch.normal[:, None]
            share = self.kernel.share(touch.points, touch.limb, used / steps)
            force, missed = share.felt[:, 0], float(share.missed[0])
            shear = share.felt[:, 1:] if self.settings.shear else shear
        self._steps, self._elapsed = 0, 0.0
        self._sequence += 1
        told, raw = self._measured(force, dt)
        return SkinFrame(
            sequence=self._sequence,
            time=float(self._data.time),
            geometry=self.geometry.version,
            force=told,
            shear=shear if self.settings.shear else None,
            raw=raw,
            off_skin=missed,
        )

    def _measured(self, force: Floats, dt: float) -> tuple[Floats, Raw | None]:
        """What the sensors tell of the true forces: newtons, and raw values if asked for."""
        if not (self.settings.raw or self.settings.compensation):
            return self._sensor.read(force), None
        raw = self._sensor.raw(force, dt)
        told = self._sensor.read(force)
        if self.settings.compensation is not None:
            told = self._compensated(raw, self.settings.compensation)
        return told, raw if self.settings.raw else None

    def _compensated(self, raw: Raw, settings: Compensation) -> Floats:
        """Newtons from raw values; nothing is felt before the first calibration."""
        if self._calibrating:
            self._samples.append(raw)
            self._calibrating -= 1
            if not self._calibrating:
                samples = np.array(self._samples, dtype=float)
                self.manager = SkinManager.calibrated(samples, settings)
                self._samples = []
            return np.zeros(len(raw))
        if self.manager is None:
            return np.zeros(len(raw))
        counts = self.manager.compensate(raw.astype(float))
        return np.where(self.manager.touched(counts), counts / COUNTS_PER_NEWTON, 0.0)

    def _find(self, name: str) -> int:
        body = mujoco.mj_name2id(self._model, mujoco.mjtObj.mjOBJ_BODY, self._prefix + name)
        if body < 0:
            raise SceneError(f"the world has no body `{self._prefix + name}` for the skin")
        return int(body)
