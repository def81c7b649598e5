"""Converts between the structs of the interfaces and the classes of the library.

In: structs of GenericArm.idsl and Reflex.idsl, or fields and responses. Out: the other kind.
Invalid input raises `ValueError` or `InvalidField`.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from reflex_generated.interfaces import (
    ArmLimits,
    ArmState,
    Event,
    Field,
    Limitation,
    LimitCause,
)

from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.errors import InvalidField
from robocomp_dsl.tactile.reflex import law, withdrawal
from robocomp_dsl.tactile.reflex.withdrawal import ArmProperties


def arm_properties(limits: ArmLimits, size: int) -> ArmProperties:
    """Limits of an arm of `size` joints. Raises `ValueError`."""
    if len(limits.low) != size:
        raise ValueError(f"the arm has {len(limits.low)} joints, not {size}")
    return ArmProperties(limits.low, limits.high, limits.speed, limits.start, limits.available)


def pose(state: ArmState, size: int) -> Floats | None:
    """The angles of the arm, (size,); None if the state has no valid ones."""
    usable = state.position.shape == (size,) and np.isfinite(state.position).all()
    return state.position if usable else None


def receptive_field(message: Field, part: str, size: int) -> law.Field:
    """A field for `size` joints of `part`. Raises `InvalidField`."""
    owner, _, limb = message.limb.partition("/")
    if owner != part or not limb:
        raise InvalidField(
            f"the field `{message.name}` is on `{message.limb}`; write the limb as `{part}/LIMB`"
        )
    centre = np.array([message.x, message.y, message.z])
    if not np.isfinite([*centre, message.radius, *message.motion]).all():
        raise InvalidField(f"the field `{message.name}` holds NaN or infinity")
    if message.radius <= 0.0:
        raise InvalidField(f"the radius of the field `{message.name}` must be positive")
    if len(message.motion) != size:
        raise InvalidField(
            f"the motion of the field `{message.name}` has {len(message.motion)} angles,"
            f" the arm {size}"
        )
    return law.Field(message.name, limb, centre, message.radius, np.array(message.motion))


def receptive_fields(messages: Iterable[Field], part: str, size: int) -> tuple[law.Field, ...]:
    """All fields; their names must differ. Raises `InvalidField`."""
    fields = tuple(receptive_field(message, part, size) for message in messages)
    names = [field.name for field in fields]
    for name in names:
        if names.count(name) > 1:
            raise InvalidField(f"there are two fields of the name `{name}`")
    return fields


def field_to_message(field: law.Field, part: str) -> Field:
    """The inverse of `receptive_field`."""
    x, y, z = field.centre.tolist()
    return Field(field.name, f"{part}/{field.limb}", x, y, z, field.radius, field.motion)


def event(response: law.Response, motion: Floats, part: str, time: float) -> Event:
    """The event of a field's response to a touch at `time` [s]; `motion` (n,) is caused by it."""
    x, y, z = response.stimulus.centre.tolist()
    return Event(
        time=time,
        field=response.field.name,
        limb=f"{part}/{response.field.limb}",
        x=x,
        y=y,
        z=z,
        distance=response.distance,
        force=response.stimulus.force,
        gain=response.gain,
        motion=motion,
    )


def cause_to_message(cause: withdrawal.LimitCause) -> LimitCause:
    """The cause in the words of Reflex.idsl."""
    return {
        withdrawal.LimitCause.JOINT_LIMITS: LimitCause.JointLimits,
        withdrawal.LimitCause.OWN_BODY: LimitCause.OwnBody,
        withdrawal.LimitCause.NO_DIRECTION: LimitCause.NoDirection,
    }[cause]


def limitation(cause: LimitCause, field: str, time: float, pause: float = 0.0) -> Limitation:
    """The event of a limited withdrawal from a touch at `time` [s]."""
    return Limitation(time=time, cause=cause, field=field, pause=pause)
