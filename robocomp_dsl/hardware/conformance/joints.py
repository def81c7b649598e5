"""Conformance rules for motors on a control board."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from robocomp_dsl.hardware.conformance.rule import (
    Advance,
    ConformanceRule,
    Violation,
    finite,
    require,
    require_later,
    rules,
)
from robocomp_dsl.hardware.control.errors import WrongMode
from robocomp_dsl.hardware.control.joints import Ints
from robocomp_dsl.hardware.control.modes import Mode

STEP = 0.1
"""Distance of the test motions [rad, m]."""

NEAR = 0.02
"""Permitted position error [rad, m]."""


class JointSubset(NamedTuple):
    """Some joints of a control board: `device` is the board, with its commands and settings."""

    device: Any
    names: Sequence[str]

    @property
    def at(self) -> Ints:
        """Their indices on the board."""
        found: Ints = self.device.board.select.indices(self.names)
        return found


def joints_are_measured_within_their_limits(motors: JointSubset, advance: Advance) -> None:
    """Positions and velocities are finite, and time advances."""
    advance(0.1)
    board, at = motors.device.board, motors.at
    state, limits = board.state(), board.limits
    position, slack = state.position[at], 0.05
    finite("position", position)
    finite("velocity", state.velocity[at])
    off = (position < limits.low[at] - slack) | (position > limits.high[at] + slack)
    require(not off.any(), f"beyond their limits: {', '.join(np.array(motors.names)[off])}")
    advance(0.1)
    require_later("state", state.time, board.time)


def idle_motors_give_no_torque(motors: JointSubset, advance: Advance) -> None:
    """In any previous mode."""
    motors.device.commands.set_mode(motors.names, Mode.IDLE)
    advance(0.1)
    torque = motors.device.board.state().torque[motors.at]
    require(not torque.any(), f"torques of idle motors: {torque} N·m")


def a_command_of_another_mode_is_refused(motors: JointSubset, advance: Advance) -> None:
    """A position command while idle."""
    device = motors.device
    device.commands.set_mode(motors.names, Mode.IDLE)
    advance(0.05)
    try:
        device.commands.position_move(motors.names, device.board.position[motors.at])
    except WrongMode:
        return
    raise Violation("a position is taken by idle motors")


def each_joint_goes_where_it_is_sent(motors: JointSubset, advance: Advance) -> None:
    """Move 0.1 rad (less if the range is short) towards the farther limit, and back."""
    device, at = motors.device, motors.at
    board, commands = device.board, device.commands
    start = board.state().position[at]
    above, below = board.limits.high[at] - start, start - board.limits.low[at]
    goal = start + np.where(above >= below, 1.0, -1.0) * np.minimum(STEP, np.maximum(above, below))
    commands.set_mode(motors.names, Mode.POSITION)
    for target in (goal, start):
        device.settings.set_reference_speed(motors.names, 0.2)
        commands.position_move(motors.names, target)
        advance(2.0)
        off = np.abs(board.state().position[at] - target)
        worst = int(off.argmax())
        message = f"`{motors.names[worst]}` is {off[worst]:.3f} from where it was sent"
        require(off[worst] < NEAR, message)
    commands.set_mode(motors.names, Mode.IDLE)


JOINTS = (
    *rules(
        joints_are_measured_within_their_limits,
        idle_motors_give_no_torque,
        a_command_of_another_mode_is_refused,
    ),
    ConformanceRule(each_joint_goes_where_it_is_sent, moves_robot=True),
)
