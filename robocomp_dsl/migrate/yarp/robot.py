"""Plans the migration of a description of yarprobotinterface.

In: a robot. Out: a world with its joints and sensors, and a deployment of the simulator that
`rcgen simulator` generates from it; without joints and sensors, a deployment of yarprobotinterface.
"""

from __future__ import annotations

import shlex
from dataclasses import dataclass

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.literals import printable, quoted
from robocomp_dsl.migrate.yarp.boards import choose_boards
from robocomp_dsl.migrate.yarp.device_plan import DevicePlanWriter
from robocomp_dsl.migrate.yarp.device_types import DeviceRole, role_of
from robocomp_dsl.migrate.yarp.joints import RobotJoints
from robocomp_dsl.migrate.yarp.programs import UniqueNames
from robocomp_dsl.migrate.yarp.robot_files import YarpRobot
from robocomp_dsl.migrate.yarp.world import world_text

STEP = "    "
_PORTS_OF_THE_WORLD = ("JointMotor", "InnerModelManager", "Simulation", "Clock", "base")


@dataclass(frozen=True, slots=True)
class MigratedRobot:
    """The texts of a migrated robot; `world` is empty without joints and sensors."""

    name: str
    deployment: str
    world: str


def migrate_robot(robot: YarpRobot, name: str, file: str, report: Report) -> MigratedRobot:
    """The deployment `name` of a robot; `file` is its path, seen from the deployment."""
    names = UniqueNames()
    for port in _PORTS_OF_THE_WORLD:
        names.claim(port)
    joints = RobotJoints(robot.devices, report)
    boards = choose_boards(joints, names, report)
    sensors = {
        role: [names.claim(d.name) for d in robot.devices if role_of(d.kind) is role]
        for role in (DeviceRole.IMU, DeviceRole.CAMERA)
    }
    lines = list(DevicePlanWriter(robot, joints, boards, report).lines())
    has_world = bool(boards or any(sensors.values()))
    world = (
        world_text(name, boards, sensors[DeviceRole.IMU], sensors[DeviceRole.CAMERA])
        if has_world
        else ""
    )
    return MigratedRobot(name, _text(robot, name, file, lines, has_world=has_world), world)


def simulator_name(name: str) -> str:
    """The simulator that `rcgen simulator NAME.xml` generates."""
    return f"{name}_simulator"


def _text(robot: YarpRobot, name: str, file: str, lines: list[str], *, has_world: bool) -> str:
    command = shlex.join(["yarprobotinterface", "--config", file])
    about = printable(robot.name).replace("*/", "* /")
    real = [
        f"{STEP}program {name}_robot",
        f"{STEP}{{",
        f"{STEP * 2}executable {quoted(command)};",
        f"{STEP * 2}ready after 1 s;",
        f"{STEP}}};",
    ]
    if not has_world:
        rows = [f"/** The robot {about}, run by yarprobotinterface of YARP. */"]
        rows += [f"Deployment {name}", "{", *real, *(f"{STEP}{line}" for line in lines)]
        return "\n".join([*rows, "};", ""])
    simulator = simulator_name(name)
    rows = [
        f'import "{simulator}/{simulator}.cdsl";',
        "",
        f"/** The robot {about}, simulated; its ports have the names of its parts. */",
        f"Deployment {name}",
        "{",
        f"{STEP}component {simulator}",
        f"{STEP}{{",
        *(f"{STEP * 2}{line}" for line in lines),
        f"{STEP}}};",
        "",
        f"{STEP}// The real robot, instead of the simulator:",
        *(f"{STEP}// {line.removeprefix(STEP)}" for line in real),
        "};",
        "",
    ]
    return "\n".join(rows)
