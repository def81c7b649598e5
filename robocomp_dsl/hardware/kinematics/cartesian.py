"""Chains of joints in a transform tree, and the goals that a Cartesian controller solves for them.

In: a chain of joints in a transform tree, and a pose, shape (4, 4), or a position, shape (3,), in
mm. Out: joint angles (n,) [rad] within the limits, and the remaining error of the tip.
The solver is that of `tactile.arm.inverse`.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.description.scene import ROOT
from robocomp_dsl.hardware.devices.errors import CommandRefused
from robocomp_dsl.hardware.kinematics.jacobian import jacobian
from robocomp_dsl.hardware.kinematics.rotations import Matrix
from robocomp_dsl.hardware.kinematics.transforms import TransformTree
from robocomp_dsl.tactile.arm.inverse import Goal, Solution, Solver, Tolerance, damped_step

Floats = NDArray[np.float64]

LEVER = 100.0
"""An orientation error of 1 rad counts as much as this distance [mm]."""


@dataclass(frozen=True, eq=False)
class JointChain:
    """`joints` are hinges of `tree`, from `base` to `tip`; `low`, `high`, `rest` are (n,) [rad].

    The chain owns its tree and moves the joints in it to evaluate poses. `held` maps the names of
    other joints that move the tip to their frames; they stay at the value set by `fix_joint`.
    """

    tree: TransformTree
    joints: tuple[str, ...]
    tip: str
    low: Floats
    high: Floats
    rest: Floats
    base: str = ROOT
    held: dict[str, str] = field(default_factory=dict)

    def set_positions(self, q: Floats) -> None:
        """Move the joints in the tree to `q` (n,)."""
        for joint, angle in zip(self.joints, q.tolist(), strict=True):
            self.tree.set_joint(joint, angle)

    def fix_joint(self, joint: str, angle: float) -> None:
        """Set the position of a joint that moves the tip but does not belong to the chain."""
        if joint in self.held:
            self.tree.set_joint(self.held[joint], angle)

    def pose(self, q: Floats) -> Matrix:
        """Pose of the tip in the base at `q`, shape (4, 4)."""
        self.set_positions(q)
        return self.tree.matrix(self.tip, self.base)

    def pose_and_jacobian(self, angles: Floats) -> tuple[Matrix, Matrix]:
        """Pose of the tip (4, 4) at `angles` (n,), and its Jacobian (6, n) in mm and rad."""
        pose = self.pose(angles)
        return pose, jacobian(self.tree, self.joints, self.tip, base=self.base)

    def is_out_of_reach(self, point: Floats) -> bool:  # noqa: ARG002 - of the Protocol
        """Always False: the lengths of the links are unknown, so every start is tried."""
        return False


def goal_of(goal: object) -> Goal:
    """A `Goal` from a pose (4, 4) or a position (3,) [mm]. Raises `CommandRefused`."""
    try:
        numbers = np.asarray(goal, dtype=float)
    except (TypeError, ValueError):
        raise CommandRefused("a goal consists of numbers") from None
    if numbers.shape not in ((3,), (4, 4)):
        raise CommandRefused(f"a goal has the shape (3,) or (4, 4), not {numbers.shape}")
    if not np.isfinite(numbers).all():
        raise CommandRefused("the goal holds NaN or infinity")
    if numbers.ndim == 1:
        return Goal(numbers)
    orientation = numbers[:3, :3]
    deviation = np.abs(orientation @ orientation.T - np.eye(3)).max()
    if deviation > 1e-6 or np.linalg.det(orientation) < 0.0:
        raise CommandRefused("the goal has no orientation: its upper 3 x 3 is no rotation matrix")
    return Goal(numbers[:3, 3].copy(), orientation.copy())


def step(chain: JointChain, q: Floats, goal: Goal, pull: Floats, damping: float) -> Floats:
    """One damped least-squares step (n,) from `q` (n,) towards `goal`, within the limits.

    `pull` (n,) moves the joints within the null space of the goal.
    """
    pose, matrix = chain.pose_and_jacobian(q)
    error = goal.error(pose, LEVER)
    matrix[:3] /= LEVER
    limits = chain.low - q, chain.high - q
    return damped_step(matrix[: len(error)], error, pull, damping, limits)


def solve(
    chain: JointChain, goal: Goal, start: Floats, *, distance: float = 0.1, angle: float = 0.002
) -> Solution:
    """The best solution, from `start` and, if that fails, from other postures.

    It is deterministic. The caller checks with `within` whether it reaches the goal; the search
    ends once the goal is reached within `distance` [mm] and `angle` [rad].
    """
    tolerance = Tolerance(distance, angle)
    solver = Solver(chain, chain.low, chain.high, tolerance, LEVER, chain.rest)
    return solver.nearest(goal, start)
