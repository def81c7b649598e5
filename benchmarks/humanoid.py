"""A humanoid of 30 joints in a room, as InnerModel XML: what the simulator is measured with.

It stands with both feet on the floor, its hip held in the world, an inertial unit in its chest and
a laser of 360 rays on its head; `camera=True` gives it an RGBD camera of 640 x 480, too.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

JOINTS = 30
RAYS = 360

_LEG = (
    ("hip_y", "y"),
    ("hip_z", "z"),
    ("hip_x", "x"),
    ("knee", "x"),
    ("ankle_x", "x"),
    ("ankle_z", "z"),
)
_ARM = (
    ("shoulder_x", "x"),
    ("shoulder_z", "z"),
    ("shoulder_y", "y"),
    ("elbow", "x"),
    ("wrist_y", "y"),
    ("wrist_x", "x"),
    ("wrist_z", "z"),
)


@dataclass(frozen=True, slots=True)
class _Link:
    """What hangs on a joint: how far down the next joint is (mm), its mass (kg)."""

    down: float
    mass: float


_THIGH, _SHIN, _UPPER, _LOWER, _NONE = (
    _Link(300, 4),
    _Link(280, 3),
    _Link(220, 2),
    _Link(180, 1),
    _Link(0, 0.3),
)
_LEG_LINKS = (_NONE, _NONE, _THIGH, _SHIN, _NONE, _NONE)
_ARM_LINKS = (_NONE, _NONE, _UPPER, _LOWER, _NONE, _NONE, _NONE)


def humanoid(*, camera: bool = False) -> str:
    """The text of the world."""
    return "\n".join(
        [
            "<innerModel>",
            '<plane id="floor" ny="1" size="8000,8000,50" py="-25" collide="1"/>',
            '<plane id="front" nz="-1" pz="3025" py="500" size="8000,2000,50" collide="1"/>',
            '<plane id="side" nx="-1" px="2025" py="500" size="8000,2000,50" collide="1"/>',
            '<transform id="hip" ty="619.9">',
            *_limb("left", -90, _LEG, _LEG_LINKS, foot=True),
            *_limb("right", 90, _LEG, _LEG_LINKS, foot=True),
            '<joint id="waist_y" axis="y" min="-1" max="1">',
            '<joint id="waist_x" axis="x" min="-1" max="1">',
            '<translation id="chest" ty="350" mass="10">',
            '<imu id="inertia"/>',
            _shape("chest", 200, 300),
            *_limb("left", -180, _ARM, _ARM_LINKS),
            *_limb("right", 180, _ARM, _ARM_LINKS),
            *_head(camera),
            "</translation></joint></joint>",
            "</transform>",
            "</innerModel>",
        ]
    )


def _limb(
    side: str,
    out: float,
    axes: tuple[tuple[str, str], ...],
    links: tuple[_Link, ...],
    *,
    foot: bool = False,
) -> Iterator[str]:
    kind = "leg" if foot else "arm"
    yield f'<translation id="{side}_{kind}" tx="{out}">'
    for (name, axis), link in zip(axes, links, strict=True):
        yield f'<joint id="{side}_{name}" axis="{axis}" min="-1.5" max="1.5">'
        yield f'<translation id="{side}_{name}_link" ty="{-link.down}" mass="{link.mass}">'
        if link.down:
            yield _shape(f"{side}_{name}", 80, link.down - 60, link.down / 2)
    if foot:
        yield (f'<plane id="{side}_foot" ny="1" size="100,240,40" py="-20" pz="40" collide="1"/>')
    yield "</translation></joint>" * len(links)
    yield "</translation>"


def _head(camera: bool) -> Iterator[str]:
    yield '<translation id="neck" ty="220"><joint id="neck_y" axis="y" min="-1.5" max="1.5">'
    yield '<joint id="neck_x" axis="x" min="-1" max="1">'
    yield '<translation id="head" ty="120" mass="2">'
    yield _shape("head", 160, 180)
    yield '<translation id="eyes" tz="120">'
    yield f'<laser id="laser" measures="{RAYS}" min="50" max="10000" angle="4.7"/>'
    if camera:
        yield '<rgbd id="eye" width="640" height="480" focal="525"/>'
    yield "</translation></translation></joint></joint></translation>"


def _shape(name: str, wide: float, high: float, up: float = 0.0) -> str:
    size = f"{wide},{wide},{high}"
    return f'<plane id="{name}_shape" ny="1" size="{size}" py="{up}" collide="1"/>'
