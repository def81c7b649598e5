"""The skin of a world that may be reset, restored and rebuilt: one device through all of it.

In: the simulated skin of the world as it is now. Out: its geometry, whose version goes up when
taxels change, and its frames, whose numbers only grow. Frames are heard of after the world's turn,
so that who hears of one may ask the world something.
"""

from __future__ import annotations

import logging
from collections import deque
from collections.abc import Callable
from dataclasses import replace

from robocomp_dsl.hardware.errors import DeviceGone
from robocomp_dsl.hardware.mujoco.skin import SimulatedSkin
from robocomp_dsl.hardware.scene_skin import geometry_of
from robocomp_dsl.hardware.skin import SkinFrame, SkinSettings
from robocomp_dsl.tactile.skin.contacts import Touches
from robocomp_dsl.tactile.skin.geometry import SkinGeometry

log = logging.getLogger("robocomp.simulation")

MOST_WAITING = 64
"""Frames that wait to be heard of; older ones are let go of."""


class SkinStream:
    """A `SkinDevice`. All but `tell` and `subscribe` in the world's turn."""

    def __init__(self) -> None:
        self.geometry: SkinGeometry = geometry_of((), version=0)
        self._skin: SimulatedSkin | None = None
        self._sequence = 0
        self._waiting: deque[SkinFrame] = deque(maxlen=MOST_WAITING)
        self._heard: list[Callable[[SkinFrame], None]] = []

    def follow(self, skin: SimulatedSkin | None) -> None:
        """Go on with this skin; None: there is none any more."""
        former, self._skin = self._skin, skin
        if skin is former:
            return
        made = geometry_of(()) if skin is None else skin.geometry
        anew = not self.geometry.version or not made.same_taxels(self.geometry)
        self.geometry = replace(made, version=self.geometry.version + anew)
        if skin is not None:
            skin.geometry = self.geometry
            skin.sequence = max(skin.sequence, self._sequence)
            skin.subscribe(self._hear)

    def _hear(self, frame: SkinFrame) -> None:
        self._sequence = frame.sequence
        if self._heard:
            self._waiting.append(frame)

    # -- as a device --------------------------------------------------------------------------

    @property
    def frame(self) -> SkinFrame:
        """See `SkinDevice`."""
        found = self._there().frame
        if found is None:
            raise DeviceGone("the skin has not felt anything yet: its first frame is still to come")
        return found

    def touches(self, frame: SkinFrame) -> Touches:
        """See `SkinDevice`. Raises `DeviceGone` where the taxels have changed since."""
        skin = self._there()
        if skin.geometry.version != frame.geometry:
            raise DeviceGone(f"the taxels have changed since frame {frame.sequence}")
        return skin.touches(frame)

    def calibrate(self, seconds: float) -> None:
        """See `SkinDevice`."""
        self._there().calibrate(seconds)

    def adjust(self, settings: SkinSettings) -> None:
        """Other settings from now on."""
        if self._skin is not None:
            self._skin.adjust(settings)

    def subscribe(self, hear: Callable[[SkinFrame], None]) -> None:
        """See `SkinDevice`: `hear` is called by `tell`."""
        self._heard.append(hear)

    def tell(self) -> None:
        """Let those who subscribed hear of new frames; from one thread, outside of the turn."""
        while self._waiting:
            frame = self._waiting.popleft()
            for hear in self._heard:
                try:
                    hear(frame)
                except Exception:  # who hears badly does not stop the world
                    log.exception("frame %d of the skin could not be told", frame.sequence)

    def _there(self) -> SimulatedSkin:
        if self._skin is None:
            raise DeviceGone("the skin has been removed from the world")
        return self._skin
