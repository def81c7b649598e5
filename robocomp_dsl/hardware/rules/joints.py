"""What motors on a control board keep to."""

from __future__ import annotations

from typing import Any

import numpy as np

from robocomp_dsl.hardware.control.errors import WrongMode
from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.hardware.rules.rule import Broken, Pass, Rule, finite, later, must, rules

STEP = 0.1
"""How far joints are sent [rad, m for none]."""


def joints_are_measured_within_their_limits(device: Any, passes: Pass) -> None:
    """Positions and velocities are numbers, n of them, and time goes on."""
    passes(0.1)
    state, limits = device.board.state(), device.board.limits
    finite("position", state.position)
    finite("velocity", state.velocity)
    slack = 0.05
    off = (state.position < limits.low - slack) | (state.position > limits.high + slack)
    names = ", ".join(np.array(device.board.spec.names)[off])
    must(not off.any(), f"beyond their limits: {names}")
    passes(0.1)
    later("state", state.time, device.board.time)


def idle_motors_give_no_torque(device: Any, passes: Pass) -> None:
    """Whatever they did before."""
    device.commands.set_mode(None, Mode.IDLE)
    passes(0.1)
    torque = device.board.state().torque
    must(not torque.any(), f"torques of idle motors: {torque} N·m")


def a_command_of_another_mode_is_refused(device: Any, passes: Pass) -> None:
    """A position while idle."""
    device.commands.set_mode(None, Mode.IDLE)
    passes(0.05)
    try:
        device.commands.position_move(None, device.board.position)
    except WrongMode:
        return
    raise Broken("a position is taken by idle motors")


def each_joint_goes_where_it_is_sent(device: Any, passes: Pass) -> None:
    """A tenth of a rad to the side where there is more room, and back."""
    board, commands = device.board, device.commands
    start = board.state().position
    low, high = board.limits.low, board.limits.high
    room_above = np.minimum(high, start + 1e3) - start >= start - np.maximum(low, start - 1e3)
    goal = np.clip(start + np.where(room_above, STEP, -STEP), low, high)
    commands.set_mode(None, Mode.POSITION)
    for target in (goal, start):
        device.settings.set_reference_speed(None, 0.2)
        commands.position_move(None, target)
        passes(2.0)
        off = np.abs(board.state().position - target)
        worst = int(off.argmax())
        said = f"`{board.spec.names[worst]}` is {off[worst]:.3f} from where it was sent"
        must(off[worst] < 0.02, said)
    commands.set_mode(None, Mode.IDLE)


JOINTS = (
    *rules(
        joints_are_measured_within_their_limits,
        idle_motors_give_no_torque,
        a_command_of_another_mode_is_refused,
    ),
    Rule(each_joint_goes_where_it_is_sent, moves=True),
)
