"""Remote variables: named settings of a board, each a list of numbers.

In: a key and values. Out: values. A key defines the length of its list and the valid values.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from robocomp_dsl.hardware.control.board import Board
from robocomp_dsl.hardware.control.errors import BadValue, ControlRefused
from robocomp_dsl.hardware.control.joints import Floats, Ints, numbers
from robocomp_dsl.hardware.control.settings import ControlSettings


@dataclass(frozen=True, slots=True)
class Variable:
    """`write` is None for read-only variables."""

    read: Callable[[], Floats]
    write: Callable[[Floats], None] | None
    doc: str


class RemoteVariables:
    """The variables of `joints` of a board, or of all, by key."""

    def __init__(self, board: Board, joints: Ints | None = None) -> None:
        here = board.select.indices(joints)
        limits, motors, names = board.limits, board.motors, board.spec.names
        self.variables: dict[str, Variable] = {
            "speed_limits": Variable(
                lambda: limits.speed[here],
                lambda v: limits.set_speed(here, v),
                "largest joint speeds [rad/s]",
            ),
            "max_currents": Variable(
                lambda: motors.max_current[here],
                lambda v: motors.set_max_current(here, v),
                "motor currents that fault [A]",
            ),
            "tracking_limits": Variable(
                lambda: board.pid.error_limit[here],
                lambda v: board.pid.set_error_limits(here, v),
                "position errors that fault [rad]",
            ),
            "reference_timeout": Variable(
                lambda: np.array([board.watchdog.timeout]),
                None,
                "silence after which a pushed joint holds its place [s]",
            ),
            "gears": Variable(lambda: motors.gear[here], None, "motor turns per joint turn"),
            "temperatures": Variable(
                lambda: motors.temperature[here], None, "of the motors [degC]"
            ),
        }
        self.variables |= {f"pid.{names[i]}": _gains(board, i) for i in here.tolist()}

    def keys(self) -> list[str]:
        """All keys, sorted."""
        return sorted(self.variables)

    def get(self, key: str) -> Floats:
        """The values of `key`; raises `BadValue` for an unknown key."""
        return np.array(self._find(key).read())

    def set(self, key: str, values: object) -> None:
        """Write `values`; raises `BadValue` for an unknown key or invalid values."""
        variable = self._find(key)
        if variable.write is None:
            raise ControlRefused(f"`{key}` can only be read")
        variable.write(numbers(key, values, len(variable.read())))

    def _find(self, key: str) -> Variable:
        if key not in self.variables:
            raise BadValue(f"there is no variable `{key}`: " + ", ".join(self.keys()))
        return self.variables[key]


def _gains(board: Board, joint: int) -> Variable:
    """The position PID of one joint as kp, ki, kd, offset."""
    settings = ControlSettings(board)

    def read() -> Floats:
        g = settings.pid(joint)
        return np.array([g.kp, g.ki, g.kd, g.offset])

    def write(values: Floats) -> None:
        kp, ki, kd, offset = (float(value) for value in values)
        settings.set_pid(joint, replace(settings.pid(joint), kp=kp, ki=ki, kd=kd, offset=offset))

    return Variable(read, write, "position PID: kp, ki, kd, offset")
