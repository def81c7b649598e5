"""The joints of a robot of YARP, and the groups of them that its devices form.

In: the devices. Out: for each device that drives or groups joints, its joints in order.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.migrate.yarp import codes
from robocomp_dsl.migrate.yarp.device_types import DeviceRole, role_of
from robocomp_dsl.migrate.yarp.programs import UniqueNames
from robocomp_dsl.migrate.yarp.robot_files import RobotDevice, Values
from robocomp_dsl.migrate.yarp.robot_values import integers, numbers, text, words

MAX_JOINTS = 256
"""Of one device."""
SLIDE_RANGE_M = (-0.1, 0.1)
HINGE_RANGE_RAD = (-math.pi / 2, math.pi / 2)


@dataclass(eq=False, slots=True)
class RobotJoint:
    """A joint; positions and speed in rad, or in m if it slides. `speed` 0: not stated."""

    name: str
    slides: bool
    lower: float
    upper: float
    speed: float

    def in_units(self, value: float) -> float:
        """A value of YARP, which measures angles in degrees, in our units."""
        return value if self.slides else math.radians(value)

    def clamped(self, position: float) -> float:
        """The nearest position within the limits."""
        return min(max(position, self.lower), self.upper)


JointGroup = list["RobotJoint | None"]
"""The joints of a device by their index; None for an index without joint."""


class RobotJoints:
    """The joints of all devices; each is computed on first use."""

    def __init__(self, devices: Sequence[RobotDevice], report: Report) -> None:
        self.devices = {device.name: device for device in devices}
        self._report = report
        self._names = UniqueNames()
        self._groups: dict[str, JointGroup] = {}
        self._open: set[str] = set()

    def of(self, name: str) -> JointGroup:
        """The joints of the device `name`; empty if it has none."""
        if name in self._groups:
            return self._groups[name]
        device = self.devices.get(name)
        if device is None or name in self._open:
            return []
        self._open.add(name)
        role = role_of(device.kind)
        joints: JointGroup = []
        if role is DeviceRole.MOTORS:
            joints = self._driven(device)
        elif role is DeviceRole.GROUP:
            joints = self._grouped(device)
        self._open.discard(name)
        self._groups[name] = joints
        return joints

    def _driven(self, device: RobotDevice) -> JointGroup:
        """The joints of a driver, from its parameters."""
        values = device.values
        names = words(_either(values, ("GENERAL", "AxisName"), ("AxisName",), ("axesNames",)))
        count = _count(values) or len(names)
        if not count:
            return []
        if len(names) < count:
            names += [f"{device.name}_{i}" for i in range(len(names), count)]
            self._assumed(device, "names of joints")
        kinds = words(_either(values, ("GENERAL", "AxisType"), ("AxisType",)))
        limits = [
            numbers(_either(values, ("LIMITS", f"jntPos{end}"), ("LIMITS", end)))
            for end in ("Min", "Max")
        ]
        speeds = numbers(text(values, "LIMITS", "jntVelMax"))
        if any(len(each) < count for each in limits):
            self._assumed(device, "limits of joints")
        return [
            self._joint(name, i, kinds, limits, speeds) if name.lower() != "none" else None
            for i, name in enumerate(names[:count])
        ]

    def _assumed(self, device: RobotDevice, what: str) -> None:
        message = f"`{device.name}`: {what} are not stated, or not for all joints"
        self._report.add(codes.ASSUMED_VALUE, device.span, message)

    def _joint(
        self,
        name: str,
        index: int,
        kinds: list[str],
        limits: list[list[float]],
        speeds: list[float],
    ) -> RobotJoint:
        slides = index < len(kinds) and kinds[index].lower() == "prismatic"
        joint = RobotJoint(self._names.claim(name), slides, 0.0, 0.0, 0.0)
        joint.lower, joint.upper = SLIDE_RANGE_M if slides else HINGE_RANGE_RAD
        low, high = (each[index] if index < len(each) else math.nan for each in limits)
        if low < high:
            joint.lower, joint.upper = joint.in_units(low), joint.in_units(high)
        if index < len(speeds) and speeds[index] > 0:
            joint.speed = joint.in_units(speeds[index])
        return joint

    def _grouped(self, device: RobotDevice) -> JointGroup:
        """The joints of a wrapper or a remapper: some of those of the attached devices."""
        attached = attached_devices(device)
        axes = words(text(device.values, "axesNames"))
        if axes:
            return self._named(device, axes, list(attached.values()))
        networks = words(text(device.values, "networks"))
        if not networks:
            first = next(iter(attached.values()), "")
            return self._of_attached(device, first, _count(device.values))
        ranges = {name: integers(text(device.values, name)) for name in networks}
        valid = {
            name: (each[0], each[1], each[2])
            for name, each in ranges.items()
            if len(each) == 4 and 0 <= each[0] <= each[1] < MAX_JOINTS and each[2] >= 0
        }
        for name in ranges.keys() - valid.keys():
            message = f"`{device.name}`: the network `{name:.60}` needs four numbers"
            self._report.add(codes.INCOMPLETE_ELEMENT, device.span, message)
        size = max((last + 1 for _, last, _ in valid.values()), default=0)
        group: JointGroup = [None] * size
        for name, (first_index, last, base) in valid.items():
            joints = self._of_attached(
                device, attached.get(name, ""), base + last - first_index + 1
            )
            for i in range(first_index, last + 1):
                k = base + i - first_index
                group[i] = joints[k] if k < len(joints) else None
        return group

    def _named(self, device: RobotDevice, axes: list[str], attached: list[str]) -> JointGroup:
        """The joints with the names `axes`; those of unknown drivers are created."""
        known = {joint.name: joint for each in attached for joint in self.of(each) if joint}
        missing = [name for name in axes if _identifier(name) not in known]
        if missing:
            self._assumed(device, f"the drivers of {', '.join(missing[:6])}")
        return [
            known.get(_identifier(name)) or self._joint(name, 0, [], [[], []], [])
            for name in axes[:MAX_JOINTS]
        ]

    def _of_attached(self, device: RobotDevice, name: str, count: int) -> JointGroup:
        """The joints of an attached device; if no file states them, `count` new ones."""
        known = self.of(name)
        if known or not name or name in self._open:
            return known
        group = self._groups.setdefault(name, [])
        missing = range(len(group), min(count, MAX_JOINTS))
        if missing:
            message = f"`{device.name}`: no file states the joints of `{name:.60}`"
            self._report.add(codes.ASSUMED_VALUE, device.span, message)
        group += [self._joint(f"{name}_{i}", i, [], [[], []], []) for i in missing]
        return group


def attached_devices(device: RobotDevice) -> dict[str, str]:
    """The devices that the attach actions of `device` name, by network."""
    attached: dict[str, str] = {}
    for action in device.actions:
        if action.verb != "attach":
            continue
        for network in words(text(action.values, "networks")):
            attached.setdefault(network, text(action.values, network))
        if single := text(action.values, "device"):
            attached.setdefault(text(action.values, "network"), single)
    return attached


def _identifier(name: str) -> str:
    return re.sub(r"\W", "_", name, flags=re.ASCII).strip("_")


def _either(values: Values, *paths: tuple[str, ...]) -> str:
    """The first text that is not empty."""
    return next(filter(None, (text(values, *path) for path in paths)), "")


def _count(values: Values) -> int:
    """The stated number of joints; 0 if there is none."""
    written = _either(values, ("GENERAL", "Joints"), ("joints",), ("axes",), ("GENERAL", "axes"))
    count = next(iter(integers(written)), 0)
    return min(max(count, 0), MAX_JOINTS)
