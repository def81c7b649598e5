"""The share of withdrawals that move the touched place towards the finger, for both laws.

Positions come from MuJoCo with joint angles that are set here by name (equation 1), apart from the
kinematics that the laws use. `python -m tests.touch.withdrawal_shares` prints the table of the
docs.
"""

from __future__ import annotations

import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.simulation.models.body_model import BodyModel
from robocomp_dsl.simulation.models.model_file import load_model
from robocomp_dsl.simulation.robots.catalog import description
from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.description.model import GenericPart, RobotDescription
from robocomp_dsl.tactile.reflex.law import Field, Response, Stimulus
from robocomp_dsl.tactile.reflex.pose_directions import PoseDirections
from robocomp_dsl.tactile.reflex.withdrawal import ArmProperties, Withdrawal, initial
from robocomp_dsl.tactile.reflex.withdrawal_laws import FixedLaw, PoseLaw, WithdrawalLaw
from tests.touch.own_robots import OWN_ROBOTS, SIDES, write_robot

SHIPPED = ("nao_h25", "icub_v2")
ROBOTS = (*SHIPPED, *OWN_ROBOTS)
RANGES = {"0.2 rad": 0.2, "0.6 rad": 0.6, "all poses": np.inf}
"""Largest distance of a joint from the start pose."""
TOWARDS = -1e-6
STILL = 2e-3
"""A place that moves less than this does not leave the finger [m]."""


@dataclass(frozen=True, eq=False)
class Touch:
    """A touch in `field` at `point` (3,); `inward` (3,) points into the limb. In its frame."""

    field: Field
    point: Floats
    inward: Floats


class RobotPart:
    """One arm of a robot, with both laws."""

    def __init__(self, robot: RobotDescription, side: str) -> None:
        assert robot.model_file is not None
        self.model: Any = load_model(robot.model_file).model
        self.data = mujoco.MjData(self.model)
        self.part: GenericPart = robot.part(side)
        self.body = BodyModel(robot, side, self.model)
        self.data.qpos[:] = self.body.data.qpos
        part, mapping = self.part, self.part.mapping
        low, high = mapping.limits
        self.arm = ArmProperties(low, high, part.speed_limits, part.start, mapping.available)
        self.laws: dict[str, WithdrawalLaw] = {
            "fixed": FixedLaw(),
            "pose": PoseLaw(PoseDirections(self.body)),
        }

    def place(self, touch: Touch, angles: Floats) -> tuple[Floats, Floats]:
        """The touched point and the direction into the limb, in the world."""
        for servo, angle in zip(self.part.servos, angles, strict=True):
            if servo.joint:
                device = (angle - servo.sigma) / servo.gamma
                unit = np.deg2rad(1.0) if servo.unit == "deg" else 1.0
                self.data.joint(servo.joint).qpos[0] = device * unit
        mujoco.mj_kinematics(self.model, self.data)
        limb = self.part.limb(touch.field.limb)
        body = self.data.body(limb.body)
        rotation = body.xmat.reshape(3, 3) @ limb.axes
        place = body.xpos + body.xmat.reshape(3, 3) @ limb.origin + rotation @ touch.point
        return place, rotation @ touch.inward

    def withdrawal(self, law: str, touch: Touch, pose: Floats) -> Withdrawal:
        """The withdrawal of full strength."""
        response = Response(touch.field, Stimulus(touch.point, 1.0), 0.0, 1.0, touch.inward)
        return self.laws[law].extend(initial(pose, 0.0), [response], pose, self.arm)

    def progress(self, law: str, touch: Touch, pose: Floats) -> float:
        """How far the touched place moves away from the finger [m]."""
        before, direction = self.place(touch, pose)
        after, _ = self.place(touch, self.withdrawal(law, touch, pose).goal)
        return float(direction @ (after - before))

    def random_touch(self, field: Field, rng: np.random.Generator) -> Touch:
        """A taxel that the field contains."""
        patches = [patch for patch in self.part.patches if patch.limb == field.limb]
        points = np.concatenate([patch.points for patch in patches])
        normals = np.concatenate([patch.normals for patch in patches])
        near = np.flatnonzero(np.linalg.norm(points - field.centre, axis=1) < field.radius)
        taxel = int(rng.choice(near))
        return Touch(field, points[taxel], -normals[taxel])

    def random_pose(self, rng: np.random.Generator, distance: float = np.inf) -> Floats:
        low = np.maximum(self.arm.low, self.arm.start - distance)
        high = np.minimum(self.arm.high, self.arm.start + distance)
        pose: Floats = rng.uniform(low, high)
        return pose


def load_part(name: str, side: str, folder: Path) -> RobotPart:
    robot = write_robot(name, folder) if name in OWN_ROBOTS else description(name)
    return RobotPart(robot, side)


@dataclass(frozen=True)
class Shares:
    """Shares of motions towards the touch, and of those that hardly move; median [m]."""

    towards: float
    still: float
    median: float


def shares(
    part: RobotPart, law: str, field: Field, count: int = 300, distance: float = np.inf
) -> Shares:
    """Over random poses in which the arm does not overlap the rest of the robot."""
    rng = np.random.default_rng(sum(map(ord, field.name)))
    progress = []
    while len(progress) < count:
        pose = part.random_pose(rng, distance)
        if part.body.clearance(pose, 0.0) >= 0.0:
            progress.append(part.progress(law, part.random_touch(field, rng), pose))
    moved = np.array(progress)
    return Shares(
        float((moved < TOWARDS).mean()), float((moved < STILL).mean()), float(np.median(moved))
    )


def main() -> None:
    """Print one row per robot, arm, field and range of poses."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 300
    write = sys.stdout.write
    write("| robot | arm | field | poses within | `fixed`: towards | `pose`: towards | median |\n")
    write("|---|---|---|---|---|---|---|\n")
    with tempfile.TemporaryDirectory() as folder:
        for name in ROBOTS:
            for side in SIDES:
                part = load_part(name, side, Path(folder))
                for field in part.part.fields:
                    for label, distance in RANGES.items():
                        fixed = shares(part, "fixed", field, count, distance)
                        pose = shares(part, "pose", field, count, distance)
                        write(
                            f"| {name} | {side} | {field.name} | {label} | {fixed.towards:.1%}"
                            f" | {pose.towards:.1%} |"
                            f" {1e3 * fixed.median:.0f} / {1e3 * pose.median:.0f} mm |\n"
                        )


if __name__ == "__main__":
    main()
