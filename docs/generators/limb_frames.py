"""The picture of limb frames: `python -m docs.generators.limb_frames`.

In: a shipped tactile description and its model. Out: `docs/limb_frames.png`, the left arm at
generic zero from the front, from the side, and a cross section of the forearm. All positions are
those of the model.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np

from robocomp_dsl.simulation.models.posed_model import MujocoPosedModel
from robocomp_dsl.simulation.robots.catalog import description
from robocomp_dsl.tactile.arrays import Floats
from robocomp_dsl.tactile.description.model import GenericPart, Limb
from robocomp_dsl.tactile.skin.cone import cartesian

mpl.use("Agg")
from matplotlib import pyplot as plt
from matplotlib.patches import Circle, Polygon, Rectangle

PICTURE = Path(__file__).parents[1] / "limb_frames.png"
ROBOT, PART = "nao_h25", "left_arm"
TAXEL, CONE, X_AXIS, Z_AXIS, ANGLE = "#888888", "#dfe7f3", "#c0392b", "#1f4e9c", "#2e7d32"
FRAME_LENGTH = 0.045
TRUNK = ((-0.06, 0.12), (-0.05, 0.1))
"""Width [m] of the trunk of the model, seen from the front and from the side: start and size."""


def draw(path: Path = PICTURE) -> None:
    """Write the picture."""
    robot = description(ROBOT)
    assert robot.model_file is not None  # noqa: S101 - shipped descriptions have a model
    model, part = MujocoPosedModel(robot.model_file), robot.part(PART)
    model.set_pose(part, np.zeros(len(part.servos)))
    figure, (front, side, section) = plt.subplots(1, 3, figsize=(16, 6.4), dpi=100)
    _view(front, model, part, 1, "from the front (y to the robot's left)")
    _view(side, model, part, 0, "in the sagittal plane (x forward)")
    _turns(front, side, model, part)
    _cross_section(section, part)
    figure.suptitle(f"{ROBOT}, {PART}: limb frames and generic angles at generic zero", fontsize=14)
    figure.tight_layout()
    figure.savefig(path)
    plt.close(figure)


def _view(axes: Any, model: MujocoPosedModel, part: GenericPart, across: int, title: str) -> None:
    """Trunk, cones, taxels and frames; `across` is the world axis to the right."""
    start, width = TRUNK[0 if across else 1]
    torso = model.pose("torso")
    assert torso is not None  # noqa: S101 - a body of this robot
    bottom = float(torso[2, 3]) - 0.075
    axes.add_patch(Rectangle((start, bottom), width, 0.19, fc="#eeeeee", ec="#bbbbbb"))
    axes.text(start + width / 2, bottom + 0.04, "trunk", ha="center", color="#777777")
    for limb in part.limbs:
        origin, frame = _frame(model, limb)
        _outline(axes, limb, origin, frame, across)
        for patch in part.patches:
            if patch.limb == limb.name:
                points = patch.points @ frame.T + origin
                axes.plot(points[:, across], points[:, 2], ".", color=TAXEL, ms=2.5, zorder=2)
        _arrow(axes, origin, frame[:, 0], across, "x", X_AXIS)
        if across:
            _arrow(axes, origin, frame[:, 2], across, "z: theta = 0", Z_AXIS)
        axes.plot(origin[across], origin[2], "o", color="black", ms=5, zorder=6)
        if across:
            joint = "shoulder" if limb.name == "upper_arm" else "elbow"
            label = f"`{limb.name}`: origin\nat the {joint}"
            axes.text(origin[1] - 0.01, origin[2] + 0.006, label, ha="right", fontsize=9, zorder=9)
    axes.set_title(title)
    axes.set_aspect("equal")
    axes.set_xlim((-0.1, 0.28) if across else (-0.12, 0.26))
    axes.set_ylim(0.13, 0.49)
    axes.set_xlabel("y [m]" if across else "x [m]")
    axes.set_ylabel("z [m]")


def _outline(axes: Any, limb: Limb, origin: Floats, frame: Floats, across: int) -> None:
    """The silhouette of the cone."""
    normal = frame[:, 2] if across else frame[:, 1]
    cone = limb.cone
    corners = [
        origin + x * frame[:, 0] + sign * r * normal
        for x, r, sign in (
            (cone.x0, cone.r0, 1), (cone.x1, cone.r1, 1),
            (cone.x1, cone.r1, -1), (cone.x0, cone.r0, -1),
        )
    ]  # fmt: skip
    outline = [(corner[across], corner[2]) for corner in corners]
    axes.add_patch(Polygon(outline, fc=CONE, ec="#7f93b2", zorder=1))


def _turns(front: Any, side: Any, model: MujocoPosedModel, part: GenericPart) -> None:
    """Where positive generic angles move the arm."""
    elbow = model.joint(part.servos[3].joint).point
    hand = model.centre(model.body_of(part.servos[3].joint))
    tip = elbow + 1.9 * (hand - elbow)
    _turn(side, (tip[0], tip[2]), (0.075, 0.02), "+0 shoulder pitch\n+3 elbow pitch", 0.3)
    _turn(front, (tip[1], tip[2]), (0.075, 0.02), "+1 shoulder roll", 0.3)
    front.text(
        0.147, elbow[2] - 0.075,
        "+2 shoulder yaw and\n+4 elbow yaw turn about\nthe limb, the flexed\nforearm inward",
        color=ANGLE, fontsize=9,
    )  # fmt: skip


def _turn(
    axes: Any, at: tuple[float, float], by: tuple[float, float], text: str, bend: float
) -> None:
    end = (at[0] + by[0], at[1] + by[1])
    style = {"arrowstyle": "-|>", "color": ANGLE, "lw": 2, "connectionstyle": f"arc3,rad={bend}"}
    axes.annotate("", end, at, arrowprops=style, zorder=7)
    axes.text(end[0] + 0.004, end[1] - 0.004, text, color=ANGLE, fontsize=9)


def _arrow(axes: Any, at: Floats, along: Floats, across: int, text: str, colour: str) -> None:
    end = at + FRAME_LENGTH * along
    style = {"arrowstyle": "-|>", "color": colour, "lw": 2.5, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", (end[across], end[2]), (at[across], at[2]), arrowprops=style, zorder=5)
    axes.text(end[across] + 0.004, end[2] + 0.002, text, color=colour, fontsize=10, zorder=8)


def _cross_section(axes: Any, part: GenericPart) -> None:
    """The forearm, seen against x: y and z of its frame, theta, taxels and one field."""
    limb = part.limb("lower_arm")
    field = next(field for field in part.fields if field.name == "lower_arm_outer")
    radius = float(limb.cone.radius(field.centre[0]))
    axes.add_patch(Circle((0, 0), radius, fc=CONE, ec="#7f93b2"))
    points = np.concatenate([patch.points for patch in part.patches if patch.limb == limb.name])
    axes.plot(points[:, 1], points[:, 2], ".", color=TAXEL, ms=5)
    for theta in (0, 90, 180, 270):
        _, y, z = cartesian(0.0, np.radians(theta), (1.75 if theta % 180 else 1.36) * radius)
        axes.text(y, z, f"theta {theta} deg", ha="center", va="center", color=Z_AXIS)
    # x is towards the viewer and z up, so y is on the right
    for end, text, colour in (((0, radius), "z", Z_AXIS), ((radius, 0), "y", "#2c3e50")):
        style = {"arrowstyle": "-|>", "color": colour, "lw": 2.5, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", end, (0, 0), arrowprops=style)
        axes.text(0.6 * end[0] + 0.001, 0.6 * end[1] + 0.001, text, color=colour, fontsize=11)
    arc = {"arrowstyle": "-|>", "color": ANGLE, "lw": 2, "connectionstyle": "arc3,rad=-0.25"}
    axes.annotate("", (0.016, 0.006), (0.004, 0.017), arrowprops=arc)
    axes.text(0.0155, 0.0135, "theta", color=ANGLE, fontsize=11)
    centre = field.centre
    axes.add_patch(
        Circle((centre[1], centre[2]), field.radius, fc="none", ec=X_AXIS, ls="--", zorder=4)
    )
    axes.plot(centre[1], centre[2], "x", color=X_AXIS, ms=9, mew=2, zorder=5)
    label = f"field `{field.name}`:\ncentre and radius {1000 * field.radius:.0f} mm"
    axes.text(-0.066, 0.066, label, color=X_AXIS, fontsize=9)
    axes.text(0, -0.058, "up: away from the trunk; left: the robot's front", ha="center")
    axes.set_title("section of the forearm, seen from the hand")
    axes.set_aspect("equal")
    axes.set_xlim(-0.07, 0.07)
    axes.set_ylim(-0.065, 0.08)
    axes.set_xlabel("y of the limb [m]")
    axes.set_ylabel("z of the limb [m]")


def _frame(model: MujocoPosedModel, limb: Limb) -> tuple[Floats, Floats]:
    pose = model.pose(limb.body)
    assert pose is not None  # noqa: S101 - the description fits the model
    origin: Floats = pose[:3, :3] @ limb.origin + pose[:3, 3]
    frame: Floats = pose[:3, :3] @ limb.axes
    return origin, frame


if __name__ == "__main__":
    draw()
