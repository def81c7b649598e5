"""A robot of the catalog in MuJoCo."""

from __future__ import annotations

import mujoco
import numpy as np

from robocomp_dsl.simulation.robots.build import add_robot, new_world, set_pose
from robocomp_dsl.simulation.robots.catalog import ROBOTS

PI = np.pi

TENTH_MM = 1e-4


class SimulatedRobot:
    def __init__(self, name: str, *, free: bool = False) -> None:
        self.robot = ROBOTS[name]()
        spec = new_world()
        if free:
            spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[2, 2, 0.1])
        add_robot(spec, self.robot, free=free)
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)

    def pose(self, **angles: float) -> None:
        set_pose(self.model, self.data, self.robot, **angles)

    def in_root(self, position: np.ndarray) -> np.ndarray:
        root = self.data.body(self.robot.links[0].name)
        return root.xmat.reshape(3, 3).T @ (position - root.xpos)

    def site(self, name: str) -> np.ndarray:
        return self.in_root(self.data.site(name).xpos)
