"""The body of a robot with a tactile description: kinematics and distances to itself, by MuJoCo.

In: the model that the description names, a part, generic angles. Out: frames of limbs, Jacobians
and distances in SI units, in the world of the model. Joints of other parts stay at their start.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.hardware.description.findings import ModelFileError
from robocomp_dsl.simulation.models.model_file import load_model
from robocomp_dsl.tactile.arm.limb_kinematics import ClosePoint
from robocomp_dsl.tactile.arrays import Floats, Ints
from robocomp_dsl.tactile.description.model import Limb, RobotDescription
from robocomp_dsl.tactile.description.yaml_reader import UNITS

_KEY = "start"
_POSES = 12
_CONSTANT = 1e-6
_FAR = 1.0


class BodyModel:
    """The part `part` of a robot in `model`, an `mujoco.MjModel`. Implements `LimbKinematics`.

    Raises `KeyError` for a part, joint or body that does not exist.
    """

    def __init__(self, robot: RobotDescription, part: str, model: Any) -> None:
        self.robot, self.part, self.model = robot, robot.part(part), model
        self.data: Any = mujoco.MjData(model)
        self._set_other_joints()
        self._mapping = self.part.mapping
        present = self._mapping.present
        names = [self.part.servos[i].joint for i in present]
        self._addresses = np.array([self._qpos_address(name) for name in names], np.int64)
        self._dofs = np.array([model.joint(name).dofadr[0] for name in names], np.int64)
        self._limbs = {limb.name: limb for limb in self.part.limbs}
        self._limb_of = {
            model.body(body).id: limb
            for limb in self.part.limbs
            for body in (limb.body, *limb.covers)
        }
        self._angles: Floats | None = None
        mujoco.mj_kinematics(model, self.data)
        self._pairs = self._relevant_pairs()

    @classmethod
    def load(cls, robot: RobotDescription, part: str, packages: Sequence[Path] = ()) -> BodyModel:
        """The model file of the description. Raises `ModelFileError`, `OSError`, `KeyError`."""
        if robot.model_file is None:
            raise ModelFileError("the description names no `model`")
        return cls(robot, part, load_model(robot.model_file, packages).model)

    def set_pose(self, angles: Floats) -> None:
        """Set generic angles (n,); later calls refer to `data`."""
        if self._angles is not None and np.array_equal(self._angles, angles):
            return
        self.data.qpos[self._addresses] = self._mapping.joint_positions(angles)
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        self._angles = np.array(angles, dtype=np.float64)

    def frame(self, limb: str, angles: Floats) -> tuple[Floats, Floats]:
        """Origin (3,) [m] and axes (3, 3) of the limb's frame in the world."""
        self.set_pose(angles)
        return self._frame(self._limbs[limb])

    def jacobian(self, limb: str, point: Floats, angles: Floats) -> Floats:
        """World velocity of `point` (3,) [m] of the limb per generic speed, (3, n) [m/rad]."""
        self.set_pose(angles)
        origin, axes = self._frame(self._limbs[limb])
        full = np.zeros((3, self.model.nv))
        body = self.model.body(self._limbs[limb].body).id
        mujoco.mj_jac(self.model, self.data, full, None, origin + axes @ point, body)
        jacobian = np.zeros((3, self._mapping.size))
        present = self._mapping.present
        jacobian[:, present] = full[:, self._dofs] / self._mapping.gamma_si[present]
        return jacobian

    def close_points(self, angles: Floats, within: float) -> list[ClosePoint]:
        """Places of the limbs that are at most `within` [m] from another part of the robot."""
        self.set_pose(angles)
        found = []
        for mine, other, distance, segment in self._distances(within):
            ends = ((mine, segment[:3], other), (other, segment[3:], mine))
            for geom, point, opposite in ends:
                limb = self._limb_of.get(int(self.model.geom_bodyid[geom]))
                if limb:
                    origin, axes = self._frame(limb)
                    name = self.model.body(self.model.geom_bodyid[opposite]).name
                    place = (point - origin) @ axes
                    found.append(ClosePoint(limb.name, place, name, distance))
        return found

    def clearance(self, angles: Floats, within: float) -> float:
        """The smallest distance [m] of the arm to the rest of the robot, at most `within`."""
        self.set_pose(angles)
        return min((distance for *_, distance, _ in self._distances(within)), default=within)

    def _frame(self, limb: Limb) -> tuple[Floats, Floats]:
        body = self.data.body(limb.body)
        rotation = body.xmat.reshape(3, 3)
        return rotation @ limb.origin + body.xpos, rotation @ limb.axes

    def _distances(self, within: float) -> Iterator[tuple[int, int, float, Floats]]:
        """Pairs of geoms at most `within` apart, their distance and their nearest points (6,)."""
        if not len(self._pairs):
            return
        centres, radius = self.data.geom_xpos, self.model.geom_rbound
        mine, other = self._pairs.T
        apart = np.linalg.norm(centres[mine] - centres[other], axis=1)
        near = apart - radius[mine] - radius[other] <= within
        segment = np.zeros(6)
        for a, b in self._pairs[near].tolist():
            distance = mujoco.mj_geomDistance(self.model, self.data, a, b, within, segment)
            if distance < within:
                yield a, b, float(distance), segment

    def _relevant_pairs(self) -> Ints:
        """Pairs (k, 2) of a geom of the arm and one of the rest of the robot that may touch.

        Pairs that the model excludes, bodies that a joint connects, pairs that overlap in the start
        pose, and pairs whose distance is constant are left out: they are no sign of contact.
        """
        model = self.model
        arm = self._arm_bodies()
        root = model.body_rootid[self._any_arm_body()]
        solid = [
            geom
            for geom in range(model.ngeom)
            if (model.geom_contype[geom] or model.geom_conaffinity[geom])
            and model.body_rootid[model.geom_bodyid[geom]] == root
            and model.geom_rbound[geom] > 0.0
        ]
        excluded = {(int(s) >> 16, int(s) & 0xFFFF) for s in model.exclude_signature}
        self.set_pose(self.part.start)
        pairs = []
        for a in solid:
            first = int(model.geom_bodyid[a])
            if first not in arm:
                continue
            for b in solid:
                second = int(model.geom_bodyid[b])
                if second in arm and not self._separable(a, b):
                    continue
                names = {(first, second), (second, first)}
                if names & excluded or self._connected(first, second):
                    continue
                if self._distance(a, b) > 0.0:
                    pairs.append((a, b))
        return self._moving_pairs(np.array(pairs, np.int64).reshape(-1, 2))

    def _moving_pairs(self, pairs: Ints) -> Ints:
        """Those pairs (k, 2) whose distance depends on the pose."""
        low, high = self._mapping.limits
        rng = np.random.default_rng(0)
        distances = []
        for _ in range(_POSES):
            self.set_pose(rng.uniform(low, high))
            distances.append([self._distance(a, b) for a, b in pairs.tolist()])
        moving = np.ptp(np.array(distances), axis=0) > _CONSTANT
        chosen: Ints = pairs[moving]
        return chosen

    def _distance(self, first: int, second: int) -> float:
        segment = np.zeros(6)
        return float(mujoco.mj_geomDistance(self.model, self.data, first, second, _FAR, segment))

    def _separable(self, a: int, b: int) -> bool:
        """Whether two geoms of the arm move against each other; each pair is taken once."""
        model = self.model
        first, second = int(model.geom_bodyid[a]), int(model.geom_bodyid[b])
        return a < b and model.body_weldid[first] != model.body_weldid[second]

    def _connected(self, first: int, second: int) -> bool:
        """Whether the bodies are one, or a joint connects them."""
        model = self.model
        welds = [int(model.body_weldid[body]) for body in (first, second)]
        above = [int(model.body_weldid[model.body_parentid[weld]]) for weld in welds]
        return welds[0] in {welds[1], above[1]} or welds[1] == above[0]

    def _any_arm_body(self) -> int:
        return int(self.model.jnt_bodyid[self.model.joint(self._joint_names()[0]).id])

    def _joint_names(self) -> list[str]:
        return [servo.joint for servo in self.part.servos if servo.joint]

    def _arm_bodies(self) -> frozenset[int]:
        """The bodies that a joint of the part moves."""
        model = self.model
        moved = {int(model.jnt_bodyid[model.joint(name).id]) for name in self._joint_names()}
        for body in range(1, model.nbody):  # parents come first
            if int(model.body_parentid[body]) in moved:
                moved.add(body)
        return frozenset(moved)

    def _set_other_joints(self) -> None:
        """The key frame `start` if the model has one, then the start poses of the description."""
        model = self.model
        names = [model.key(i).name for i in range(model.nkey)]
        if _KEY in names:
            mujoco.mj_resetDataKeyframe(model, self.data, names.index(_KEY))
        for joint, value in _start_values(self.robot).items():
            try:
                self.data.qpos[self._qpos_address(joint)] = value
            except KeyError:
                continue  # joints of other parts need not be in the model

    def _qpos_address(self, joint: str) -> int:
        return int(self.model.joint(joint).qposadr[0])


def _start_values(robot: RobotDescription) -> Mapping[str, float]:
    """The start [rad or m] of all joints of a description."""
    values: dict[str, float] = {}
    for part in robot.parts:
        values |= {
            servo.joint: servo.start * UNITS[servo.unit] for servo in part.servos if servo.joint
        }
        values |= {joint.joint: joint.position for joint in part.fixed_joints}
    return values
