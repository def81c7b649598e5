"""The skins of a scene as one part of the world: they tell their frames together.

In: a scene. Out: `SimulatedSkin` on the bodies that the scene's frames have become.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from robocomp_dsl.hardware.mujoco.noise import NoiseLevel
from robocomp_dsl.hardware.mujoco.scene_spec import body_name
from robocomp_dsl.hardware.mujoco.skin import SimulatedSkin
from robocomp_dsl.hardware.scene import ROOT, Scene
from robocomp_dsl.hardware.scene_skin import Mount, geometry_of
from robocomp_dsl.hardware.skin import SkinSettings
from robocomp_dsl.tactile.skin.geometry import LimbFrame

_AXES = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
"""From RoboComp's axes to MuJoCo's: they differ by an exchange of y and z."""


def skin_parts(
    scene: Scene, level: NoiseLevel, settings: SkinSettings, kept: Mapping[str, Any]
) -> dict[str, SimulatedSkin]:
    """The part by the ids of the skins. The one in `kept` is used again if no taxel has changed."""
    if not scene.skins:
        return {}
    geometry = geometry_of(scene.skins)
    mounts = [_mount(limb, scene) for limb in geometry.frames]
    part = next((kept[one.id] for one in scene.skins if one.id in kept), None)
    if part is not None and part.geometry.same_taxels(geometry):
        part.mounts = tuple(mounts)
    else:
        part = SimulatedSkin(geometry, settings, mounts=mounts, level=level)
    return dict.fromkeys((one.id for one in scene.skins), part)


def _mount(limb: LimbFrame, scene: Scene) -> Mount:
    """The limb as MuJoCo counts, with all that stands in its frame without a joint between.

    On a body of a model file it counts so already, and it says itself what it covers.
    """
    if any(one.id == limb.body and one.given for one in scene.frames):
        return Mount(limb.name, body_name(limb.body), limb.origin, limb.axes, limb.covers)
    taken = {one.body for skin in scene.skins for one in skin.limbs}
    held = {limb.body}
    for frame in scene.frames:  # parents come first
        moves = frame.motion or frame.drives or (frame.physics and frame.parent == ROOT)
        if frame.parent in held and not moves and frame.id not in taken:
            held.add(frame.id)
    covers = tuple(sorted(body_name(frame) for frame in held - {limb.body}))
    body = body_name(limb.body)
    return Mount(limb.name, body, _AXES @ limb.origin, _AXES @ limb.axes, covers)
