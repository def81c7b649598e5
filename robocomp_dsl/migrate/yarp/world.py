"""Writes a world with the joints and sensors of a robot of YARP, as MJCF.

In: boards and the names of sensors. Out: the text of the world. Its links are of equal length and
there is no gravity, because YARP's files state neither lengths nor masses.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from robocomp_dsl.migrate.yarp.boards import ControlBoard
from robocomp_dsl.migrate.yarp.joints import RobotJoint

_AXES = ("0 0 1", "0 1 0", "1 0 0")
_SPACING_M = 0.3
_LINK_M = 0.05
_DAMPING = 0.1
_ARMATURES = {"hinge": 0.1, "slide": 1}
"""Inertia of joints, in kg m² or kg: the simulated motors need some."""
_LINK = (
    f'<geom type="capsule" size="0.015" fromto="0 0 0 0 0 {_LINK_M:g}" mass="0.1"'
    ' contype="0" conaffinity="0"/>'
)


def world_text(
    name: str, boards: Sequence[ControlBoard], imus: Sequence[str], cameras: Sequence[str]
) -> str:
    """The world; all names are identifiers."""
    rows = [
        f"<!-- The joints of {name} as its description for YARP states them. Links have equal",
        "     lengths and masses, and there is no gravity: the robot's model can replace it. -->",
        f'<mujoco model="{name}">',
        '  <compiler angle="radian"/>',
        '  <option gravity="0 0 0"/>',
        "  <worldbody>",
        '    <body name="base">',
        '      <geom type="box" size="0.05 0.05 0.05" mass="1" contype="0" conaffinity="0"/>',
    ]
    rows += [f'      <site name="{imu}"/>' for imu in imus]
    rows += [f'      <camera name="{camera}" pos="0 -1 0.3"/>' for camera in cameras]
    for number, board in enumerate(boards):
        rows += _chain(board, number)
    rows += ["    </body>", "  </worldbody>"]
    if imus:
        sensors = (f'<gyro site="{imu}"/><accelerometer site="{imu}"/>' for imu in imus)
        rows += ["  <sensor>", *(f"    {each}" for each in sensors), "  </sensor>"]
    if boards:
        joints = [joint for board in boards for joint in board.joints]
        start = " ".join(f"{joint.clamped(0.0):.6g}" for joint in joints)
        rows += ["  <custom>", *_custom(boards), "  </custom>"]
        rows += ["  <keyframe>", f'    <key name="start" qpos="{start}"/>', "  </keyframe>"]
    return "\n".join([*rows, "</mujoco>", ""])


def _chain(board: ControlBoard, number: int) -> Iterator[str]:
    """The bodies of a board, each in the one before."""
    for index, joint in enumerate(board.joints):
        position = f"{(number + 1) * _SPACING_M:g} 0 0" if not index else f"0 0 {_LINK_M:g}"
        indent = "  " * (3 + index)
        yield f'{indent}<body name="link_{joint.name}" pos="{position}">'
        yield f"{indent}  {_joint(joint, index)}"
        yield f"{indent}  {_LINK}"
    for index in reversed(range(len(board.joints))):
        yield f"{'  ' * (3 + index)}</body>"


def _joint(joint: RobotJoint, index: int) -> str:
    kind = "slide" if joint.slides else "hinge"
    limits = f"{joint.lower:.6g} {joint.upper:.6g}"
    return (
        f'<joint name="{joint.name}" type="{kind}" axis="{_AXES[index % 3]}" range="{limits}"'
        f' damping="{_DAMPING}" armature="{_ARMATURES[kind]}"/>'
    )


def _custom(boards: Sequence[ControlBoard]) -> Iterator[str]:
    """The boards as tuples of joints, and the speeds of joints."""
    for board in boards:
        yield f'    <tuple name="{board.part}">'
        for joint in board.joints:
            yield f'      <element objtype="joint" objname="{joint.name}"/>'
        yield "    </tuple>"
        for joint in board.joints:
            if joint.speed:
                yield f'    <numeric name="speed_{joint.name}" data="{joint.speed:.6g}"/>'
