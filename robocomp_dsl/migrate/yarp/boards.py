"""Chooses the control boards of the simulator: groups of joints, each joint in one of them.

In: devices and their joints. Out: boards, and findings about groups that are left out.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate.yarp import codes
from robocomp_dsl.migrate.yarp.device_types import DeviceRole, role_of
from robocomp_dsl.migrate.yarp.joints import RobotJoint, RobotJoints
from robocomp_dsl.migrate.yarp.programs import UniqueNames
from robocomp_dsl.migrate.yarp.robot_files import RobotDevice
from robocomp_dsl.migrate.yarp.robot_values import text


@dataclass(frozen=True, slots=True)
class ControlBoard:
    """A control board: the device whose joints it has, and the name of its port."""

    part: str
    device: RobotDevice
    joints: tuple[RobotJoint, ...]


def choose_boards(joints: RobotJoints, names: UniqueNames, report: Report) -> list[ControlBoard]:
    """The boards of a robot: those that its wrappers show, else one for each driver.

    `names` are those of ports.
    """
    boards: list[ControlBoard] = []
    taken: set[RobotJoint] = set()
    for device in _in_order(joints):
        group = tuple(dict.fromkeys(each for each in joints.of(device.name) if each))
        shared = [joint for joint in group if joint in taken]
        if shared and role_of(device.kind) is DeviceRole.MOTORS:
            group = tuple(joint for joint in group if joint not in taken)
        elif shared:
            _report_shared(device, group, boards, report)
            continue
        if group:
            taken.update(group)
            boards.append(ControlBoard(names.claim(_part_name(device)), device, group))
    return boards


def _in_order(joints: RobotJoints) -> list[RobotDevice]:
    """Devices with joints: wrappers and servers, then remappers, then drivers.

    A group that contains two or more others, such as all joints of the robot, comes after them.
    """
    groups = [d for d in joints.devices.values() if role_of(d.kind) is DeviceRole.GROUP]
    drivers = [d for d in joints.devices.values() if role_of(d.kind) is DeviceRole.MOTORS]
    sets = {d.name: {each for each in joints.of(d.name) if each} for d in groups}

    def contained(device: RobotDevice) -> int:
        own = sets[device.name]
        return len({frozenset(other) for other in sets.values() if other and other < own})

    def rank(device: RobotDevice) -> tuple[bool, bool]:
        return contained(device) > 1, device.kind.lower().endswith("remapper")

    return [*sorted(groups, key=rank), *drivers]


def _report_shared(
    device: RobotDevice,
    group: Iterable[RobotJoint],
    boards: Iterable[ControlBoard],
    report: Report,
) -> None:
    """Report a group whose joints belong to other boards, unless it is one of them."""
    joints = set(group)
    users = [board for board in boards if joints & set(board.joints)]
    if len(users) == 1 and joints == set(users[0].joints):
        return
    listed = ", ".join(f"`{board.part}`" for board in users)
    message = f"the joints of `{device.name}` belong to {listed}"
    report.add(codes.SHARED_JOINTS, device.span, message)


def _part_name(device: RobotDevice) -> str:
    """The name of the port: `left_arm` of `/icub/left_arm`, else the name of the device."""
    path = [each for each in text(device.values, "name").split("/") if each]
    if path and re.match(r"[A-Za-z_]", path[-1]):
        return path[-1]
    return re.sub(r"(?:[-_](?:mc|wrapper|remapper|nws_yarp))+$", "", device.name) or device.name
