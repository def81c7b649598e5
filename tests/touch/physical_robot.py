"""A robot in MuJoCo with its skin and one arm under control, and a finger that presses on it.

Everything is the project's own: physics, skin, control board, generic arm; no process, no board
component in between, so that a second of it takes a fraction of one.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from robocomp_dsl.hardware.control.modes import Mode
from robocomp_dsl.simulation.devices.control_board import SimulatedBoard
from robocomp_dsl.simulation.devices.skin import SimulatedSkin
from robocomp_dsl.simulation.robots.boards import whole_robot
from robocomp_dsl.simulation.robots.build import add_robot, new_world, set_pose
from robocomp_dsl.simulation.robots.catalog import ROBOTS
from robocomp_dsl.simulation.world.world import World
from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.reflex.law import Field
from tests.touch.kinematic_robot import Robot
from tests.touch.lockstep_harness import TICK

FINGER = 0.008
FAR = (0.0, 0.0, 3.0)


class PhysicalRobot(Robot):
    """See the module. `path` has where the finger is to be, tick by tick."""

    def initialize(self) -> None:
        super().initialize()
        robot = ROBOTS[self.name_of_robot]()
        spec = new_world()
        add_robot(spec, robot)
        finger = spec.worldbody.add_body(mocap=True, pos=FAR)
        finger.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[FINGER, 0, 0])
        self.skin, self.board = SimulatedSkin(self.geometry), SimulatedBoard(whole_robot(robot))
        self.body = World(spec, [self.skin, self.board])
        set_pose(self.body.model, self.body.data, robot)
        self.body.advance(0.001)
        self.board.commands.set_mode(None, Mode.POSITION)
        self.joints = [joint.split("/")[-1] for joint in self.part.joints]
        names = self.board.board.spec.names
        self.rows = [names.index(name) for name in self.joints]
        self.path: list[Floats] = []
        self.speeds: list[Floats] = []
        self.peak = 0.0

    def advance(self) -> Floats:
        if self.path:
            self.body.data.mocap_pos[0] = self.path.pop(0)
        self.body.advance(TICK)
        board = self.board.board.state()
        rows = self.rows
        state = self.arm.update_state(
            self.body.time, board.position[rows], board.velocity[rows], board.torque[rows]
        )
        self.speeds.append(state.velocity)
        return state.position

    def taxel_forces(self) -> Floats:
        force = self.skin.frame.force if self.skin.frame else np.zeros(self.geometry.size)
        self.peak = max(self.peak, float(force.sum()))
        return force

    def move(self, position: Floats, speed: Floats) -> Any:
        outcome = super().move(position, speed)
        orders = self.arm.position_move(position, speed)
        self.board.settings.set_reference_speed(self.joints, orders.speeds)
        self.board.commands.position_move(self.joints, orders.values)
        return outcome

    def stop(self) -> None:
        super().stop()
        self.board.commands.stop(self.joints)

    # For the test; the world is at rest meanwhile.

    def spot(self, field: Field) -> Floats:
        """Where the centre of a field is in the world."""
        limb = self.part.limb(field.limb)
        body = self.body.data.body(limb.body)
        return body.xpos + body.xmat.reshape(3, 3) @ limb.to_body(field.centre)

    def surface(self, field: Field, depth: float, along: float) -> Floats:
        """Where the finger's centre is, `depth` into the limb, `along` it from the field's."""
        limb = self.part.limb(field.limb)
        out = np.array([0.0, *field.centre[1:]])
        out /= np.linalg.norm(out)
        body = self.body.data.body(limb.body)
        turn = body.xmat.reshape(3, 3)
        axis = turn @ limb.to_body(np.array([field.centre[0] + along, 0, 0])) + body.xpos
        way = turn @ limb.axes @ out
        start = axis + 0.055 * way  # nearer than anything else of the robot
        geom = np.zeros(1, np.int32)
        model, data = self.body.model, self.body.data
        distance = mujoco.mj_ray(model, data, start, -way, None, 1, -1, geom)
        return start - (distance - FINGER + depth) * way

    def press(self, field: Field, depth: float, seconds: float, *, along: float = 0.0) -> None:
        """From now on: in along the normal within 0.1 s, there for `seconds` in all, and away."""
        far, near = (self.surface(field, off, along) for off in (-0.003, depth))
        steps = max(round(seconds / TICK), 5)
        path = [far + (near - far) * min((k + 1) / 5, 1.0) for k in range(steps)]
        self.path = [*path, np.array(FAR)]
