"""The skin of a world across resets, restored states and rebuilds.

In: the simulated skin of the current world. Out: its geometry, whose version increases when taxels
change, and its frames, whose numbers always increase. Subscribers are called after the lock is
released, so that they may call the world.
"""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Callable
from dataclasses import replace

from robocomp_dsl.hardware.description.scene_skin import geometry_of
from robocomp_dsl.hardware.devices.errors import DeviceGone
from robocomp_dsl.hardware.devices.skin import SkinFrame, SkinSettings
from robocomp_dsl.simulation.devices.skin import SimulatedSkin
from robocomp_dsl.tactile.skin.contacts import Touches
from robocomp_dsl.tactile.skin.geometry import SkinGeometry

log = logging.getLogger("robocomp.simulation")

MAX_QUEUED = 64
"""Frames queued for subscribers; older ones are dropped."""


class SkinStream:
    """A `SkinDevice`. All methods but `tell` and `subscribe` need the lock of the world."""

    def __init__(self) -> None:
        self.geometry: SkinGeometry = geometry_of((), version=0)
        self._skin: SimulatedSkin | None = None
        self._sequence = 0
        self._queue: deque[SkinFrame] = deque(maxlen=MAX_QUEUED)
        self._subscribers: list[Callable[[SkinFrame], None]] = []

    def follow(self, skin: SimulatedSkin | None) -> None:
        """Continue with this skin; None: the skin was removed."""
        former, self._skin = self._skin, skin
        if skin is former:
            return
        geometry = geometry_of(()) if skin is None else skin.geometry
        changed = not self.geometry.version or not geometry.same_taxels(self.geometry)
        self.geometry = replace(geometry, version=self.geometry.version + changed)
        if skin is not None:
            skin.geometry = self.geometry
            skin.sequence = max(skin.sequence, self._sequence)
            skin.subscribe(self._on_frame)

    def _on_frame(self, frame: SkinFrame) -> None:
        self._sequence = frame.sequence
        if self._subscribers:
            self._queue.append(frame)

    # -- as a device --------------------------------------------------------------------------

    @property
    def frame(self) -> SkinFrame:
        """See `SkinDevice`."""
        found = self._require_skin().frame
        if found is None:
            raise DeviceGone("the skin has no frame yet")
        return found

    def touches(self, frame: SkinFrame) -> Touches:
        """See `SkinDevice`. Raises `DeviceGone` if the taxels have changed meanwhile."""
        skin = self._require_skin()
        if skin.geometry.version != frame.geometry:
            raise DeviceGone(f"the taxels have changed since frame {frame.sequence}")
        return skin.touches(frame)

    def calibrate(self, seconds: float) -> None:
        """See `SkinDevice`."""
        self._require_skin().calibrate(seconds)

    def configure(self, settings: SkinSettings) -> None:
        """Change the settings."""
        if self._skin is not None:
            self._skin.configure(settings)

    def subscribe(self, on_frame: Callable[[SkinFrame], None]) -> None:
        """See `SkinDevice`: `tell` calls `on_frame`."""
        self._subscribers.append(on_frame)

    def dispatch(self) -> None:
        """Call the subscribers for new frames; from one thread, without holding the lock."""
        while self._queue:
            frame = self._queue.popleft()
            for on_frame in self._subscribers:
                try:
                    on_frame(frame)
                except Exception:  # a failing subscriber does not stop the world
                    log.exception("a subscriber failed on frame %d of the skin", frame.sequence)

    def _require_skin(self) -> SimulatedSkin:
        if self._skin is None:
            raise DeviceGone("the skin has been removed from the world")
        return self._skin
