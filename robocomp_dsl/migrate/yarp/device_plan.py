"""The devices of the simulator, their attachments and actions, as lines of DDSL.

In: boards and the devices of a robot. Out: lines, and findings about what has no counterpart.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.literals import printable
from robocomp_dsl.migrate.yarp import codes
from robocomp_dsl.migrate.yarp.boards import ControlBoard
from robocomp_dsl.migrate.yarp.device_types import DeviceRole, advice_for, role_of
from robocomp_dsl.migrate.yarp.joints import JointGroup, RobotJoint, RobotJoints, attached_devices
from robocomp_dsl.migrate.yarp.programs import UniqueNames
from robocomp_dsl.migrate.yarp.robot_files import RobotAction, RobotDevice, YarpRobot
from robocomp_dsl.migrate.yarp.robot_values import numbers, text

_ORDER_REVERSED = ("interrupt1", "interrupt2", "interrupt3", "shutdown")
_NO_EFFECT = ("configure", "custom")


class DevicePlanWriter:
    """Writes the devices of one robot."""

    def __init__(
        self,
        robot: YarpRobot,
        joints: RobotJoints,
        boards: Sequence[ControlBoard],
        report: Report,
    ) -> None:
        self._robot = robot
        self._joints = joints
        self._boards = boards
        self._report = report
        names = UniqueNames()
        self._names = {board.device.name: names.claim(board.device.name) for board in boards}
        calibrators = [d for d in robot.devices if role_of(d.kind) is DeviceRole.CALIBRATOR]
        self._names |= {each.name: names.claim(each.name) for each in calibrators}
        self._calibrators = [each for each in calibrators if self._calibrated(each)]
        levels: defaultdict[str, int] = defaultdict(int)
        for device in robot.devices:
            for action in device.actions:
                levels[action.phase] = max(levels[action.phase], action.level)
        self._last_level = levels

    def lines(self) -> Iterator[str]:
        """The statements in the body of the component."""
        for board in self._boards:
            name = self._names[board.device.name]
            part = "" if name == board.part else f" {{ set part = {board.part}; }}"
            yield f"device {name} : control_board{part};"
        for calibrator in self._calibrators:
            settings = " ".join(f"set {key} = {value:.6g};" for key, value in self._set(calibrator))
            body = f" {{ {settings} }}" if settings else ""
            yield f"device {self._names[calibrator.name]} : calibrator{body};"
        yield from self._others()
        for calibrator in self._calibrators:
            boards = ", ".join(self._board_names(self._calibrated(calibrator)))
            yield f"attach {self._names[calibrator.name]} to {boards};"
        for device in self._robot.devices:
            for action in device.actions:
                yield from self._action(device, action)

    def _others(self) -> Iterator[str]:
        """Comments about devices without a line, and their findings."""
        for device in self._robot.devices:
            match role_of(device.kind):
                case DeviceRole.GROUP | DeviceRole.SERVER:
                    message = f"`{device.name}` ({device.kind}) is a port of the simulator"
                    self._report.add(codes.DEVICE_REPLACED, device.span, message)
                case DeviceRole.UNKNOWN | DeviceRole.CARTESIAN:
                    yield self._without_counterpart(device, advice_for(device.kind))
                case DeviceRole.MOTORS if not self._joints.of(device.name):
                    yield self._without_counterpart(
                        device, "its joints are not stated; give them as `AxisName` and `LIMITS`"
                    )
                case DeviceRole.CALIBRATOR if device not in self._calibrators:
                    yield self._without_counterpart(device, "it calibrates none of the boards")

    def _without_counterpart(self, device: RobotDevice, advice: str) -> str:
        message = f"`{device.name}` ({device.kind}) has no counterpart"
        self._report.add(codes.UNKNOWN_DEVICE_TYPE, device.span, message, help=advice)
        return f"// device {printable(device.name)} : {printable(device.kind)};  // {advice}"

    # -- calibrators --------------------------------------------------------------------------

    def _calibrated(self, calibrator: RobotDevice) -> JointGroup:
        """The joints that a calibrator is for: those of its targets."""
        targets = [text(action.values, "target") for action in calibrator.actions]
        targets += [
            device.name
            for device in self._robot.devices
            if calibrator.name in attached_devices(device).values()
        ]
        for target in dict.fromkeys(filter(None, targets)):
            if group := self._joints.of(target):
                return group
        return []

    def _board_names(self, group: JointGroup) -> list[str]:
        """The devices of the boards that have any of the joints."""
        joints = {joint for joint in group if joint}
        return [self._names[b.device.name] for b in self._boards if joints & set(b.joints)]

    def _set(self, calibrator: RobotDevice) -> Iterator[tuple[str, float]]:
        """The parameters of a calibrator, in rad, m and s."""
        values, group = calibrator.values, self._calibrated(calibrator)
        park = numbers(text(values, "HOME", "positionHome"))
        home = numbers(text(values, "CALIBRATION", "startupPosition")) or park
        speeds = numbers(text(values, "CALIBRATION", "startupVelocity")) or numbers(
            text(values, "HOME", "velocityHome")
        )
        turning = [
            joint.in_units(speed)
            for joint, speed in zip(group, speeds, strict=False)
            if joint and not joint.slides and speed > 0
        ]
        if turning:
            yield "speed", min(turning)
        timeouts = numbers(text(values, "CALIBRATION", "startupTimeout"))
        if timeouts and max(timeouts) > 0:
            yield "timeout", max(timeouts)
        for index, joint in enumerate(group):
            if joint:
                yield from self._positions(calibrator, joint, index, home, park)

    def _positions(
        self,
        calibrator: RobotDevice,
        joint: RobotJoint,
        index: int,
        home: list[float],
        park: list[float],
    ) -> Iterator[tuple[str, float]]:
        """`home` and `park` of one joint, unless they are 0, the default."""
        for key, positions in (("home", home), ("park", park)):
            stated = joint.in_units(positions[index]) if index < len(positions) else 0.0
            position = joint.clamped(stated)
            if abs(position - stated) > 1e-6:
                message = (
                    f"`{calibrator.name}`: the {key} position {stated:.4g} of `{joint.name}` is"
                    f" outside of its limits; {position:.4g} is used"
                )
                self._report.add(codes.ASSUMED_VALUE, calibrator.span, message)
            if position or key == "park":
                yield f"{key}.{joint.name}", position

    # -- actions ------------------------------------------------------------------------------

    def _action(self, device: RobotDevice, action: RobotAction) -> Iterator[str]:
        """The lines of one action; actions of devices that became ports have none."""
        if action.phase == "run" or action.verb in _NO_EFFECT:
            message = f"`{action.verb:.40}` of `{device.name}` in the phase `{action.phase}`"
            self._report.add(codes.ACTION_DROPPED, action.span, f"{message} has no effect in YARP")
            return
        if device not in self._calibrators:
            if role_of(device.kind) is DeviceRole.CALIBRATOR or action.verb not in (
                "attach",
                "detach",
            ):
                message = f"`{action.verb:.40}` of `{device.name}`, which is not in the deployment"
                self._report.add(codes.ACTION_DROPPED, action.span, message)
            return
        name = self._names[device.name]
        when = f"on {action.phase} level {self._level(action)}"
        match action.verb:
            case "calibrate" | "park":
                target = text(action.values, "target")
                boards = self._board_names(self._joints.of(target))
                if not boards:
                    message = f"`{action.verb}`: there are no joints of `{target or 'no target'}`"
                    self._report.add(codes.ACTION_DROPPED, action.span, message)
                for board in boards:
                    yield f"{when} {action.verb} {board} by {name};"
            case "attach" | "detach" | "abort":
                yield f"{when} {action.verb} {name};"
            case _:
                message = f"`{action.verb:.40}` is no action of YARP"
                self._report.add(codes.ACTION_DROPPED, action.span, message)

    def _level(self, action: RobotAction) -> int:
        """The level; levels increase, and those of a robot that reverses them are turned."""
        if self._robot.reverses and action.phase in _ORDER_REVERSED:
            return self._last_level[action.phase] - action.level
        return action.level
