"""Inverse kinematics of an arm: which joint angles bring its hand to a pose.

In: a chain of joints in a transform tree, and a pose, shape (4, 4), or a place, shape (3,), in mm.
Out: joint angles (n,) [rad] within the limits, and how far from the goal they leave the hand.

Damped least squares on the geometric Jacobian, the damping in proportion to the squared error
(Sugihara, "Solvability-unconcerned inverse kinematics by the Levenberg-Marquardt method", IEEE
Trans. Robotics 27(5), 2011). What the goal leaves free draws the arm to a posture of rest.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.errors import CommandRefused
from robocomp_dsl.hardware.jacobian import jacobian
from robocomp_dsl.hardware.rotations import Matrix
from robocomp_dsl.hardware.scene import ROOT
from robocomp_dsl.hardware.transforms import TransformTree

Floats = NDArray[np.float64]

LEVER = 100.0
"""A turn by 1 rad counts as much as this way [mm]."""

LEAST_DAMPING = 1e-6

WEAK = 0.01
"""A motion of the joints that moves the tip by less, per rad, counts as free of the goal."""

STEPS = 150
STARTS = 10
"""So many postures are tried as beginnings: the given one, rest, then others drawn at random."""


@dataclass(frozen=True, eq=False)
class Chain:
    """`joints` are hinges of `tree`, from `base` to `tip`; `low`, `high`, `rest` are (n,) [rad].

    The tree is the chain's own: its joints are moved about in search of solutions. `held` are other
    joints that move the tip, by name, and their frames: they stay where `hold` has put them.
    """

    tree: TransformTree
    joints: tuple[str, ...]
    tip: str
    low: Floats
    high: Floats
    rest: Floats
    base: str = ROOT
    held: dict[str, str] = field(default_factory=dict)

    def put(self, q: Floats) -> None:
        """Bring the joints to `q`."""
        for joint, angle in zip(self.joints, q.tolist(), strict=True):
            self.tree.set_joint(joint, angle)

    def hold(self, joint: str, angle: float) -> None:
        """Tell where a joint is that moves the tip and does not belong to the chain."""
        if joint in self.held:
            self.tree.set_joint(self.held[joint], angle)

    def pose(self, q: Floats) -> Matrix:
        """Where the tip is in the base at `q`, shape (4, 4)."""
        self.put(q)
        return self.tree.matrix(self.tip, self.base)

    def jacobian(self) -> Matrix:
        """Of the tip, where the joints are now, in units of `LEVER`; shape (6, n)."""
        made = jacobian(self.tree, self.joints, self.tip, base=self.base)
        made[:3] /= LEVER
        return made


@dataclass(frozen=True, eq=False, slots=True)
class Goal:
    """A place [mm] and, unless None, a turn, shape (3, 3)."""

    place: Floats
    turn: Matrix | None = None

    def error(self, pose: Matrix) -> Floats:
        """What is missing from `pose`, in units of `LEVER`; shape (6,), or (3,) of a place."""
        way: Floats = (self.place - pose[:3, 3]) / LEVER
        if self.turn is None:
            return way
        return np.concatenate((way, rotation_vector(self.turn @ pose[:3, :3].T)))


@dataclass(frozen=True, eq=False, slots=True)
class Solution:
    """Joint angles, and how far from the goal they leave the hand [mm, rad]."""

    q: Floats
    distance: float
    angle: float

    def within(self, distance: float, angle: float) -> bool:
        """Whether the goal is reached to `distance` [mm] and `angle` [rad]."""
        return self.distance <= distance and self.angle <= angle


def goal_of(goal: object) -> Goal:
    """A `Goal` from a pose (4, 4) or a place (3,). Raises `CommandRefused`."""
    try:
        given = np.asarray(goal, dtype=float)
    except (TypeError, ValueError):
        raise CommandRefused("a goal is made of numbers") from None
    if given.shape not in ((3,), (4, 4)):
        raise CommandRefused(f"a goal has the shape (3,) or (4, 4), not {given.shape}")
    if not np.isfinite(given).all():
        raise CommandRefused("the goal holds NaN or infinity")
    if given.ndim == 1:
        return Goal(given)
    turn = given[:3, :3]
    if np.abs(turn @ turn.T - np.eye(3)).max() > 1e-6 or np.linalg.det(turn) < 0.0:
        raise CommandRefused("the goal does not turn the hand: its matrix is no rotation")
    return Goal(given[:3, 3].copy(), turn.copy())


def rotation_vector(turn: Matrix) -> Floats:
    """The axis of a rotation times its angle, shape (3,); the angle is from 0 to pi."""
    skew = turn - turn.T
    vector = 0.5 * np.array([skew[2, 1], skew[0, 2], skew[1, 0]])
    sine, cosine = float(np.linalg.norm(vector)), (float(np.trace(turn)) - 1.0) / 2.0
    if sine > 1e-8:
        return vector * (math.atan2(sine, cosine) / sine)
    if cosine > 0.0:
        return vector
    columns = turn + np.eye(3)  # a half turn: each column lies along the axis
    axis = columns[:, int(np.argmax(np.linalg.norm(columns, axis=0)))]
    made: Floats = axis * (math.pi / float(np.linalg.norm(axis)))
    return made


def step(chain: Chain, q: Floats, error: Floats, pull: Floats, damping: float) -> Floats:
    """One step of damped least squares at `q`, (n,); `chain` must be there already.

    `pull` (n,) is where the joints may go as far as `error` leaves them free. A joint that would
    pass a limit is brought to it, and the others do the rest.
    """
    matrix = chain.jacobian()[: len(error)]
    made, free = np.zeros(len(q)), np.ones(len(q), bool)
    while free.any():
        left, strength, right = np.linalg.svd(matrix * free, full_matrices=False)
        gain = strength / (strength * strength + damping)
        bound = right[strength > WEAK]
        pulled = pull * free
        wished = made + right.T @ (gain * (left.T @ (error - matrix @ made)))
        wished += pulled - bound.T @ (bound @ pulled)
        past = free & ((q + wished > chain.high) | (q + wished < chain.low))
        if not past.any():
            return np.where(free, wished, made)
        made = np.where(past, np.clip(q + wished, chain.low, chain.high) - q, made)
        free &= ~past
    return made


def solve(
    chain: Chain, goal: Goal, start: Floats, *, distance: float = 0.1, angle: float = 0.002
) -> Solution:
    """The best found; from `start` and, if that does not lead there, from other postures.

    Given the same chain, goal and start it is always the same. Whether it reaches the goal to
    `distance` [mm] and `angle` [rad] the caller asks by `within`.
    """
    random = np.random.default_rng(0)
    span = chain.high - chain.low
    starts = [start, chain.rest]
    starts += [chain.low + span * random.random(len(span)) for _ in range(STARTS - 2)]
    best = None
    for one in starts:
        found = _descend(chain, goal, np.clip(one, chain.low, chain.high), distance, angle)
        if found.within(distance, angle):
            return found
        if best is None or _cost(found) < _cost(best):
            best = found
    assert best is not None  # noqa: S101  there is always a first start
    return best


def _descend(chain: Chain, goal: Goal, q: Floats, distance: float, angle: float) -> Solution:
    best = _judged(chain, goal, q)
    # posture counts while the arm is on its way, and fades so that the end is exact
    for k in range(STEPS):
        error = goal.error(chain.pose(q))
        squared = float(error @ error)
        pull = 0.1 * (1.0 - k / STEPS) * (chain.rest - q)
        q = q + step(chain, q, error, pull, 0.5 * squared + LEAST_DAMPING)
        found = _judged(chain, goal, q)
        if _cost(found) < _cost(best):
            best = found
        if best.within(0.1 * distance, 0.1 * angle):
            break
    return replace(best, q=best.q.copy())


def _judged(chain: Chain, goal: Goal, q: Floats) -> Solution:
    error = goal.error(chain.pose(q))
    return Solution(q, float(np.linalg.norm(error[:3])) * LEVER, float(np.linalg.norm(error[3:])))


def _cost(solution: Solution) -> float:
    return math.hypot(solution.distance / LEVER, solution.angle)
