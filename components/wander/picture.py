"""A picture of the room from above, with the path of the robot.

In: outlines of the room, the path, measurements. Out: a PNG file. Lengths are mm, x to the
right, z upwards on the paper.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon
from numpy.typing import NDArray

from robocomp_dsl.simulation.scene.floor_plan import Outline

INK, SOFT, PAPER, FLOOR = "#22303c", "#7b8894", "#ffffff", "#f4f1ea"
WALL, THING, EDGE, ALARM = "#3b4956", "#d8cdb8", "#a89a80", "#d1495b"
MARGIN = 450.0

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Drive:
    """The data: `time` (n,) in s, `path` and `odometry` (n, 2) in mm, `heading` (n,) in rad.

    `odometry` is the path according to the wheels, in room coordinates. `nearest` is the index of
    the nearest approach, `touching` the point on the obstacle, `clearance` in mm.
    """

    time: Array
    path: Array
    heading: Array
    odometry: Array
    radius: float
    nearest: int
    touching: Array
    clearance: float


def draw(room: Sequence[Outline], drive: Drive, title: str, subtitle: str, file: Path) -> None:
    """Write the picture to `file`."""
    corners = np.concatenate([outline.corners for outline in room])
    low, high = corners.min(axis=0) - MARGIN, corners.max(axis=0) + np.array([MARGIN, MARGIN / 4])
    wide, deep = high - low
    with mpl.rc_context({"font.family": "DejaVu Sans", "font.size": 9}):
        figure = Figure(figsize=(9.0, 9.0 * deep / wide + 1.15), dpi=160, facecolor=PAPER)
        rows = 9.0 * deep / wide + 1.15
        axes = figure.add_axes((0.0, 0.0, 1.0, 1 - 1.15 / rows))
        axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
        axes.axis("off")
        _room(axes, room)
        _path(figure, axes, drive, rows)
        _marks(axes, drive)
        _scale(axes, low, high)
        top = 1 - 0.42 / rows
        figure.text(0.045, top, title, color=INK, size=15, weight="bold", va="center")
        figure.text(0.045, top - 0.30 / rows, subtitle, color=SOFT, size=9.5, va="center")
        figure.savefig(file, facecolor=PAPER)


def _room(axes: Axes, room: Sequence[Outline]) -> None:
    corners = np.concatenate(
        [outline.corners for outline in room if outline.name.startswith("wall")]
    )
    low, high = corners.min(axis=0), corners.max(axis=0)
    floor = np.array([low, (high[0], low[1]), high, (low[0], high[1])])
    axes.add_patch(Polygon(floor, facecolor=FLOOR, edgecolor="none", zorder=0))
    for outline in room:
        if outline.name.startswith("wall"):
            axes.add_patch(Polygon(outline.corners, facecolor=WALL, edgecolor=WALL, zorder=3))
            continue
        axes.add_patch(
            Polygon(outline.corners, facecolor=THING, edgecolor=EDGE, linewidth=1, zorder=2)
        )
        name = outline.name.split(maxsplit=2)[-1]
        middle = ((outline.corners.min(axis=0) + outline.corners.max(axis=0)) / 2).tolist()
        tall = np.ptp(outline.corners[:, 1]) > 1.6 * np.ptp(outline.corners[:, 0])
        axes.text(
            middle[0],
            middle[1],
            name,
            color="#6d6046",
            size=8,
            ha="center",
            va="center",
            rotation=90 if tall else 0,
            zorder=2.5,
        )


def _path(figure: Figure, axes: Axes, drive: Drive, rows: float) -> None:
    axes.plot(*drive.odometry.T, color=SOFT, linewidth=0.9, linestyle=(0, (4, 3)), zorder=4)
    steps = np.stack([drive.path[:-1], drive.path[1:]], axis=1)
    line = LineCollection(list(steps), cmap="viridis", linewidth=3.2, capstyle="round", zorder=5)
    line.set_array(drive.time[:-1])
    axes.add_collection(line)
    bar = figure.add_axes((0.70, 1 - 0.50 / rows, 0.255, 0.10 / rows))
    colours = figure.colorbar(line, cax=bar, orientation="horizontal")
    colours.outline.set_visible(False)
    last = float(drive.time[-1])
    colours.set_ticks([float(drive.time[0]), last], labels=["start", f"{last:.0f} s"])
    bar.tick_params(length=0, labelsize=8, colors=SOFT, pad=3)
    for label, side in zip(bar.get_xticklabels(), ("left", "right"), strict=True):
        label.set(ha=side)
    figure.text(
        0.955, 1 - 0.92 / rows, "dashed: odometry of the wheels", color=SOFT, size=8, ha="right"
    )


def _marks(axes: Axes, drive: Drive) -> None:
    for index, name in ((0, "start"), (-1, "end")):
        place, alpha = drive.path[index], float(drive.heading[index])
        ahead = np.array([np.sin(alpha), np.cos(alpha)])
        fill = PAPER if name == "start" else INK
        axes.add_patch(
            Circle(place, drive.radius, facecolor=fill, edgecolor=INK, linewidth=1.4, zorder=7)
        )
        tip = np.stack([place + ahead * drive.radius * 0.25, place + ahead * drive.radius * 0.92])
        axes.plot(*tip.T, color=INK if fill == PAPER else PAPER, linewidth=2, zorder=8)
        axes.annotate(
            name,
            place + ahead * drive.radius * (-1.6 if name == "start" else 1.6),
            color=INK,
            ha="center",
            va="center",
            weight="bold",
            zorder=9,
            bbox={"facecolor": FLOOR, "edgecolor": "none", "alpha": 0.75, "pad": 1.2},
        )
    place = drive.path[drive.nearest]
    axes.add_patch(
        Circle(place, drive.radius, facecolor="none", edgecolor=ALARM, linewidth=1.2, zorder=6)
    )
    towards = drive.touching - place
    rim = place + towards / max(float(np.linalg.norm(towards)), 1e-9) * drive.radius
    axes.plot(*np.stack([rim, drive.touching]).T, color=ALARM, linewidth=1.8, zorder=6)
    aside = 1 if drive.path[-1][0] < place[0] else -1  # away from the continuation of the path
    middle = ((rim + drive.touching) / 2).tolist()
    axes.text(
        middle[0] + aside * 110,
        middle[1],
        f"{drive.clearance:.0f} mm",
        color=ALARM,
        size=8.5,
        weight="bold",
        ha="left" if aside > 0 else "right",
        va="center",
        zorder=9,
    )


def _scale(axes: Axes, low: Array, high: Array) -> None:
    x, z = high[0] - MARGIN - 1000, low[1] + MARGIN * 0.45
    axes.plot([x, x + 1000], [z, z], color=INK, linewidth=2, solid_capstyle="butt")
    axes.text(x + 500, z + 60, "1 m", color=INK, size=8.5, ha="center", va="bottom")
