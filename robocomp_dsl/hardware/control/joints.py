"""Specification of a board: joints, motors, and the coupling between them. Data only."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.control.errors import BadValue, UnknownJoint

_LARGEST = 1e12
"""Maximum magnitude of any input, so that all computed values are finite."""

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class JointSpec:
    """One joint: limits [rad, rad/s, N m], defaults [rad/s, rad/s²] and its equipment."""

    name: str
    low: float
    high: float
    speed_limit: float
    torque_limit: float
    reference_speed: float = 0.17453292519943295
    acceleration: float = 10.0
    prismatic: bool = False
    torque_control: bool = True
    calibrated: bool = True


@dataclass(frozen=True, slots=True)
class MotorSpec:
    """One motor with its gear.

    `gear` is motor turns per joint turn, `counts` encoder counts per motor turn; `torque_constant`
    [N m/A], `resistance` [ohm], `supply` [V] and `max_current` [A] are those of the motor.
    """

    name: str
    gear: float = 100.0
    counts: float = 4096.0
    torque_constant: float = 0.02
    resistance: float = 1.0
    supply: float = 24.0
    max_current: float = 5.0
    temperature_limit: float = 85.0


@dataclass(frozen=True, eq=False)
class BoardSpec:
    """The n joints of a board, its n motors; motor angle = gear * coupling @ joint angle.

    `coupling` (n, n) is the identity unless joints share motors; joints with mixed rows form a set
    and change their mode together.
    """

    joints: tuple[JointSpec, ...]
    motors: tuple[MotorSpec, ...]
    coupling: Floats = field(default_factory=lambda: np.empty((0, 0)))

    def __post_init__(self) -> None:
        n = len(self.joints)
        if not self.coupling.size:
            object.__setattr__(self, "coupling", np.eye(n))
        if len(self.motors) != n or self.coupling.shape != (n, n):
            raise BadValue(f"{n} joints need as many motors and a coupling of {n} x {n}")
        if not _reverses(self.coupling):
            raise BadValue("the coupling cannot be turned round: some joint has no motor")

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Joint names in the order of all arrays."""
        return tuple(joint.name for joint in self.joints)

    @cached_property
    def prismatic(self) -> Bools:
        """Which joints are prismatic, (n,)."""
        return np.array([joint.prismatic for joint in self.joints])

    def part(self, names: Sequence[str]) -> BoardSpec:
        """The joints `names` with their motors, in that order. Raises `UnknownJoint`."""
        at = Selector(self.names).indices(names)
        pick = at.tolist()
        return BoardSpec(
            tuple(self.joints[i] for i in pick),
            tuple(self.motors[i] for i in pick),
            self.coupling[np.ix_(at, at)],
        )

    def column(self, name: str) -> Floats:
        """One attribute of every joint, (n,)."""
        return np.array([float(getattr(joint, name)) for joint in self.joints])

    def motor_column(self, name: str) -> Floats:
        """One attribute of every motor, (n,)."""
        return np.array([float(getattr(motor, name)) for motor in self.motors])

    def coupled(self, joint: int) -> Ints:
        """All joints that share motors with `joint`, including itself, ascending."""
        return self._coupled_blocks[joint]

    @cached_property
    def _coupled_blocks(self) -> list[Ints]:
        """The set of each joint; sets are merged along the off-diagonal entries."""
        sets = {i: [i] for i in range(len(self.joints))}
        for row, column in np.argwhere(self.coupling).tolist():
            first, other = sets[row], sets[column]
            if first is not other:
                first += other
                sets |= dict.fromkeys(other, first)
        return [np.array(sorted(sets[i])) for i in range(len(self.joints))]


def _reverses(coupling: Floats) -> bool:
    """Whether every joint has its own motor, so that no rank search is needed."""
    own = np.diagonal(coupling)
    if np.count_nonzero(coupling) == np.count_nonzero(own):
        return bool(own.all())
    return int(np.linalg.matrix_rank(coupling)) == len(own)


@dataclass(frozen=True, eq=False)
class Selector:
    """Converts names or numbers to joint indices."""

    names: tuple[str, ...]

    @cached_property
    def _places(self) -> dict[str, int]:
        return {name: i for i, name in enumerate(self.names)}

    def indices(self, joints: Sequence[str] | Sequence[int] | Ints | None) -> Ints:
        """Indices of `joints`, all for None. `UnknownJoint` for missing or repeated joints."""
        if joints is None:
            return np.arange(len(self.names))
        found = np.array([self.index(joint) for joint in joints], dtype=np.int64)
        if len(set(found.tolist())) != len(found):
            raise UnknownJoint("a joint is named twice in one command")
        return found

    def index(self, joint: str | int) -> int:
        """Index of one joint."""
        if isinstance(joint, str):
            if joint not in self._places:
                raise UnknownJoint(f"there is no joint `{joint}`: " + ", ".join(self.names))
            return self._places[joint]
        if not 0 <= joint < len(self.names):
            raise UnknownJoint(f"there is no joint {joint}: the board has {len(self.names)}")
        return int(joint)


def numbers(name: str, values: object, size: int) -> Floats:
    """`values` as (size,) finite numbers; a scalar is repeated. Raises `BadValue`."""
    try:
        array = np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise BadValue(f"`{name}` is not made of numbers") from None
    if array.ndim == 0:
        array = np.full(size, float(array))
    if array.shape != (size,):
        raise BadValue(f"`{name}` has {array.size} values, {size} are needed")
    if not (np.abs(array) <= _LARGEST).all():  # or a value is not a number
        if not np.isfinite(array).all():
            raise BadValue(f"`{name}` holds NaN or infinity")
        raise BadValue(f"`{name}` is beyond {_LARGEST:g}, which nothing here reaches")
    return array


def run(places: Ints) -> slice | Ints:
    """The same as an index: a slice for consecutive joints, which is far cheaper.

    Indexing with a slice gives a view.
    """
    first = int(places[0]) if len(places) else 0
    if np.array_equal(places, np.arange(first, first + len(places))):
        return slice(first, first + len(places))
    return places
