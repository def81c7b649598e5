"""The model of a tactile description: generic parts with servos, chain, limbs, skin and fields.

Frozen data; lengths in metres, angles in radians, except device values of a servo, which are in
its own unit. `place` is the position of an item in its file, for later findings.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from robocomp_dsl.finding import NOWHERE, Location
from robocomp_dsl.tactile.arm.chain import Chain, generic_chain
from robocomp_dsl.tactile.arm.mapping import PartMapping
from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.description.yaml_reader import UNITS
from robocomp_dsl.tactile.reflex.law import Field
from robocomp_dsl.tactile.skin.cone import Cone
from robocomp_dsl.tactile.skin.normalise import Sensitivity

GENERIC_ARM = ("shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow_pitch", "elbow_yaw")
"""The five generic indices of every arm, 0 to 4."""


@dataclass(frozen=True, slots=True)
class Servo:
    """One generic index. `joint` is empty if the robot lacks the joint; then the angle is sigma.

    `low`, `high`, `speed` and `start` are in `unit` of the device; stiffness and damping are
    those of its interaction mode [N m/rad, N m s/rad].
    """

    joint: str
    part: str
    gamma: float
    sigma: float
    low: float
    high: float
    speed: float
    stiffness: float
    damping: float
    start: float
    unit: str = "rad"
    place: Location = field(default=NOWHERE, compare=False)

    @property
    def qualified(self) -> str:
        """Part and joint as one name; one generic part may use several device parts."""
        return f"{self.part}/{self.joint}" if self.part else self.joint


@dataclass(frozen=True, slots=True)
class FixedJoint:
    """A joint that no generic index moves; it stays at `position` [rad or m]."""

    joint: str
    part: str
    position: float
    place: Location = field(default=NOWHERE, compare=False)


@dataclass(frozen=True, eq=False)
class Limb:
    """A limb on the robot's body `body`; `origin` (3,) and `axes` (3, 3) place its frame there.

    `covers` are other bodies below the same skin. The frame has its origin on the proximal
    joint, x along the limb, and theta = 0 at +z, which points away from the trunk when all generic
    angles are zero.
    """

    name: str
    body: str
    origin: Floats
    axes: Floats
    cone: Cone
    covers: tuple[str, ...] = ()
    place: Location = field(default=NOWHERE, compare=False)

    def to_body(self, points: Floats) -> Floats:
        """Points (..., 3) of the limb frame in the frame of its body."""
        transformed: Floats = points @ self.axes.T + self.origin
        return transformed

    def to_limb(self, points: Floats) -> Floats:
        """Points (..., 3) of the body in the limb frame."""
        transformed: Floats = (points - self.origin) @ self.axes
        return transformed


@dataclass(frozen=True, eq=False)
class Patch:
    """Taxels `ids` (n,) at `points` (n, 3) with `normals` (n, 3), in the frame of `limb`."""

    name: str
    limb: str
    ids: tuple[int, ...]
    points: Floats
    normals: Floats
    sensitivity: Sensitivity
    place: Location = field(default=NOWHERE, compare=False)


@dataclass(frozen=True, eq=False)
class GenericPart:
    """A generic part: an arm has the five indices of `GENERIC_ARM` on every robot.

    `fixed_joints` are the other joints of the robot's arm; they keep their positions. `tip` names
    the body or site of the model at the end of the chain; it may be empty. `row_places` are the
    generic index of each row of the chain, None for a fixed row, and its place.
    """

    name: str
    servos: tuple[Servo, ...]
    chain: Chain | None = None
    limbs: tuple[Limb, ...] = ()
    patches: tuple[Patch, ...] = ()
    fields: tuple[Field, ...] = ()
    fixed_joints: tuple[FixedJoint, ...] = ()
    place: Location = field(default=NOWHERE, compare=False)
    tip: str = ""
    chain_place: Location = field(default=NOWHERE, compare=False)
    row_places: tuple[tuple[int | None, Location], ...] = field(default=(), compare=False)

    @property
    def joints(self) -> tuple[str, ...]:
        """Qualified names of the joints that exist, in generic order."""
        return tuple(servo.qualified for servo in self.servos if servo.joint)

    @property
    def mapping(self) -> PartMapping:
        """Equations 1 and 2 for this part."""
        return PartMapping(
            gamma=np.array([servo.gamma for servo in self.servos]),
            sigma=np.array([servo.sigma for servo in self.servos]),
            low=np.array([servo.low for servo in self.servos]),
            high=np.array([servo.high for servo in self.servos]),
            available=np.array([bool(servo.joint) for servo in self.servos]),
            to_si=np.array([UNITS[servo.unit] for servo in self.servos]),
        )

    @property
    def generic_chain(self) -> Chain | None:
        """The chain driven by generic angles; None if the description has no chain."""
        if self.chain is None:
            return None
        mapping = self.mapping
        return generic_chain(self.chain, mapping.gamma_si, mapping.sigma, mapping.available)

    @property
    def start(self) -> Floats:
        """Generic start pose, (n,)."""
        return np.array([s.gamma * s.start + s.sigma if s.joint else s.sigma for s in self.servos])

    @property
    def speed_limits(self) -> Floats:
        """Largest generic speeds, (n,); 0 where there is no joint."""
        return self.mapping.speed_limit(np.array([s.speed for s in self.servos]))

    def limb(self, name: str) -> Limb:
        """The limb of that name. Raises `KeyError` if there is none."""
        return {limb.name: limb for limb in self.limbs}[name]


@dataclass(frozen=True, eq=False)
class RobotDescription:
    """All generic parts of a robot. `model`: the file of its body, relative to `file`, or empty."""

    name: str
    parts: tuple[GenericPart, ...] = field(default=())
    file: Path = Path()
    model: str = ""
    model_place: Location = field(default=NOWHERE, compare=False)

    @property
    def model_file(self) -> Path | None:
        """The path of the robot's model, which may not exist; None without `model`."""
        return self.file.parent / self.model if self.model else None

    def part(self, name: str) -> GenericPart:
        """The part of that name. Raises `KeyError` if there is none."""
        return {part.name: part for part in self.parts}[name]
