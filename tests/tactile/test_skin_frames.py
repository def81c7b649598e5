"""Validation of skin frames, and the fields that respond to them."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from robocomp_dsl.tactile.description.model import GenericPart, Limb, Patch, RobotDescription
from robocomp_dsl.tactile.errors import BadGeometry, FrameFault, InvalidField, RejectedFrame
from robocomp_dsl.tactile.reflex.frames import FrameValidator
from robocomp_dsl.tactile.reflex.law import Field, Law
from robocomp_dsl.tactile.reflex.perception import ReflexPerception
from robocomp_dsl.tactile.reflex.receptive_fields import ReceptiveFields
from robocomp_dsl.tactile.skin.cone import Cone
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from robocomp_dsl.tactile.skin.geometry_message import geometry_from_message
from robocomp_dsl.tactile.skin.layout import place_rings
from robocomp_dsl.tactile.skin.normalise import Sensitivity
from tests.tactile.reflex_samples import OTHER, THETA

GOOD = np.ones(4)


@pytest.mark.parametrize(
    ("frame", "fault"),
    [
        ((11, 1.2, 3, GOOD), None),
        ((9, 0.9, 3, GOOD), FrameFault.OUT_OF_ORDER),
        ((10, 1.0, 3, GOOD), FrameFault.OUT_OF_ORDER),
        ((1, 1.2, 3, GOOD), None),  # the publisher was started anew
        ((11, 1.2, 2, GOOD), FrameFault.OTHER_GEOMETRY),
        ((11, 1.2, 4, GOOD), FrameFault.OTHER_GEOMETRY),
        ((11, 1.2, 3, np.ones(3)), FrameFault.WRONG_LENGTH),
        ((11, 1.2, 3, np.ones((4, 1))), FrameFault.WRONG_LENGTH),
        ((11, 1.2, 3, np.array([1, np.nan, 1, 1])), FrameFault.NOT_FINITE),
        ((11, 1.2, 3, np.array([1, np.inf, 1, 1])), FrameFault.NOT_FINITE),
        ((11, np.nan, 3, GOOD), FrameFault.NOT_FINITE),
    ],
)
def test_frame_validator_rejects_and_counts_bad_frames(frame, fault):
    validator = FrameValidator()
    validator.expect(3, 4)
    validator.check(10, 1.0, 3, GOOD)
    if fault is None:
        assert (validator.check(*frame) == GOOD).all()
        assert validator.accepted == 2
        return
    with pytest.raises(RejectedFrame) as caught:
        validator.check(*frame)
    assert caught.value.fault is fault
    assert validator.rejected[fault] == 1
    assert validator.accepted == 1
    assert validator.is_outdated == (frame[2] == 4)
    validator.reset_sequence()
    validator.check(1, 0.0, 3, GOOD)
    assert not validator.is_outdated


def test_frame_validator_without_geometry_rejects_frames():
    validator = FrameValidator()
    with pytest.raises(RejectedFrame, match="none is known yet"):
        validator.check(1, 0.0, 3, GOOD)
    assert validator.is_outdated
    validator.expect(3, 4)
    assert not validator.is_outdated
    assert validator.rejected.total() == 1


def test_frame_validator_clips_negative_forces():
    validator = FrameValidator()
    validator.expect(1, 2)
    assert validator.check(1, 1.0, 1, np.array([-1.0, 2.0])).tolist() == [0.0, 2.0]


CONE = Cone(0.02, 0.10, 0.03, 0.03)

SKIN = place_rings(CONE, (0.033, 0.06, 0.087), 8)


def robot() -> RobotDescription:
    def part(name: str, first: int) -> GenericPart:
        limbs = tuple(Limb(n, n, np.zeros(3), np.eye(3), CONE) for n in ("upper", "lower"))
        patch = Patch(
            f"{name}_lower",
            "lower",
            tuple((SKIN.offset + first).tolist()),
            SKIN.points,
            SKIN.normals,
            Sensitivity(),
        )
        return GenericPart(name, (), limbs=limbs, patches=(patch,))

    return RobotDescription("r", (part("left_arm", 0), part("right_arm", 1000)))


def test_receptive_fields_respond_for_their_own_arm_only():
    geometry = SkinGeometry.of(robot())
    centre = CONE.points(0.06, 0.0)
    fields = (
        Field("near", "lower", centre, 0.03, THETA),
        Field("far", "lower", CONE.points(0.06, np.pi), 0.03, OTHER),
    )
    near = np.linalg.norm(geometry.points - centre, axis=1) < 0.01
    left = geometry.limb == geometry.limbs.index("left_arm/lower")
    receptors = ReceptiveFields(geometry, "left_arm", fields, Law(0.05, 1.0))
    forces = np.where(near & left, 0.5, 0.0)
    (answer,) = receptors.respond(forces)
    assert answer.field.name == "near"
    assert answer.gain > 0.3
    assert receptors.respond(np.where(near & ~left, 0.5, 0.0)) == []
    opposite = np.linalg.norm(geometry.points - CONE.points(0.06, np.pi), axis=1) < 0.01
    both = receptors.respond(forces + np.where(opposite & left, 0.5, 0.0))
    assert sorted(arm_name.field.name for arm_name in both) == ["far", "near"]
    assert receptors.respond(np.zeros(geometry.size)) == []
    dead = forces.copy()
    dead[geometry.patch == geometry.patches.index("left_arm_lower")] = 0.0
    assert receptors.respond(dead) == []
    with pytest.raises(InvalidField, match=r"no limb `left_arm/hand`.*it has left_arm/upper"):
        ReceptiveFields(geometry, "left_arm", (Field("x", "hand", centre, 0.03, THETA),), Law())


def test_reflex_reconfigures_completely_or_not_at_all():
    geometry = SkinGeometry.of(robot())
    here, there = (Field(n, "lower", CONE.points(0.06, at), 0.03, THETA) for n, at in
                   (("here", 0.0), ("there", np.pi)))  # fmt: skip
    left = geometry.limb == geometry.limbs.index("left_arm/lower")
    forces = np.where(left & (np.linalg.norm(geometry.points - here.centre, axis=1) < 0.01), 0.5, 0)
    sense = ReflexPerception("left_arm", (here,), Law(0.05, 1.0))
    with pytest.raises(RejectedFrame):
        sense.process_frame(1, 0.1, 1, forces)
    with pytest.raises(InvalidField, match="not reported"):
        sense.use_fields((there,))
    sense.adopt(geometry)
    (weak,) = sense.process_frame(2, 0.2, 1, forces)
    sense.use_law(Law(0.05, 0.5), 0.015)
    (strong,) = sense.process_frame(3, 0.3, 1, forces)
    assert strong.gain > 1.5 * weak.gain
    with pytest.raises(InvalidField):
        sense.use_fields((replace(here, limb="tail"),))
    assert sense.process_frame(4, 0.4, 1, forces)
    sense.use_fields((there,))
    assert sense.process_frame(5, 0.5, 1, forces) == []
    with pytest.raises(InvalidField):
        sense.adopt(replace(geometry, version=2, limbs=("a/upper", "a/lower", "b", "c")))
    assert sense.process_frame(6, 0.6, 1, forces) == []
    sense.adopt(replace(geometry, version=2))
    assert sense.process_frame(7, 0.7, 2, forces) == []
    assert sense.validator.accepted == 6


def as_told(geometry: SkinGeometry, **changes: object) -> SimpleNamespace:
    """A geometry by the names of the interface."""
    axes = [f"r{i}{j}" for i in range(3) for j in range(3)]
    message = {"version": geometry.version, "id": geometry.ids, "patch": geometry.patch}
    message |= {"limb": geometry.limb}
    message |= dict(zip("xyz", geometry.points.T, strict=True))
    message |= dict(zip(("nx", "ny", "nz"), geometry.normals.T, strict=True))
    message["patches"] = [
        SimpleNamespace(name=n, gain=s.gain, floor=s.floor, saturation=s.saturation)
        for n, s in zip(geometry.patches, geometry.sensitivities, strict=True)
    ]
    message["limbs"] = [
        SimpleNamespace(name=n, body=f.body, x=1.0, y=2.0, z=3.0,
                        **dict(zip(axes, np.eye(3).ravel(), strict=True)))
        for n, f in zip(geometry.limbs, geometry.frames, strict=True)
    ]  # fmt: skip
    return SimpleNamespace(**(message | changes))


def test_geometry_survives_message_round_trip():
    geometry = SkinGeometry.of(robot(), version=4)
    back = geometry_from_message(as_told(geometry))
    assert (back.version, back.size, back.limbs) == (4, geometry.size, geometry.limbs)
    for name in ("ids", "patch", "limb", "points", "normals"):
        assert (getattr(back, name) == getattr(geometry, name)).all(), name
    assert back.frames[1].name == "lower"
    assert back.frames[1].origin.tolist() == [1, 2, 3]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"patch": np.zeros(3, int)}, "`patch` has 3 entries for 480"),
        ({"x": np.zeros(3)}, "differ in length"),
        ({name: np.zeros(3) for name in "xyz"}, "`x` has 3"),
        ({name: np.zeros(3) for name in ("nx", "ny", "nz")}, "`nx` has 3"),
        ({"y": np.full(480, np.nan)}, "NaN"),
        ({"limb": np.full(480, 4)}, "entry 4 of a list of 4"),
        ({"limb": np.full(480, -1)}, "list of 4"),
        ({"patches": []}, "list of 0"),
        ({"patches": [SimpleNamespace(name="p", gain=0, floor=0, saturation=1)] * 2}, "gain > 0"),
    ],
)
def test_geometry_message_with_contradictions_is_refused(changes, message):
    with pytest.raises(BadGeometry, match=message):
        geometry_from_message(as_told(SkinGeometry.of(robot()), **changes))
