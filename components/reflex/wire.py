"""Between the interfaces and the reflex: the same things in the words of both.

In: structs of GenericArm.idsl and Reflex.idsl, or fields and responses. Out: the others. What comes
from outside may be wrong; then `ValueError` or `InvalidField` says what is.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from generated.interfaces import ArmLimits, ArmState, Event, Field

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.errors import InvalidField
from robocomp_dsl.tactile.reflex import law
from robocomp_dsl.tactile.reflex.withdrawal import ArmFacts


def arm_facts(limits: ArmLimits, size: int) -> ArmFacts:
    """Limits of an arm of `size` joints. Raises `ValueError`."""
    if len(limits.low) != size:
        raise ValueError(f"the arm has {len(limits.low)} joints, not {size}")
    return ArmFacts(limits.low, limits.high, limits.speed, limits.start, limits.available)


def pose(state: ArmState, size: int) -> Floats | None:
    """Where the arm is, (size,); None where the state does not say."""
    usable = state.position.shape == (size,) and np.isfinite(state.position).all()
    return state.position if usable else None


def receptive_field(told: Field, part: str, size: int) -> law.Field:
    """A field for `size` joints of `part`. Raises `InvalidField`."""
    owner, _, limb = told.limb.partition("/")
    if owner != part or not limb:
        raise InvalidField(
            f"the field `{told.name}` is on `{told.limb}`; write the limb as `{part}/LIMB`"
        )
    centre = np.array([told.x, told.y, told.z])
    if not np.isfinite([*centre, told.radius, *told.motion]).all():
        raise InvalidField(f"the field `{told.name}` holds NaN or infinity")
    if told.radius <= 0.0:
        raise InvalidField(f"the radius of the field `{told.name}` must be positive")
    if len(told.motion) != size:
        raise InvalidField(
            f"the motion of the field `{told.name}` has {len(told.motion)} angles, the arm {size}"
        )
    return law.Field(told.name, limb, centre, told.radius, np.array(told.motion))


def receptive_fields(told: Iterable[Field], part: str, size: int) -> tuple[law.Field, ...]:
    """All of them, their names different. Raises `InvalidField`."""
    made = tuple(receptive_field(one, part, size) for one in told)
    names = [one.name for one in made]
    for name in names:
        if names.count(name) > 1:
            raise InvalidField(f"there are two fields of the name `{name}`")
    return made


def told_field(one: law.Field, part: str) -> Field:
    """The inverse of `receptive_field`."""
    x, y, z = one.centre.tolist()
    return Field(one.name, f"{part}/{one.limb}", x, y, z, one.radius, one.motion)


def event(one: law.Response, part: str, time: float) -> Event:
    """What a field answered to a touch at `time` [s]."""
    x, y, z = one.stimulus.centre.tolist()
    return Event(
        time=time,
        field=one.field.name,
        limb=f"{part}/{one.field.limb}",
        x=x,
        y=y,
        z=z,
        distance=one.distance,
        force=one.stimulus.force,
        gain=one.gain,
        motion=one.motion,
    )
