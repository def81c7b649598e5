"""The control loops of a board: position, velocity, torque and current for each joint.

In: the modes of the joints, and gains. Out: a bank of controllers that holds, for each joint, the
gains of the one that works now; those of currents are in `currents`. Gains are kept by kind,
whatever works.

| loop | error | output | what `feedforward` multiplies |
|---|---|---|---|
| position | rad | N m | the speed of the reference [rad/s] |
| velocity | rad/s | N m | the speed of the reference [rad/s] |
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
"""Of what the turning of a motor takes off its current so many parts in ten are made good at once,
and the rest within so long [s]."""


class Loop(StrEnum):
    """What is regulated; the values are YARP's short names."""

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
    """What works in a mode; nothing where a spring does, or where all is open."""
    if mode in POSITIONED and interaction is Interaction.COMPLIANT:
        return None
    return _OF_MODES.get(mode, Loop.POSITION if mode in POSITIONED else None)


def default_gains(spec: BoardSpec) -> dict[Loop, list[Gains]]:
    """In proportion to the joint's torque t, all of it at 0.1 rad of error.

    The integral of a speed is a way: the velocity controller is as stiff as the position
    controller. A torque is passed on as it is.
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
    """`gains` and `enabled` by kind; `bank` regulates by those that `use` has chosen."""

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
        """Switch controllers on or off; the output of one that is off is 0."""
        self.enabled[loop][joints] = on
        self._load()

    def use(self, active: Sequence[Loop | None]) -> None:
        """The active loop of each joint, if any."""
        self.active = list(active)
        self._load()

    def works(self, loop: Loop) -> Bools:
        """Where this kind is in use, (n,)."""
        return np.array([active is loop for active in self.active], bool)

    def reset(self, loop: Loop, joints: Ints) -> None:
        """Reset the integrals of the controllers of this loop."""
        self.bank.reset(joints[self.works(loop)[joints]])

    def _load(self) -> None:
        gains = [self.gains[active or Loop.POSITION][i] for i, active in enumerate(self.active)]
        # currents are regulated by motors, apart from the bank
        banked = [None if active is Loop.CURRENT else active for active in self.active]
        works = [
            active is not None and bool(self.enabled[active][i]) for i, active in enumerate(banked)
        ]
        self.bank.configure(gains, np.array(works, bool))
