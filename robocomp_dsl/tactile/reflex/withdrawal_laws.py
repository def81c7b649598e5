"""The laws that turn responses into the goal of a withdrawal: `pose` and `fixed`.

In: a withdrawal, further responses, the pose, the limits of the arm. Out: the extended withdrawal.
`FixedLaw` is equation 6 of Ma and Dahl (2016): each field moves by its own vector, whatever the
pose. `PoseLaw` keeps the length of that vector and moves away from the contact at the current pose.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.reflex.law import Response
from robocomp_dsl.tactile.reflex.pose_directions import Contact, PoseDirections
from robocomp_dsl.tactile.reflex.withdrawal import (
    ArmProperties,
    LimitCause,
    Withdrawal,
    add_responses,
)

_LEAST_SHARE = 0.2
"""A motion that joint limits reduce to less than this share is replaced."""


class WithdrawalLaw(Protocol):
    """Extends a withdrawal by responses that were felt at `pose` (n,)."""

    def extend(
        self,
        withdrawal: Withdrawal,
        responses: Iterable[Response],
        pose: Floats,
        arm: ArmProperties,
    ) -> Withdrawal:
        """The withdrawal with further responses; `limit` says what made it smaller."""

    def motion(self, response: Response, withdrawal: Withdrawal, pose: Floats) -> Floats:
        """The displacements (n,) [rad] that a response at `pose` (n,) caused."""


@dataclass(frozen=True, slots=True)
class PoseLaw:
    """Moves away from all contacts at the current pose; see `PoseDirections`."""

    directions: PoseDirections

    def extend(
        self,
        withdrawal: Withdrawal,
        responses: Iterable[Response],
        pose: Floats,
        arm: ArmProperties,
    ) -> Withdrawal:
        """The withdrawal with further responses; `limit` says what made it smaller.

        A field that responds more strongly during the withdrawal moves the arm by the difference.
        """
        after = add_responses(withdrawal, responses, arm)
        if after.strongest == withdrawal.strongest:
            return withdrawal
        origins = {name: withdrawal.felt_at.get(name, pose) for name in after.strongest}
        contacts = [
            contact
            for name, response in after.strongest.items()
            if (contact := _contact(response, float(np.linalg.norm(pose - origins[name]))))
        ]
        plan = self.directions.plan(pose, contacts, arm)
        return replace(after, goal=plan.goal, felt_at=origins, limit=plan.limit)

    def motion(self, _response: Response, withdrawal: Withdrawal, pose: Floats) -> Floats:
        """The displacements (n,) [rad] from `pose` (n,), by all touches together."""
        moved: Floats = withdrawal.goal - pose
        return moved


@dataclass(frozen=True, slots=True)
class FixedLaw:
    """Adds the vectors of all fields. With `directions`, it avoids the robot's own body.

    A field whose joints are all at their limits moves the remaining joints, as in `PoseLaw`.
    """

    directions: PoseDirections | None = None

    def extend(
        self,
        withdrawal: Withdrawal,
        responses: Iterable[Response],
        pose: Floats,
        arm: ArmProperties,
    ) -> Withdrawal:
        """The withdrawal with further responses; `limit` says what made it smaller."""
        after = add_responses(withdrawal, responses, arm)
        if after.strongest == withdrawal.strongest:
            return withdrawal
        stuck = [
            response
            for response in after.strongest.values()
            if _is_at_limits(response, withdrawal.origin, arm)
        ]
        after = replace(after, limit=LimitCause.JOINT_LIMITS if stuck else None)
        if self.directions is None:
            return after
        if stuck:
            contacts = [contact for response in stuck if (contact := _contact(response))]
            plan = self.directions.plan(after.goal, contacts, arm)
            after = replace(after, goal=plan.goal)
        free = self.directions.free_part(pose, after.goal)
        if free is not after.goal:
            after = replace(after, goal=free, limit=LimitCause.OWN_BODY)
        return after

    def motion(self, response: Response, _withdrawal: Withdrawal, _pose: Floats) -> Floats:
        """The displacements (n,) [rad] of equation 6."""
        return response.motion


def _contact(response: Response, moved: float = 0.0) -> Contact | None:
    """The contact of a response; `moved` [rad] of its motion is done. None if all is."""
    length = float(np.linalg.norm(response.motion)) - moved
    if length <= 0.0:
        return None
    field = response.field
    return Contact(field.limb, response.stimulus.centre, response.inward, length)


def _is_at_limits(response: Response, origin: Floats, arm: ArmProperties) -> bool:
    """Whether the joints that the field moves are all at their limits."""
    requested = np.where(arm.available, response.motion, 0.0)
    possible = arm.within(origin + requested, origin) - origin
    return bool(np.linalg.norm(possible) < _LEAST_SHARE * np.linalg.norm(requested))
