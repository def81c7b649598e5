"""The reflex over time: frames in, motions out, and what happens when something is missing."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.tactile.description.model import Limb, Part, Patch, Robot
from robocomp_dsl.tactile.errors import FrameFault, RejectedFrame
from robocomp_dsl.tactile.reflex.engine import (
    ArmFacts,
    Move,
    ReflexEngine,
    ReflexSettings,
    ReflexState,
    Stop,
)
from robocomp_dsl.tactile.reflex.frames import FrameGate
from robocomp_dsl.tactile.reflex.law import Field, Law, Response, Stimulus
from robocomp_dsl.tactile.reflex.receptors import Receptors
from robocomp_dsl.tactile.skin.cone import Cone
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from robocomp_dsl.tactile.skin.layout import rings
from robocomp_dsl.tactile.skin.normalise import Sensitivity

START = np.array([0.4, 0.2, 0.3, 0.6, 0.0])
FACTS = ArmFacts(np.full(5, -0.5), np.full(5, 1.2), np.full(5, 2.0), START)
THETA = np.array([-0.2, 0.3, 0.0, 0.5, 0.0])
OTHER = np.array([0.1, 0.0, 0.4, 0.0, 0.0])
DT = 0.02


def response(gain: float, name: str = "a", motion: np.ndarray = THETA) -> Response:
    field = Field(name, "lower", np.zeros(3), 0.03, motion)
    return Response(field, Stimulus(np.zeros(3), 1.0), 0.0, gain)


class Rig:
    """A reflex and an arm that goes where it is told, at the speed that it is told."""

    def __init__(self, **options) -> None:
        self.engine = ReflexEngine(FACTS, ReflexSettings(**options))
        self.pose, self.goal, self.speed = START.copy(), START.copy(), np.zeros(5)
        self.now, self.moves, self.stops = 0.0, [], 0
        self.frames = self.answers = True

    def run(self, seconds: float, *touch: Response) -> None:
        for _ in range(round(seconds / DT)):
            self.now += DT
            step = np.clip(self.goal - self.pose, -self.speed * DT, self.speed * DT)
            self.pose = self.pose + step
            if self.answers:
                self.take(self.engine.arm(self.pose, self.now))
            if self.frames:
                self.take(self.engine.frame(list(touch), self.now))
            self.take(self.engine.tick(self.now))

    def take(self, action) -> None:
        if isinstance(action, Move):
            self.moves.append(action)
            self.goal, self.speed = action.position, action.speed
        elif isinstance(action, Stop):
            self.stops += 1
            self.goal = self.pose


def test_a_touch_withdraws_holds_and_returns():
    rig = Rig(hold=0.5)
    rig.run(0.2)
    assert rig.engine.state is ReflexState.WATCHING
    rig.run(0.04, response(0.5))
    assert rig.engine.state is ReflexState.WITHDRAWING
    assert rig.moves[0].position == pytest.approx(START + 0.5 * THETA)
    rig.run(0.3)
    assert rig.engine.state is ReflexState.HOLDING
    rig.run(0.55)
    assert rig.engine.state is ReflexState.RETURNING
    assert rig.moves[-1].position == pytest.approx(START)
    rig.run(2.0)
    assert rig.engine.state is ReflexState.WATCHING
    assert rig.pose == pytest.approx(START, abs=0.03)
    assert rig.engine.withdrawals == 1


def test_a_growing_touch_withdraws_as_its_peak():
    rig = Rig()
    rig.run(0.1)
    for gain in (0.01, 0.1, 0.3, 0.7, 0.5):
        rig.run(DT, response(gain))
    assert rig.goal == pytest.approx(START + 0.7 * THETA)
    assert rig.engine.withdrawals == 1
    assert rig.engine.active[0].gain == 0.7


def test_two_touches_add_up_and_one_may_come_during_a_withdrawal():
    rig = Rig()
    rig.run(0.1)
    rig.run(DT, response(0.5), response(1.0, "b", OTHER))
    both = START + 0.5 * THETA + OTHER
    assert rig.goal == pytest.approx(np.clip(both, FACTS.low, FACTS.high))
    rig = Rig()
    rig.run(0.1)
    rig.run(DT, response(0.5))
    rig.run(0.1)
    rig.run(DT, response(1.0, "b", OTHER))
    assert rig.goal == pytest.approx(np.clip(both, FACTS.low, FACTS.high))
    assert rig.engine.withdrawals == 1


def test_a_lasting_touch_triggers_again_after_the_refractory_time():
    rig = Rig(refractory=1.0)
    rig.run(0.1)
    rig.run(0.9, response(0.2))
    assert rig.engine.withdrawals == 1
    rig.run(0.2, response(0.2))
    assert rig.engine.withdrawals == 2
    assert rig.goal == pytest.approx(START + 0.4 * THETA, abs=0.01)


def test_a_touch_on_the_way_back_withdraws_from_there():
    rig = Rig(hold=0.1, refractory=0.3)
    rig.run(0.1)
    rig.run(DT, response(1.0))
    rig.run(0.75)
    assert rig.engine.state is ReflexState.RETURNING
    here = rig.pose.copy()
    rig.run(DT, response(1.0, "b", OTHER))
    assert rig.goal == pytest.approx(np.clip(here + OTHER, FACTS.low, FACTS.high), abs=0.05)


def test_missing_frames_or_a_silent_arm_freeze_and_it_recovers():
    for lost in ("frames", "answers"):
        rig = Rig(recovery=0.5)
        rig.run(0.1)
        rig.run(0.1, response(1.0))
        setattr(rig, lost, False)
        rig.run(0.7)
        assert rig.engine.state is ReflexState.FROZEN
        assert rig.stops == 1
        count = len(rig.moves)
        rig.run(1.0)
        assert len(rig.moves) == count
        setattr(rig, lost, True)
        rig.run(0.3, response(1.0))
        assert rig.engine.state is ReflexState.FROZEN
        rig.run(0.3)
        assert rig.engine.state is ReflexState.RETURNING
        rig.run(3.0)
        assert rig.engine.state is ReflexState.WATCHING


def test_before_the_first_data_nothing_freezes_and_nothing_moves():
    engine = ReflexEngine(FACTS)
    assert engine.frame([response(1.0)], 5.0) is None
    assert engine.tick(50.0) is None
    assert engine.state is ReflexState.WATCHING


def test_a_refused_command_freezes():
    rig = Rig()
    rig.run(0.1, response(1.0))
    rig.engine.refused(rig.now)
    assert rig.engine.state is ReflexState.FROZEN
    rig.run(0.2)
    assert rig.engine.state is ReflexState.FROZEN
    rig.run(0.5)
    assert rig.engine.state is ReflexState.RETURNING


def test_a_blocked_arm_does_not_hold_the_reflex_for_ever():
    rig = Rig(patience=0.5, hold=0.1)
    rig.run(0.1)
    rig.run(DT, response(1.0))
    rig.goal = rig.pose
    rig.run(0.6)
    assert rig.engine.state is ReflexState.WATCHING  # it held, went back and was there already


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(st.floats(0.0, 1.0), st.booleans(), st.integers(0, 12)), max_size=25))
def test_no_motion_ever_leaves_limits_or_speeds(touches):
    rig = Rig(refractory=0.1, hold=0.05)
    rig.run(0.1)
    for gain, second, pause in touches:
        answer = [response(gain)] if gain else []
        rig.run(DT, *answer, *([response(1.0, "b", 5 * OTHER)] if second else []))
        rig.run(pause * DT)
    for move in rig.moves:
        assert (move.position >= FACTS.low).all()
        assert (move.position <= FACTS.high).all()
        assert (move.speed <= FACTS.speed).all()


@pytest.mark.parametrize("wrong", [{"withdraw_speed": 0}, {"return_speed": 2}, {"hold": -1},
                                   {"frame_timeout": 0}])  # fmt: skip
def test_impossible_settings_are_refused(wrong):
    with pytest.raises(ValueError, match=r"shares|times"):
        ReflexSettings(**wrong)


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
def test_bad_frames_are_rejected_and_counted(frame, fault):
    gate = FrameGate(3, 4)
    gate.check(10, 1.0, 3, GOOD)
    if fault is None:
        assert (gate.check(*frame) == GOOD).all()
        assert gate.accepted == 2
        return
    with pytest.raises(RejectedFrame) as caught:
        gate.check(*frame)
    assert caught.value.fault is fault
    assert gate.rejected[fault] == 1
    assert gate.accepted == 1
    assert gate.newer_geometry == (frame[2] == 4)
    gate.forget()
    gate.check(1, 0.0, 3, GOOD)


def test_negative_forces_count_as_none():
    assert FrameGate(1, 2).check(1, 1.0, 1, np.array([-1.0, 2.0])).tolist() == [0.0, 2.0]


CONE = Cone(0.02, 0.10, 0.03, 0.03)
SKIN = rings(CONE, (0.033, 0.06, 0.087), 8)


def robot() -> Robot:
    def part(name: str, first: int) -> Part:
        limbs = tuple(Limb(n, n, np.zeros(3), np.eye(3), CONE) for n in ("upper", "lower"))
        patch = Patch(
            f"{name}_lower",
            "lower",
            tuple((SKIN.offset + first).tolist()),
            SKIN.points,
            SKIN.normals,
            Sensitivity(),
        )
        return Part(name, (), limbs=limbs, patches=(patch,))

    return Robot("r", (part("left_arm", 0), part("right_arm", 1000)))


def test_receptors_answer_for_their_own_arm_only():
    geometry = SkinGeometry.of(robot())
    centre = CONE.points(0.06, 0.0)
    fields = (
        Field("near", "lower", centre, 0.03, THETA),
        Field("far", "lower", CONE.points(0.06, np.pi), 0.03, OTHER),
    )
    near = np.linalg.norm(geometry.points - centre, axis=1) < 0.01
    left = geometry.limb == geometry.limbs.index("left_arm/lower")
    receptors = Receptors(geometry, "left_arm", fields, Law(0.05, 1.0))
    forces = np.where(near & left, 0.5, 0.0)
    (answer,) = receptors.answer(forces)
    assert answer.field.name == "near"
    assert answer.gain > 0.3
    assert receptors.answer(np.where(near & ~left, 0.5, 0.0)) == []
    opposite = np.linalg.norm(geometry.points - CONE.points(0.06, np.pi), axis=1) < 0.01
    both = receptors.answer(forces + np.where(opposite & left, 0.5, 0.0))
    assert sorted(one.field.name for one in both) == ["far", "near"]
    assert receptors.answer(np.zeros(geometry.size)) == []
    dead = forces.copy()
    dead[geometry.patch == geometry.patches.index("left_arm_lower")] = 0.0
    assert receptors.answer(dead) == []
    with pytest.raises(KeyError, match="no limb `left_arm/hand`"):
        Receptors(geometry, "left_arm", (Field("x", "hand", centre, 0.03, THETA),), Law())
