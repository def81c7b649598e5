"""A robot model in poses of a tactile description, for its geometric checks, by MuJoCo.

In: the file of a model. Out: poses, axes of joints and distances from surfaces, in SI units.
Implements `tactile.description.geometry.posed_model.PosedModel`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.simulation.models.model_file import compiled, read_spec
from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.description.geometry.posed_model import JointAxis
from robocomp_dsl.tactile.description.model import GenericPart

_PROBE = "distance probe of the tactile checks"
_RADIUS = 1e-4
_FAR = 10.0
_TURNING = int(mujoco.mjtJoint.mjJNT_HINGE)
_SINGLE = (_TURNING, int(mujoco.mjtJoint.mjJNT_SLIDE))


class MujocoPosedModel:
    """The model in the file at `path`. Raises `ModelFileError` and `OSError`."""

    def __init__(self, path: Path, packages: Sequence[Path] = ()) -> None:
        spec, self.findings = read_spec(path, packages)
        probe = spec.worldbody.add_body(name=_PROBE, mocap=True)
        sphere = mujoco.mjtGeom.mjGEOM_SPHERE
        probe.add_geom(name=_PROBE, type=sphere, size=[_RADIUS, 0, 0], contype=0, conaffinity=0)
        self.model: Any = compiled(spec, self.findings)
        self.data: Any = mujoco.MjData(self.model)
        if self.model.nkey:
            mujoco.mj_resetDataKeyframe(self.model, self.data, 0)
        self._start: Floats = self.data.qpos.copy()
        self._probe = self.model.geom(_PROBE).id
        self._mocap = self.model.body(_PROBE).mocapid[0]
        self._forward()

    @property
    def joint_ranges(self) -> dict[str, tuple[float, float]]:
        """Limits [rad or m] of the joints by name, infinite without limits."""
        model = self.model
        ranges = {}
        for i in range(model.njnt):
            low, high = model.jnt_range[i] if model.jnt_limited[i] else (-np.inf, np.inf)
            ranges[model.joint(i).name] = (float(low), float(high))
        return ranges

    @property
    def body_names(self) -> frozenset[str]:
        """The names of all bodies but the world."""
        names = (self.model.body(i).name for i in range(1, self.model.nbody))
        return frozenset(name for name in names if name != _PROBE)

    @property
    def up(self) -> Floats:
        """Against gravity, (3,); z without gravity."""
        gravity = np.array(self.model.opt.gravity)
        size = float(np.linalg.norm(gravity))
        return -gravity / size if size else np.array([0.0, 0.0, 1.0])

    def set_pose(self, part: GenericPart, angles: Floats) -> None:
        """Move the joints of `part` to generic angles (n,), also beyond their limits."""
        mapping = part.mapping
        self.data.qpos[:] = self._start
        for joint in part.fixed_joints:
            self.data.qpos[self._address(joint.joint)] = joint.position
        for i, position in zip(mapping.present, mapping.joint_positions(angles), strict=True):
            self.data.qpos[self._address(part.servos[i].joint)] = position
        self._forward()

    def pose(self, name: str) -> Floats | None:
        """Pose (4, 4) of the site, else of the body `name`; None if there is none."""
        for find in (self.data.site, self.data.body):
            try:
                found = find(name)
            except KeyError:
                continue
            pose = np.eye(4)
            pose[:3, 3], pose[:3, :3] = found.xpos, found.xmat.reshape(3, 3)
            return pose
        return None

    def joint(self, name: str) -> JointAxis:
        """The axis of a joint."""
        found, joint = self.data.joint(name), self.model.joint(name)
        return JointAxis(
            name, found.xanchor.copy(), found.xaxis.copy(), rotates=int(joint.type[0]) == _TURNING
        )

    def body_of(self, joint: str) -> str:
        """The body that a joint moves."""
        return str(self.model.body(int(self.model.joint(joint).bodyid[0])).name)

    def joints_above(self, body: str) -> tuple[str, ...]:
        """The joints that move `body`, the nearest first."""
        return tuple(
            name for above in self._line(self._id(body)) for name in reversed(self._joints(above))
        )

    def joints_below(self, body: str) -> tuple[str, ...]:
        """The joints that `body` carries, also through other bodies."""
        below = sorted(self._subtree(self._id(body)) - {self._id(body)})
        return tuple(name for lower in below for name in self._joints(lower))

    def bodies_above(self, body: str) -> tuple[str, ...]:
        """The bodies that carry `body`, the nearest first; the last one is the world."""
        return tuple(self.model.body(above).name for above in [*self._line(self._id(body)), 0])[1:]

    def centre(self, body: str) -> Floats:
        """The centre of mass (3,) of `body` and of all that it carries."""
        return self._centre(self._subtree(self._id(body)))

    def rest_centre(self, body: str) -> Floats:
        """The centre of mass (3,) of the robot without `body` and all that it carries."""
        lowest = self._id(body)
        root = int(self.model.body_rootid[lowest])
        return self._centre(self._subtree(root) - self._subtree(lowest) or {root})

    def surface_distances(self, bodies: tuple[str, ...], points: Floats) -> Floats | None:
        """Distance (n,) of points (n, 3) from the nearest shape of the bodies; negative inside.

        Meshes count as their convex hulls. None if the bodies have no shapes.
        """
        names = {self._id(body) for body in bodies}
        geoms = [g for g in range(self.model.ngeom) if int(self.model.geom_bodyid[g]) in names]
        if not geoms:
            return None
        distances = np.empty(len(points))
        for i, point in enumerate(points):
            self.data.geom_xpos[self._probe] = point
            distances[i] = min(self._distance(geom) for geom in geoms)
        return distances

    def _distance(self, geom: int) -> float:
        distance = mujoco.mj_geomDistance(self.model, self.data, self._probe, geom, _FAR, None)
        return float(distance) + _RADIUS

    def _forward(self) -> None:
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)

    def _id(self, body: str) -> int:
        return int(self.model.body(body).id)

    def _address(self, joint: str) -> int:
        return int(self.model.joint(joint).qposadr[0])

    def _joints(self, body: int) -> list[str]:
        """The joints with one degree of freedom between `body` and its parent."""
        first, count = int(self.model.body_jntadr[body]), int(self.model.body_jntnum[body])
        return [
            self.model.joint(joint).name
            for joint in range(first, first + count)
            if int(self.model.jnt_type[joint]) in _SINGLE
        ]

    def _line(self, body: int) -> Iterator[int]:
        """The body and those that carry it, without the world."""
        while body:
            yield body
            body = int(self.model.body_parentid[body])

    def _subtree(self, body: int) -> set[int]:
        below = {body}
        for lower in range(body + 1, self.model.nbody):  # parents come first
            if int(self.model.body_parentid[lower]) in below:
                below.add(lower)
        return below

    def _centre(self, bodies: set[int]) -> Floats:
        rows = sorted(bodies)
        masses = self.model.body_mass[rows] + 1e-9
        centre: Floats = masses @ self.data.xipos[rows] / masses.sum()
        return centre
