"""Motors, limits, masses and contacts of the robots."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from tests.simulation.models.simulated_robot import SimulatedRobot


@pytest.mark.parametrize(
    ("name", "motors", "mass"),
    [("nao_h25", 25, 5.3054), ("nao_h21", 21, None), ("icub_v2", 23, None)],
)
def test_robot_motors_and_masses_match_data_sheets(name, motors, mass):
    robot = SimulatedRobot(name)
    assert robot.model.nu == len(robot.robot.motors) == motors
    if mass:
        assert robot.model.body_mass.sum() == pytest.approx(mass, abs=1e-4)


def test_robot_start_pose_is_free_of_contacts(simulated):
    simulated.pose()
    assert simulated.data.ncon == 0


def test_robot_arms_reach_their_limits_only(simulated):
    for joint in simulated.robot.motors:
        for sign, limit in ((-1, joint.low), (1, joint.high)):
            simulated.model.opt.gravity[:] = 0
            simulated.pose()
            simulated.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
            simulated.data.ctrl[:] = 0
            simulated.data.actuator(joint.name).ctrl[0] = sign * 0.2 * joint.effort
            for _ in range(2500):
                mujoco.mj_step(simulated.model, simulated.data)
            reached = simulated.data.joint(joint.name).qpos[0]
            assert reached == pytest.approx(limit, abs=0.03), joint.name
    simulated.data.ctrl[:] = 0
    simulated.model.opt.disableflags = 0
    simulated.model.opt.gravity[:] = (0, 0, -9.81)


def test_robot_motor_torque_is_limited(simulated):
    simulated.pose()
    simulated.data.ctrl[:] = 1e6
    mujoco.mj_forward(simulated.model, simulated.data)
    for joint in simulated.robot.motors:
        assert simulated.data.actuator(joint.name).force[0] == pytest.approx(joint.effort)
    simulated.data.ctrl[:] = 0


def hold(robot: SimulatedRobot, seconds: float) -> float:
    """Hold the start pose by stiff springs; the largest angle off at the end."""
    model, data = robot.model, robot.data
    joints = [model.joint(joint.name) for joint in robot.robot.motors]
    where = np.array([joint.qposadr[0] for joint in joints])
    speed = np.array([joint.dofadr[0] for joint in joints])
    goal = data.qpos[where].copy()
    effort = np.array([joint.effort for joint in robot.robot.motors])
    for _ in range(int(seconds / model.opt.timestep)):
        data.ctrl[:] = 30 * effort * (goal - data.qpos[where]) - effort * data.qvel[speed]
        mujoco.mj_step(model, data)
    return float(np.abs(goal - data.qpos[where]).max())


def test_fixed_robot_stays_in_place(simulated):
    simulated.pose()
    assert hold(simulated, 2.0) < 0.03
    assert np.abs(simulated.data.qvel).max() < 0.01
    assert simulated.data.ncon == 0


@pytest.mark.parametrize("name", ["nao_h21", "nao_h25"])
def test_free_nao_stands_on_its_feet(name):
    nao = SimulatedRobot(name, free=True)
    nao.pose()
    hold(nao, 2.0)
    torso = nao.data.body("torso")
    assert torso.xpos[2] == pytest.approx(0.333, abs=0.01)
    assert torso.xmat.reshape(3, 3)[2, 2] > 0.99


def test_nao_hip_yaws_share_a_motor():
    nao = SimulatedRobot("nao_h21")
    nao.pose(LHipYawPitch=-0.3)
    assert nao.data.joint("RHipYawPitch").qpos[0] == -0.3
    nao.data.actuator("LHipYawPitch").ctrl[0] = -3
    for _ in range(300):
        mujoco.mj_step(nao.model, nao.data)
    left, right = (nao.data.joint(f"{s}HipYawPitch").qpos[0] for s in "LR")
    assert left < -0.31
    assert right == pytest.approx(left, abs=0.01)
