"""One simulated arm on a fixed trunk, for tests: of a NAO, of an iCub."""

from __future__ import annotations

from dataclasses import replace

import mujoco
import numpy as np

from robocomp_dsl.simulation.devices.control_board import SimulatedBoard
from robocomp_dsl.simulation.robots.boards import robot_board
from robocomp_dsl.simulation.robots.build import add_robot, new_world, set_pose
from robocomp_dsl.simulation.robots.catalog import ROBOTS
from robocomp_dsl.simulation.robots.links import RobotModel
from robocomp_dsl.simulation.world.world import World

ARMS = {"nao": ("nao_h25", "LArm"), "icub": ("icub_v2", "right_arm")}


def alone(robot: RobotModel, joints: tuple[str, ...]) -> RobotModel:
    """The robot with `joints` only: other joints are fixed, other branches removed."""
    held = {link.name: link for link in robot.links}
    keep: set[str] = set()
    for link in robot.links:
        if link.joint and link.joint.name in joints:
            name = link.name
            while name:
                keep.add(name)
                name = held[name].parent
    links = tuple(
        link if link.joint and link.joint.name in joints else replace(link, joint=None)
        for link in robot.links
        if link.name in keep
    )
    return replace(robot, links=links, neighbours=())


class Arm:
    """One arm on a fixed trunk; nothing collides."""

    def __init__(self, name: str, zero: np.ndarray | None = None) -> None:
        robot = ROBOTS[ARMS[name][0]]()
        robot_arm_board = robot_board(robot, ARMS[name][1])
        if zero is not None:
            joints = tuple(
                replace(joint, calibrated=False) for joint in robot_arm_board.spec.joints
            )
            robot_arm_board = replace(
                robot_arm_board, spec=replace(robot_arm_board.spec, joints=joints)
            )
        robot = alone(robot, robot_arm_board.joints)
        spec = new_world()
        add_robot(spec, robot)
        self.part = SimulatedBoard(robot_arm_board, encoder_zero=zero)
        self.world = World(spec, [self.part])
        self.world.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
        set_pose(self.world.model, self.world.data, robot)
        self.world.advance(0.001)
        self.board, self.command = self.part.board, self.part.commands
        self.settings = self.part.settings
        self.spec = self.board.spec

    def wait(self, done, seconds: float) -> bool:
        """Advance time until `done()`; whether it was reached."""
        for _ in range(int(seconds / 0.05)):
            if done():
                return True
            self.world.advance(0.05)
        return bool(done())

    def go(self, joints, goal, seconds: float = 20.0) -> None:
        self.command.position_move(joints, goal)
        assert self.wait(lambda: self.command.motion_done(joints).all(), seconds)
        self.world.advance(0.5)

    @property
    def inside(self) -> np.ndarray:
        """A pose well within all limits."""
        return (self.board.limits.low + self.board.limits.high) / 2
