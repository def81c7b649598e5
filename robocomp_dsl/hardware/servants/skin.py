"""`Skin` over a skin, and the topics with its frames and touches."""

# ruff: noqa: N802  called as in the interface

from __future__ import annotations

from typing import Any, Protocol

import numpy as np

from robocomp_dsl.hardware.devices.errors import HardwareError
from robocomp_dsl.hardware.devices.skin import SkinDevice, SkinFrame
from robocomp_dsl.hardware.servants.servant import Servant
from robocomp_dsl.tactile.skin.contacts import Touches
from robocomp_dsl.tactile.skin.geometry import LimbFrame, SkinGeometry

_NONE = np.zeros(0, np.float32)
_NO_RAW = np.zeros(0, np.uint8)


class FrameTopic(Protocol):
    """`SkinFrame`."""

    def frame(self, frame: Any) -> None:
        """Publish a frame."""

    def has_subscribers(self) -> bool:
        """Whether the topic has subscribers."""


class ContactTopic(Protocol):
    """`SkinContacts`."""

    def contacts(self, contacts: Any) -> None:
        """Publish the touches of a frame."""

    def has_subscribers(self) -> bool:
        """Whether the topic has subscribers."""


class SkinServant(Servant):
    """All skins of the port are one device."""

    @property
    def _skin(self) -> SkinDevice:
        found: SkinDevice = self.device()
        return found

    def getGeometry(self) -> Any:
        """The positions of the taxels."""
        it = self._skin.geometry
        x, y, z = _columns(it.points)
        nx, ny, nz = _columns(it.normals)
        return self.types.Geometry(
            version=it.version,
            id=it.ids.astype(np.int32),
            patch=it.patch.astype(np.int32),
            limb=it.limb.astype(np.int32),
            x=x,
            y=y,
            z=z,
            nx=nx,
            ny=ny,
            nz=nz,
            patches=self._patches(it),
            limbs=[
                self._limb(name, frame) for name, frame in zip(it.limbs, it.frames, strict=True)
            ],
        )

    def getFrame(self) -> Any:
        """The latest frame."""
        return self._frame_to_message(self._skin.frame)

    def getContacts(self) -> Any:
        """The touches of the latest frame."""
        frame = self._skin.frame
        return self._list(frame, self._skin.touches(frame))

    def calibrate(self, seconds: float) -> None:
        """Measure the baseline."""
        self._skin.calibrate(seconds)

    def publish(self, frames: FrameTopic, touches: ContactTopic) -> None:
        """Publish every new frame and its touches, if the topic has subscribers.

        An empty list of touches is published once, not with every frame.
        """
        touched = True

        def hear(new: SkinFrame) -> None:
            nonlocal touched
            if frames.has_subscribers():
                frames.frame(self._frame_to_message(new))
            felt = bool(new.force.any())
            if not (felt or touched) or not touches.has_subscribers():
                return
            touched = felt
            try:
                found = self._skin.touches(new)
            except HardwareError:  # its taxels were removed meanwhile
                return
            touches.contacts(self._list(new, found))

        self._skin.subscribe(hear)

    # -- inside -------------------------------------------------------------------------------

    def _frame_to_message(self, frame: SkinFrame) -> Any:
        shear = (_NONE,) * 3 if frame.shear is None else _columns(frame.shear)
        return self.types.Frame(
            sequence=frame.sequence,
            time=frame.time,
            geometry=frame.geometry,
            force=frame.force.astype(np.float32),
            shearX=shear[0],
            shearY=shear[1],
            shearZ=shear[2],
            raw=_NO_RAW if frame.raw is None else frame.raw,
            offSkin=frame.off_skin,
        )

    def _list(self, frame: SkinFrame, found: Touches) -> Any:
        x, y, z = found.centre.T
        nx, ny, nz = found.normal.T
        sx, sy, sz = found.shear.T
        rows = self.types.Contacts.from_columns(
            limb=found.limb,
            taxels=found.count,
            x=x,
            y=y,
            z=z,
            nx=nx,
            ny=ny,
            nz=nz,
            force=found.force,
            shearX=sx,
            shearY=sy,
            shearZ=sz,
            pressure=found.pressure,
            area=found.area,
        )
        return self.types.ContactList(
            sequence=frame.sequence, time=frame.time, geometry=frame.geometry, contacts=rows
        )

    def _patches(self, it: SkinGeometry) -> list[Any]:
        return [
            self.types.Patch(
                name=name,
                gain=sensitivity.gain,
                floor=sensitivity.floor,
                saturation=sensitivity.saturation,
            )
            for name, sensitivity in zip(it.patches, it.sensitivities, strict=True)
        ]

    def _limb(self, name: str, limb_frame: LimbFrame) -> Any:
        r = limb_frame.axes.tolist()
        turn = {f"r{i}{j}": r[i][j] for i in range(3) for j in range(3)}
        x, y, z = limb_frame.origin.tolist()
        return self.types.Limb(name=name, body=limb_frame.body, x=x, y=y, z=z, **turn)


def _columns(rows: Any) -> tuple[Any, Any, Any]:
    """The columns of an array (n, 3) as three arrays for the wire."""
    x, y, z = np.ascontiguousarray(rows.T, dtype=np.float32)
    return x, y, z
