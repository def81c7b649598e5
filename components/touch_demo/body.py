"""The robot's body and the finger in any pose, from the world file of the simulator.

In: the world file, the skin, the arm's description. Out: poses of limbs, and the contact points of
the finger on them. The body does not move by itself: poses are set from measurements.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from recording import Floats, Place, Skin

from robocomp_dsl.simulation.models.model_file import compiled, read_spec
from robocomp_dsl.simulation.view.picture import add_lighting
from robocomp_dsl.tactile.description.model import GenericPart

FINGER = ("finger_x", "finger_y", "finger_z")
CAMERA = "onlooker"
_DOT = 0.0032
_BODY, _FLOOR, _FINGERTIP = (0.86, 0.89, 0.93, 1), (0, 0, 0, 0), (0.0, 0.62, 0.45, 1)
_OVERLAP = 0.001
_CLEAR = 0.055
"""m from the limb's axis: outside the limb, and closer than the rest of the robot."""


class Body:
    """`data` is in the last pose that was set. Taxel i of the skin is the site `taxel<i>`."""

    def __init__(self, world: Path, skin: Skin, part: GenericPart) -> None:
        spec, findings = read_spec(world)
        add_lighting(spec)
        for i in range(len(skin.limb)):
            where = skin.placed(skin.limbs[skin.limb[i]], skin.points[i])
            spec.body(skin.bodies[skin.limb[i]]).add_site(
                name=f"taxel{i}", pos=where, size=[_DOT, 0, 0], rgba=[0.5, 0.5, 0.5, 1]
            )
        spec.worldbody.add_camera(name=CAMERA)
        self.skin, self.part = skin, part
        self.model: Any = compiled(spec, findings)
        self.data: Any = mujoco.MjData(self.model)
        self.sites = np.array([self.model.site(f"taxel{i}").id for i in range(len(skin.limb))])
        self._known = {self.model.joint(i).name for i in range(self.model.njnt)}
        self._mapping = part.mapping
        self._joints = [name.rpartition("/")[2] for name in part.joints]
        self._finger_body = int(self.model.joint(FINGER[0]).bodyid[0])
        self._finger_bodies = {int(self.model.joint(name).bodyid[0]) for name in FINGER}
        mujoco.mj_forward(self.model, self.data)
        self._find_finger()
        self._paint()

    def pose(
        self,
        joints: Mapping[str, float] | None = None,
        arm: Floats | None = None,
        finger: Floats | None = None,
    ) -> None:
        """Set joints by name, generic angles (5,) and the finger's joints (3,).

        Joints that only a board has, such as version and vergence of the eyes, are ignored.
        """
        angles = {name: at for name, at in (joints or {}).items() if name in self._known}
        if arm is not None:
            values = self._mapping.joint_positions(arm)
            angles |= dict(zip(self._joints, values.tolist(), strict=True))
        if finger is not None:
            angles |= dict(zip(FINGER, finger.tolist(), strict=True))
        for name, value in angles.items():
            self.data.joint(name).qpos[0] = value
        mujoco.mj_forward(self.model, self.data)

    def centre(self, place: Place) -> Floats:
        """The position of a field's centre in the world, (3,)."""
        body = self.data.body(self.skin.bodies[self.skin.limbs.index(place.limb)])
        on_body = self.skin.placed(place.limb, place.centre)
        found: Floats = body.xmat.reshape(3, 3) @ on_body + body.xpos
        return found

    def outward(self, place: Place) -> Floats:
        """The unit vector from the limb's axis through a field's centre, in the world, (3,)."""
        i = self.skin.limbs.index(place.limb)
        out = np.array([0.0, *place.centre[1:]])
        turned: Floats = (
            self.data.body(self.skin.bodies[i]).xmat.reshape(3, 3) @ self.skin.axes[i] @ out
        )
        return turned / np.linalg.norm(turned)

    def touching(self, place: Place) -> Floats:
        """The finger's centre when it just touches the limb at the field's centre."""
        out = self.outward(place)
        axis = self.centre(place) - out * np.linalg.norm(place.centre[1:])
        start, geom = axis + _CLEAR * out, np.zeros(1, np.int32)
        finger = self._finger_body
        way = mujoco.mj_ray(self.model, self.data, start, -out, None, 1, finger, geom)
        touched: Floats = start - (way - self.finger_radius) * out
        return touched

    def is_accessible(self, place: Place) -> bool:
        """Whether the finger can touch the field's centre without overlapping anything else."""
        return self.clearance(self.touching(place)) > -_OVERLAP

    def clearance(self, point: Floats) -> float:
        """Distance of a finger at `point` (3,) to everything else, at most 0.2 m."""
        at = self.data.geom_xpos[self.finger_geom]
        previous = at.copy()
        at[:] = point
        fromto = np.zeros(6)
        nearest = min(
            mujoco.mj_geomDistance(self.model, self.data, self.finger_geom, other, 0.2, fromto)
            for other in self._solid
        )
        at[:] = previous
        return float(nearest)

    @property
    def finger_point(self) -> Floats:
        """The position of the finger's centre, (3,)."""
        point: Floats = self.data.geom_xpos[self.finger_geom].copy()
        return point

    def finger_joints(self, point: Floats) -> Floats:
        """The finger's joint positions (3,) for its centre at `point` (3,)."""
        joints: Floats = np.linalg.solve(self._finger_axes, point - self._finger_zero)
        return joints

    def _paint(self) -> None:
        """Use bright bodies, so that the skin on them is visible; the floor is unchanged."""
        planes = self.model.geom_type == mujoco.mjtGeom.mjGEOM_PLANE
        self.model.geom_matid[:] = -1
        self.model.geom_rgba[:] = np.where(planes[:, None], _FLOOR, _BODY)
        self.model.geom_rgba[self.finger_geom] = _FINGERTIP
        self.model.light_active[:] = 0  # a single light, whatever the world has
        light = self.model.vis.headlight
        light.ambient, light.diffuse, light.specular = [0.5] * 3, [0.5] * 3, [0.05] * 3

    def _find_finger(self) -> None:
        """Its geom, and the map from its joints (slides in any directions) to its motion."""
        geoms = [
            geom
            for geom in range(self.model.ngeom)
            if int(self.model.geom_bodyid[geom]) in self._finger_bodies
        ]
        self.finger_geom = geoms[-1]
        self._finger_body = int(self.model.geom_bodyid[self.finger_geom])
        self.finger_radius = float(self.model.geom_size[self.finger_geom, 0])
        ids = [int(self.model.joint(name).id) for name in FINGER]
        now = np.array([self.data.joint(name).qpos[0] for name in FINGER])
        self._finger_axes = self.data.xaxis[ids].T.copy()
        self._finger_zero = self.data.geom_xpos[self.finger_geom] - self._finger_axes @ now
        self._solid = [
            geom
            for geom in range(self.model.ngeom)
            if self.model.geom_contype[geom] and geom not in geoms
        ]
