"""The geometric checks of a tactile description: no finding for the shipped robots, and one for
every wrong frame, servo and chain."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from itertools import combinations

import numpy as np
import pytest

from robocomp_dsl.finding import Finding
from robocomp_dsl.simulation.models.posed_model import MujocoPosedModel
from robocomp_dsl.simulation.robots import catalog
from robocomp_dsl.simulation.robots.catalog import ROBOTS
from robocomp_dsl.tactile.arm.chain import Chain
from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.description.geometry.check_geometry import check_geometry, check_part
from robocomp_dsl.tactile.description.model import GenericPart, Limb, RobotDescription, Servo
from robocomp_dsl.tactile.description.read import rotation_from_rpy
from robocomp_dsl.tactile.errors import Fault
from robocomp_dsl.tactile.skin.cone import Cone

ARMS = [("nao_h25", "left_arm"), ("icub_v2", "right_arm")]
QUARTERS = (np.pi / 2, np.pi, -np.pi / 2)
arms = pytest.mark.parametrize(("name", "side"), ARMS)


@cache
def description(name: str) -> RobotDescription:
    return catalog.description(name)


@cache
def model(name: str) -> MujocoPosedModel:
    file = description(name).model_file
    assert file is not None
    return MujocoPosedModel(file)


def findings(name: str, side: str, change: Callable[[GenericPart], GenericPart]) -> list[Finding]:
    """The findings of a changed part."""
    robot = description(name)
    changed = change(robot.part(side))
    parts = tuple(changed if part.name == side else part for part in robot.parts)
    return check_part(replace(robot, parts=parts), changed, model(name))


def kinds(name: str, side: str, change: Callable[[GenericPart], GenericPart]) -> set[str]:
    return {finding.kind for finding in findings(name, side, change)}


def with_limb(change: Callable[[Limb], Limb], limb: str) -> Callable[[GenericPart], GenericPart]:
    def changed(part: GenericPart) -> GenericPart:
        limbs = tuple(change(each) if each.name == limb else each for each in part.limbs)
        return replace(part, limbs=limbs)

    return changed


def with_servo(
    change: Callable[[Servo], Servo], index: int
) -> Callable[[GenericPart], GenericPart]:
    def changed(part: GenericPart) -> GenericPart:
        servos = [change(s) if i == index else s for i, s in enumerate(part.servos)]
        return replace(part, servos=tuple(servos))

    return changed


def with_chain(change: Callable[[Chain], Chain]) -> Callable[[GenericPart], GenericPart]:
    def changed(part: GenericPart) -> GenericPart:
        assert part.chain is not None
        return replace(part, chain=change(part.chain))

    return changed


def turned(axis: int, angle: float) -> Floats:
    return rotation_from_rpy(*(angle * np.eye(3)[axis]))


@pytest.mark.parametrize("name", ROBOTS)
def test_check_geometry_finds_nothing_in_shipped_descriptions(name: str) -> None:
    assert [str(finding) for finding in check_geometry(description(name), model(name))] == []


@arms
@pytest.mark.parametrize("limb", ["upper_arm", "lower_arm"])
def test_check_geometry_finds_turned_limb_frames(name: str, side: str, limb: str) -> None:
    for axis in range(3):
        for angle in QUARTERS:
            turn = turned(axis, angle)
            change = with_limb(lambda item, turn=turn: replace(item, axes=item.axes @ turn), limb)
            assert kinds(name, side, change) == {Fault.FRAME}, (axis, angle)
            change = with_limb(lambda item, turn=turn: replace(item, axes=turn @ item.axes), limb)
            assert Fault.FRAME in kinds(name, side, change), (axis, angle)


@arms
@pytest.mark.parametrize("limb", ["upper_arm", "lower_arm"])
def test_check_geometry_finds_shifted_limb_frames(name: str, side: str, limb: str) -> None:
    for shift in (*(0.05 * np.eye(3)), *(-0.05 * np.eye(3)), 20.0 * np.eye(3)[0]):
        change = with_limb(
            lambda item, shift=shift: replace(item, origin=item.origin + shift), limb
        )
        assert kinds(name, side, change) == {Fault.FRAME}, shift


@arms
@pytest.mark.parametrize("limb", ["upper_arm", "lower_arm"])
def test_check_geometry_finds_skin_away_from_the_body(name: str, side: str, limb: str) -> None:
    part = description(name).part(side)
    cone = part.limb(limb).cone
    thick = Cone(cone.x0, cone.x1, cone.r0 + 0.02, cone.r1 + 0.02)
    outside = [
        replace(patch, points=patch.points * [1.0, 1.7, 1.7]) if patch.limb == limb else patch
        for patch in part.patches
    ]

    def without_skin(part: GenericPart) -> GenericPart:
        return replace(with_limb(lambda item: replace(item, cone=thick), limb)(part), patches=())

    assert kinds(name, side, without_skin) == {Fault.SURFACE}
    assert kinds(name, side, lambda p: replace(p, patches=tuple(outside))) == {Fault.SURFACE}


@arms
def test_check_geometry_finds_limbs_of_the_other_arm(name: str, side: str) -> None:
    other = "right_arm" if side == "left_arm" else "left_arm"
    limbs = description(name).part(other).limbs
    found = findings(name, side, lambda part: replace(part, limbs=limbs, patches=()))
    assert [finding.kind for finding in found] == [Fault.FRAME] * 2
    assert f"which `{other}` moves" in found[0].message


@arms
def test_check_geometry_finds_flipped_gamma_and_shifted_sigma(name: str, side: str) -> None:
    part = description(name).part(side)
    for index, servo in enumerate(part.servos):
        if not servo.joint:
            continue
        change = with_servo(lambda item: replace(item, gamma=-item.gamma), index)
        (found,) = findings(name, side, change)
        assert (found.kind, f"`{servo.joint}`" in found.message) == (Fault.DIRECTION, True)
        assert "wrong sign" in found.message
        assert found.location == servo.place
        change = with_servo(lambda item: replace(item, gamma=item.gamma * 57.3), index)
        assert kinds(name, side, change) == {Fault.DIRECTION}
        if index == 4:  # no convention says where the twist of the forearm is zero
            continue
        for angle in QUARTERS:
            change = with_servo(
                lambda item, angle=angle: replace(item, sigma=item.sigma + angle), index
            )
            (found,) = findings(name, side, change)
            assert found.kind == Fault.DIRECTION, (index, angle)


@arms
def test_check_geometry_finds_wrong_order_of_servos(name: str, side: str) -> None:
    part = description(name).part(side)
    present = [index for index, servo in enumerate(part.servos) if servo.joint]
    for first, second in combinations(present, 2):
        servos = list(part.servos)
        servos[first], servos[second] = servos[second], servos[first]
        found = kinds(name, side, lambda p, s=servos: replace(p, servos=tuple(s)))
        assert found == {Fault.DIRECTION}, (first, second)


@pytest.mark.parametrize("name", ROBOTS)
def test_check_geometry_finds_swapped_sides(name: str) -> None:
    robot = description(name)
    left, right = robot.parts
    swapped = (replace(right, name=left.name), replace(left, name=right.name))
    found = check_geometry(replace(robot, parts=swapped), model(name))
    assert "is a left arm by its name, but its joints are those of a right arm" in found[0].message
    chains = (replace(left, chain=right.chain), replace(right, chain=left.chain))
    assert {f.kind for f in check_geometry(replace(robot, parts=chains), model(name))} == {
        Fault.CHAIN
    }


@arms
def test_check_geometry_finds_the_servo_of_changed_chain_rows(name: str, side: str) -> None:
    part = description(name).part(side)
    assert part.chain is not None
    rows = part.chain.rows
    last = max(i for i, row in enumerate(rows) if row.joint is not None)
    for at, row in enumerate(rows):
        for key, change in (("a", 0.01), ("d", 0.01), ("alpha", 0.1), ("offset", 0.1)):
            if at >= last and key in ("alpha", "offset"):
                continue  # the orientation of the tool is free
            changed = list(rows)
            changed[at] = replace(row, **{key: getattr(row, key) + change})
            found = findings(name, side, with_chain(lambda c, r=changed: replace(c, rows=tuple(r))))
            assert [finding.kind for finding in found] == [Fault.CHAIN], (at, key)
            servo = found[0].message.partition("at servo ")[2][:1]
            following = [r.joint for r in rows[at:] if r.joint is not None]
            if servo:  # the row itself, or the next servo that it carries
                assert int(servo) in following[:3], (at, key, found[0].message)


@arms
def test_check_geometry_finds_a_wrong_base_and_end_of_the_chain(name: str, side: str) -> None:
    pose = np.eye(4)
    pose[0, 3] = 0.02
    (found,) = findings(
        name, side, with_chain(lambda chain: replace(chain, base=pose @ chain.base))
    )
    assert "leaves the model at servo 0" in found.message
    (found,) = findings(name, side, with_chain(lambda chain: replace(chain, tool=pose)))
    assert "the chain ends 20.0 mm from" in found.message
    unchecked = replace(description(name).part(side), tip="")
    assert findings(name, side, lambda part: replace(unchecked, chain=part.chain)) == []
    (found,) = findings(name, side, lambda part: replace(part, tip="no_hand"))
    assert (found.kind, "no body and no site" in found.message) == (Fault.BODY, True)


def test_check_geometry_of_one_arm_needs_no_side_in_its_name() -> None:
    robot = description("nao_h25")
    arm = replace(robot.part("left_arm"), name="manipulator")
    single = RobotDescription("nao_h25", (arm,), robot.file, robot.model)
    assert check_geometry(single, model("nao_h25")) == []
    servos = [replace(s, gamma=-s.gamma) if i == 1 else s for i, s in enumerate(arm.servos)]
    wrong = replace(single, parts=(replace(arm, servos=tuple(servos)),))
    (found,) = check_geometry(wrong, model("nao_h25"))
    assert "gamma of `LShoulderRoll` has the wrong sign" in found.message
