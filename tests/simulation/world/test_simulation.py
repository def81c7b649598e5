"""The world as a whole: time, seeds, snapshots, forks, and what happens when it diverges."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from robocomp_dsl.simulation.world import visual_state
from robocomp_dsl.simulation.world.simulation import SimulationOptions
from tests.simulation.served_worlds import ROOM, Served, served

NOISY = ROOM.replace('<differentialrobot id="robot"', '<differentialrobot id="robot" noise="20"')


@pytest.fixture
def world(tmp_path: Path) -> Served:
    return served(tmp_path, NOISY)


def observable_state(world: Served) -> tuple[Any, ...]:
    """Everything that a client can see of the robot, as it is."""
    state = world.ports["robot"].getBaseState()
    laser = world.ports["laser"].getLaserData().dist.tobytes()
    board = world.ports["ControlBoard"].getState()
    return state, laser, board.position.tobytes(), board.time


def driven(world: Served) -> tuple[Any, ...]:
    world.ports["robot"].setSpeedBase(300.0, 0.4)
    world.ports["JointMotor"].setPosition(world.types.MotorGoalPosition("neck", 0.5, 1.0))
    world.simulation.advance(1.0)
    return observable_state(world)


def test_simulation_is_bit_identical_for_same_seed_only(tmp_path: Path, world: Served) -> None:
    first = driven(world)
    again = driven(served(tmp_path, NOISY))
    assert str(again) == str(first)
    assert str(driven(served(tmp_path, NOISY, SimulationOptions(seed=2)))) != str(first)


def test_simulation_reset_restores_start(world: Served) -> None:
    first = driven(world)
    world.ports["Simulation"].reset()
    assert world.ports["Simulation"].getState().time == 0.0
    assert str(driven(world)) == str(first)
    world.ports["Simulation"].setSeed(2)
    world.ports["Simulation"].reset()
    assert str(driven(world)) != str(first)


def test_snapshot_restores_state_and_random_generators(world: Served) -> None:
    hand = world.ports["Simulation"]
    driven(world)
    saved = hand.snapshot()
    world.simulation.advance(0.7)
    first = observable_state(world)
    for _ in range(2):
        hand.restore(saved)
        assert hand.getState().time == pytest.approx(1.0)
        world.simulation.advance(0.7)
        assert str(observable_state(world)) == str(first)
    hand.forget(saved)
    with pytest.raises(world.types.RoboCompSimulation_Refused, match="no snapshot"):
        hand.restore(saved)


def test_fork_predicts_without_changing_the_world(world: Served) -> None:
    hand = world.ports["Simulation"]
    world.ports["robot"].setSpeedBase(300.0, 0.0)
    world.simulation.advance(0.5)
    before = str(observable_state(world))
    fork = hand.fork()
    assert hand.advance(fork, 2.0) == pytest.approx(2.5)
    predicted = hand.getPoses(fork, ["robot"])[0]
    assert str(observable_state(world)) == before
    world.simulation.advance(2.0)
    real = hand.getPoses(0, ["robot"])[0]
    assert (predicted.x, predicted.z, predicted.ry) == (real.x, real.z, real.ry)
    assert real.z > 200


def test_fork_accepts_other_commands(world: Served) -> None:
    hand = world.ports["Simulation"]
    forks = [hand.fork() for _ in range(2)]
    hand.drive(forks[0], "robot", 0.0, 500.0, 0.0)
    hand.move(forks[1], ["neck"], np.array([0.7]))
    for fork in forks:
        hand.advance(fork, 2.0)
    # 2 s at 500 mm/s, less what the ramp of 2 m/s² (62.5 mm) and the motor (20 ms) cost
    poses = [hand.getPoses(fork, ["robot"])[0].z for fork in (0, *forks)]
    assert poses == pytest.approx([-300, 627.5, -300], abs=2)
    joints = [hand.getJoints(fork, ["neck"])[0] for fork in (0, *forks)]
    assert joints == pytest.approx([0, 0, 0.7], abs=5e-3)
    hand.release(forks[0])
    with pytest.raises(world.types.RoboCompSimulation_Refused, match="no fork"):
        hand.advance(forks[0], 1.0)


def test_paused_simulation_advances_by_steps(world: Served) -> None:
    hand, refused = world.ports["Simulation"], world.types.RoboCompSimulation_Refused
    with pytest.raises(refused, match="paused"):
        hand.step(1)
    hand.pause()
    assert hand.step(5) == pytest.approx(0.01)
    with pytest.raises(refused):
        hand.step(-1)


NONSENSE = [
    ("setSpeed", (math.nan,), "finite"),
    ("setSpeed", (-1.0,), "negative"),
    ("setNoise", (-1.0,), "negative"),
    ("setSeed", (-1,), "negative"),
    ("advance", (1, math.nan), "finite"),
    ("advance", (1, 1e9), "600"),
    ("drive", (1, "neck", 0.0, 1.0, 0.0), "no base"),
    ("drive", (1, "robot", 0.0, math.nan, 0.0), "finite"),
    ("move", (1, ["robot"], np.array([1.0])), "no joint"),
    ("move", (1, ["neck"], np.array([math.inf])), "NaN or infinity"),
    ("getPoses", (0, ["nobody"]), "no frame"),
    ("getJoints", (0, ["robot"]), "no joint"),
]


@pytest.mark.parametrize(("operation", "values", "message"), NONSENSE)
def test_simulation_refuses_invalid_arguments(
    world: Served, operation: str, values: tuple[Any, ...], message: str
) -> None:
    hand = world.ports["Simulation"]
    assert hand.fork() == 1
    with pytest.raises(world.types.RoboCompSimulation_Refused, match=message):
        getattr(hand, operation)(*values)


def test_simulation_noise_can_be_switched_off(world: Served) -> None:
    world.ports["Simulation"].setNoise(0.0)
    driven(world)
    state = world.ports["robot"].getBaseState()
    start = (500.0, -300.0)
    assert (state.x + start[0], state.z + start[1]) == pytest.approx(
        (state.correctedX, state.correctedZ),
        abs=1.0,  # a step of 2 ms
    )


def test_simulation_without_physics_has_no_gravity(tmp_path: Path) -> None:
    text = '<innerModel><transform id="ball" engine="bullet" mass="1" ty="1000"/></innerModel>'
    world = served(tmp_path, text)
    hand = world.ports["Simulation"]
    hand.setPhysics(False)
    world.simulation.advance(0.5)
    assert hand.getPoses(0, ["ball"])[0].y == pytest.approx(1000)
    hand.setPhysics(True)
    world.simulation.advance(0.3)
    assert hand.getPoses(0, ["ball"])[0].y == pytest.approx(1000 - 9810 * 0.3**2 / 2, rel=0.01)


@pytest.mark.parametrize("choice", ["reset", "stop"])
def test_simulation_handles_divergence_as_configured(tmp_path: Path, choice: Any) -> None:
    world = served(tmp_path, NOISY, SimulationOptions(diverged=choice))
    it, hand = world.simulation, world.ports["Simulation"]
    it.advance(0.5)
    it.world.data.qvel[0] = math.inf
    if choice == "stop":
        with pytest.raises(Exception, match="diverged"):
            it.advance(0.1)
        assert "diverged" in hand.getState().failure
        hand.reset()
    else:
        it.advance(0.1)
    assert hand.getState().failure == ""
    assert hand.getState().time == 0.0
    it.advance(0.5)
    assert world.ports["laser"].getLaserData().dist[50] == pytest.approx(3100, abs=1)


def test_simulation_stops_after_repeated_divergence(tmp_path: Path) -> None:
    world = served(tmp_path, NOISY)
    it, hand = world.simulation, world.ports["Simulation"]
    for _ in range(2):
        it.world.data.qvel[0] = math.inf
        it.advance(0.01)
        assert hand.getState().failure == ""
    it.world.data.qvel[0] = math.inf
    with pytest.raises(Exception, match="diverged"):
        it.advance(0.01)
    assert "diverged" in hand.getState().failure
    hand.reset()  # is somebody's wish, and works
    it.advance(0.5)
    assert hand.getState().failure == ""
    for _ in range(4):  # now and then is not always
        it.world.data.qvel[0] = math.inf
        it.advance(0.01)
        it.advance(0.5)
    assert hand.getState().failure == ""


def test_visual_state_matches_world(world: Served) -> None:
    hand = world.ports["Simulation"]
    received = hand.getModel()
    assert received.version == mujoco.mj_versionString()
    model, data = visual_state.from_mjb(received.data), world.simulation.world.data
    names = [model.body(i).name for i in range(model.nbody)]
    assert names == [world.simulation.world.model.body(i).name for i in range(model.nbody)]
    driven(world)
    seen = hand.getSight()
    assert (seen.time, seen.revision) == (world.simulation.time, received.revision)
    assert seen.positions.tolist() == data.qpos.tolist()
    assert seen.poses.reshape(-1, 7)[:, :3] == pytest.approx(data.xpos, abs=1e-6)
    robot = seen.poses.reshape(-1, 7)[names.index("robot")]
    pose = hand.getPoses(0, ["robot"])[0]
    assert robot[:2] * 1000 == pytest.approx([pose.x, pose.z], abs=0.01)
    hand.reset()
    assert hand.getSight().revision == received.revision, "the same nodes"


def test_simulation_revision_changes_with_world(world: Served) -> None:
    hand, types = world.ports["Simulation"], world.types
    first, saved = hand.getSight(), hand.snapshot()
    pose = types.Pose3D(1, 2, 3, 0, 0, 0)
    world.ports["InnerModelManager"].addTransform("mark", "", "floor", pose)
    second = hand.getSight()
    assert second.revision != first.revision
    assert len(second.poses) == len(first.poses) + 7
    hand.restore(saved)
    third = hand.getSight()
    assert third.revision not in {first.revision, second.revision}
    assert len(third.poses) == len(first.poses)


def test_visual_state_contains_contacts(tmp_path: Path) -> None:
    text = """<innerModel><plane id="ground" ny="1" size="900,900,50" py="-25" collide="1"/>
    <transform id="crate" engine="bullet" mass="1" ty="60">
      <plane id="side" ny="1" size="100,100,100" collide="1"/></transform></innerModel>"""
    world = served(tmp_path, text)
    assert len(world.ports["Simulation"].getSight().contacts) == 0
    world.advance_until(lambda: len(world.ports["Simulation"].getSight().contacts))
    contacts = world.ports["Simulation"].getSight().contacts.reshape(-1, 6)
    assert contacts[:, 2] == pytest.approx(0, abs=0.01)
    assert np.abs(contacts[:, 3:]) == pytest.approx(np.tile([0, 0, 1], (len(contacts), 1)), abs=0.1)
