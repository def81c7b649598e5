"""The control loops of a board: position, velocity, torque and current for each joint.

In: the modes of the joints, and gains. Out: a bank of controllers with the gains of the active loop
of each joint; current controllers are in `currents`. Gains are stored per loop, active or not.

| loop | error | output | what `feedforward` multiplies |
|---|---|---|---|
| position | rad | N m | the reference speed [rad/s] |
| velocity | rad/s | N m | the reference speed [rad/s] |
| torque | N m | N m | the reference [N m] |
| current | A, of the motor | %, of its supply | the reference [A] |
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum

import numpy as np

from robocomp_dsl.hardware.control.joints import BoardSpec, Bools, Ints
from robocomp_dsl.hardware.control.modes import POSITIONED, Interaction, Mode
from robocomp_dsl.hardware.control.regulators.pid import Gains, PidBank

CURRENT_GAIN, CURRENT_TIME = 9.0, 0.001
"""The back EMF's share of the current that is compensated immediately, in tenths, and the time
constant of the rest [s]."""


class Loop(StrEnum):
    """The controlled quantity; the values are YARP's short names."""

    POSITION = "pos1"
    VELOCITY = "vel1"
    TORQUE = "trq1"
    CURRENT = "cur1"


_OF_MODES = {
    Mode.VELOCITY: Loop.VELOCITY,
    Mode.VELOCITY_DIRECT: Loop.VELOCITY,
    Mode.TORQUE: Loop.TORQUE,
    Mode.CURRENT: Loop.CURRENT,
}


def loop_of(mode: Mode, interaction: Interaction) -> Loop | None:
    """The active loop of a mode; none for a spring or an open loop."""
    if mode in POSITIONED and interaction is Interaction.COMPLIANT:
        return None
    return _OF_MODES.get(mode, Loop.POSITION if mode in POSITIONED else None)


def default_gains(spec: BoardSpec) -> dict[Loop, list[Gains]]:
    """Default gains in proportion to the torque limit t, which is reached at 0.1 rad of error.

    The integral of a speed is a distance: the velocity controller is as stiff as the position
    controller. The torque controller passes its reference on.
    """
    torques = [joint.torque_limit for joint in spec.joints]
    percents = [100.0 * motor.resistance / motor.supply for motor in spec.motors]
    return {
        Loop.POSITION: [
            Gains(10 * t, 20 * t, 0.5 * t, max_output=t, max_integral=0.5 * t) for t in torques
        ],
        Loop.VELOCITY: [Gains(0.5 * t, 10 * t, max_output=t, max_integral=t) for t in torques],
        Loop.TORQUE: [Gains(max_output=t, max_integral=t, feedforward=1.0) for t in torques],
        Loop.CURRENT: [
            Gains(
                CURRENT_GAIN * percent,
                (CURRENT_GAIN + 1.0) * percent / CURRENT_TIME,
                max_output=100.0,
                max_integral=100.0,
                feedforward=percent,
            )
            for percent in percents
        ],
    }


class ControlLoops:
    """`gains` and `enabled` by loop; `bank` has the controllers that `use` has selected."""

    def __init__(self, spec: BoardSpec) -> None:
        n = len(spec.joints)
        self.gains = default_gains(spec)
        self.enabled: dict[Loop, Bools] = {loop: np.ones(n, bool) for loop in Loop}
        self.active: list[Loop | None] = [Loop.POSITION] * n
        self.bank = PidBank(self.gains[Loop.POSITION])

    def set(self, loop: Loop, joint: int, gains: Gains) -> None:
        """Set the gains of one controller."""
        self.gains[loop][joint] = gains
        self._load()

    def enable(self, loop: Loop, joints: Ints, *, on: bool) -> None:
        """Enable or disable controllers; a disabled one outputs 0."""
        self.enabled[loop][joints] = on
        self._load()

    def use(self, active: Sequence[Loop | None]) -> None:
        """The active loop of each joint, if any."""
        self.active = list(active)
        self._load()

    def works(self, loop: Loop) -> Bools:
        """Joints with this active loop, (n,)."""
        return np.array([active is loop for active in self.active], bool)

    def reset(self, loop: Loop, joints: Ints) -> None:
        """Reset the integrals of the controllers of this loop."""
        self.bank.reset(joints[self.works(loop)[joints]])

    def _load(self) -> None:
        gains = [self.gains[active or Loop.POSITION][i] for i, active in enumerate(self.active)]
        # currents have controllers per motor, outside the bank
        banked = [None if active is Loop.CURRENT else active for active in self.active]
        works = [
            active is not None and bool(self.enabled[active][i]) for i, active in enumerate(banked)
        ]
        self.bank.configure(gains, np.array(works, bool))
