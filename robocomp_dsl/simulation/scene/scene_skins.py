"""The skins of a scene as one part of the world, with common frames.

In: a scene. Out: `SimulatedSkin` on the bodies of the scene's frames.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from robocomp_dsl.hardware.description.falling import falls
from robocomp_dsl.hardware.description.scene import Scene
from robocomp_dsl.hardware.description.scene_skin import Mount, geometry_of
from robocomp_dsl.hardware.devices.skin import SkinSettings
from robocomp_dsl.simulation.devices.skin import SimulatedSkin
from robocomp_dsl.simulation.scene.scene_spec import body_name
from robocomp_dsl.simulation.world.noise import NoiseLevel
from robocomp_dsl.tactile.skin.geometry import LimbFrame

_AXES = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
"""From RoboComp's axes to MuJoCo's: y and z are exchanged."""


def build_skins(
    scene: Scene, level: NoiseLevel, settings: SkinSettings, existing: Mapping[str, Any]
) -> dict[str, SimulatedSkin]:
    """The part by the ids of the skins. The one in `kept` is reused if no taxel has changed."""
    if not scene.skins:
        return {}
    geometry = geometry_of(scene.skins)
    mounts = [_mount(limb, scene) for limb in geometry.frames]
    part = next((existing[skin.id] for skin in scene.skins if skin.id in existing), None)
    if part is not None and part.geometry.same_taxels(geometry):
        part.mounts = tuple(mounts)
    else:
        part = SimulatedSkin(geometry, settings, mounts=mounts, level=level)
    return dict.fromkeys((skin.id for skin in scene.skins), part)


def _mount(limb: LimbFrame, scene: Scene) -> Mount:
    """The limb in MuJoCo's axes, with all bodies fixed to its frame.

    The limb of a model file's body is in these axes already, and lists what it covers.
    """
    if any(holder.id == limb.body and holder.model_part for holder in scene.frames):
        return Mount(limb.name, body_name(limb.body), limb.origin, limb.axes, limb.covers)
    taken = {holder.body for skin in scene.skins for holder in skin.limbs}
    held, frames = {limb.body}, {frame.id: frame for frame in scene.frames}
    for frame in scene.frames:  # parents precede their children
        moves = frame.motion or frame.drives or falls(frame, frames)
        if frame.parent in held and not moves and frame.id not in taken:
            held.add(frame.id)
    covers = tuple(sorted(body_name(frame) for frame in held - {limb.body}))
    body = body_name(limb.body)
    return Mount(limb.name, body, _AXES @ limb.origin, _AXES @ limb.axes, covers)
