"""Commands to a control board, each accepted only in its control modes.

In: joints by name or number, values in SI units (duty cycles in percent). A command is executed for
all its joints or rejected for all, with a typed error; positions are clipped to the limits, and
the result says which.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.errors import NoSpeed, NotEquipped, WrongMode
from robocomp_dsl.hardware.control.joints import Bools, Floats, Ints, numbers
from robocomp_dsl.hardware.control.modes import Interaction, Mode

Joints: TypeAlias = Sequence[str] | Sequence[int] | Ints | None
"""Selects joints: names, numbers, or None for all."""

Values: TypeAlias = Sequence[float] | Floats | float


class Commands:
    """The commands of a board."""

    def __init__(self, board: Board) -> None:
        self._board = board

    def set_mode(self, joints: Joints, mode: Mode | Sequence[Mode]) -> None:
        """Request control modes, one for all joints or one per joint."""
        chosen = self._board.select.indices(joints)
        requested = [mode] * len(chosen) if isinstance(mode, Mode) else list(mode)
        numbers("modes", np.zeros(len(requested)), len(chosen))
        self._board.set_modes(chosen, requested)

    def set_interaction(self, joints: Joints, mode: Interaction) -> None:
        """Make joints stiff or compliant, independent of the control mode."""
        chosen = self._board.select.indices(joints)
        self._board.set_interactions(chosen, [mode] * len(chosen))

    def position_move(self, joints: Joints, goal: Values) -> Bools:
        """Minimum-jerk motion to `goal` [rad] at the reference speed; which goals were clipped."""
        chosen = self._in(joints, "position_move", Mode.POSITION, Mode.MIXED)
        return self._move(chosen, numbers("goal", goal, len(chosen)))

    def relative_move(self, joints: Joints, way: Values) -> Bools:
        """Minimum-jerk motion by `way` [rad] from the current reference."""
        chosen = self._in(joints, "relative_move", Mode.POSITION, Mode.MIXED)
        here = self._board.references.trajectory.position[chosen]
        return self._move(chosen, here + numbers("way", way, len(chosen)))

    def set_position(self, joints: Joints, position: Values) -> Bools:
        """Follow `position` [rad] without a trajectory; for streams of small steps."""
        chosen = self._in(joints, "set_position", Mode.POSITION_DIRECT)
        values = numbers("position", position, len(chosen))
        allowed, clipped = self._board.limits.clip(chosen, values)
        self._board.references.set_position(chosen, allowed)
        return clipped

    def velocity_move(self, joints: Joints, velocity: Values, hold: float = np.inf) -> Bools:
        """Move at `velocity` [rad/s] for `hold` seconds; returns which were clipped."""
        chosen = self._in(joints, "velocity_move", Mode.VELOCITY, Mode.MIXED)
        values = numbers("velocity", velocity, len(chosen))
        most = self._board.limits.speed[chosen]
        allowed = np.clip(values, -most, most)
        self._board.references.set_velocity(chosen, allowed, hold)
        clipped: Bools = allowed != values
        return clipped

    def set_velocity(self, joints: Joints, velocity: Values) -> Bools:
        """Move at `velocity` [rad/s] without a ramp; returns which were clipped."""
        chosen = self._in(joints, "set_velocity", Mode.VELOCITY_DIRECT)
        values = numbers("velocity", velocity, len(chosen))
        most = self._board.limits.speed[chosen]
        allowed = np.clip(values, -most, most)
        self._board.references.set_velocity_direct(chosen, allowed)
        clipped: Bools = allowed != values
        return clipped

    def set_torque(self, joints: Joints, torque: Values) -> Bools:
        """Reference torques [N m]; returns which were clipped."""
        chosen = self._in(joints, "set_torque", Mode.TORQUE)
        for joint in chosen.tolist():
            spec = self._board.spec.joints[joint]
            if not spec.torque_control:
                raise NotEquipped(f"`{spec.name}` has no torque control")
        most = self._board.limits.torque[chosen]
        return self._store(
            self._board.law.torque, chosen, numbers("torque", torque, len(chosen)), most
        )

    def set_duty(self, motors: Joints, duty: Values) -> Bools:
        """Duty cycles [%] of motors; returns which were clipped to +-100."""
        chosen = self._in(motors, "set_duty", Mode.PWM)
        values = numbers("duty", duty, len(chosen))
        return self._store(self._board.law.duty, chosen, values, np.full(len(chosen), 100.0))

    def set_current(self, motors: Joints, current: Values) -> Bools:
        """Currents [A] of motors; returns which were clipped to the maximum."""
        chosen = self._in(motors, "set_current", Mode.CURRENT)
        values = numbers("current", current, len(chosen))
        most = self._board.motors.max_current[chosen]
        return self._store(self._board.law.current, chosen, values, most)

    def stop(self, joints: Joints = None) -> None:
        """Stop motions: trajectories end at the current reference, velocities ramp down."""
        self._board.references.stop(self._board.select.indices(joints))

    def motion_done(self, joints: Joints = None) -> Bools:
        """Whether the trajectories of `joints` have ended."""
        done: Bools = ~self._board.references.trajectory.moving[self._board.select.indices(joints)]
        return done

    def _move(self, joints: Ints, goal: Floats) -> Bools:
        speeds = self._board.references.reference_speed[joints]
        if (speeds <= 0.0).any():
            name = self._board.spec.names[joints[int(np.argmin(speeds))]]
            raise NoSpeed(f"`{name}` has the reference speed 0: it would never arrive")
        allowed, clipped = self._board.limits.clip(joints, goal)
        self._board.references.move(joints, allowed, self._board.dt)
        return clipped

    def _in(self, joints: Joints, command: str, *modes: Mode) -> Ints:
        """The joints, if all of them accept this command now."""
        chosen = self._board.select.indices(joints)
        for joint in chosen.tolist():
            present = self._board.table.modes[joint]
            if present not in modes:
                name, takes = self._board.spec.names[joint], " or ".join(f"`{m}`" for m in modes)
                raise WrongMode(f"`{name}` is in mode `{present}`; `{command}` needs {takes}")
        return chosen

    def _store(self, into: Floats, joints: Ints, values: Floats, most: Floats) -> Bools:
        allowed = np.minimum(np.maximum(values, -most), most)
        self._board.set_streamed_reference(into, joints, allowed)
        clipped: Bools = allowed != values
        return clipped
