"""Maps of a limb's skin, unrolled, with the forces of its taxels and its fields.

In: a recording, a limb, the maximum force of each taxel. Out: a drawing on the axes of a picture:
up is along the limb, across is around it, with the same scale.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from colours import FIELD, INK, RIM, SOFT, pressure
from matplotlib.axes import Axes
from recording import Floats, Place, Recording

from robocomp_dsl.tactile.skin.cone import cartesian, cylindrical

SEAM = -math.radians(135)
"""Cut for skin that is pressed on all sides: between the places."""
_MARGIN = 4.0
_TAXEL = 3.1
"""mm: radius of the dots."""


def seam(places: Sequence[Place]) -> float:
    """The angle of the cut: opposite to a single place, or between several."""
    if len(places) != 1:
        return SEAM
    return float(cylindrical(places[0].centre)[1]) + math.pi


def unrolled(points: Floats, radius: float, cut: float) -> Floats:
    """Points (n, 3) of a limb's frame as mm around and mm along the limb, (n, 2)."""
    x, theta, _ = cylindrical(points)
    return np.column_stack((1000 * radius * around(theta, cut), 1000 * x))


def around(theta: Floats, cut: float) -> Floats:
    """Angles from the cut, 0 to 2 pi."""
    turned: Floats = np.mod(theta - cut, 2 * math.pi)
    return turned


def outline(
    points: Floats, place: Place, cut: float, steps: int = 240
) -> tuple[Floats, Floats, Floats]:
    """Distance of the limb's surface to a field's centre, divided by its radius.

    Returns angles from the cut (steps,), positions along the limb (steps,) in m, and the distances
    on their grid; the field's edge is at 1. The surface is the cone through `points`.
    """
    x, _, rho = cylindrical(points)
    slope, at_zero = np.polyfit(x, rho, 1)
    turns = np.linspace(0, 2 * math.pi, steps)
    along = np.linspace(x.min() - 0.02, x.max() + 0.02, steps)
    angles, places = np.meshgrid(turns + cut, along)
    surface = cartesian(places, angles, slope * places + at_zero)
    away = np.linalg.norm(surface - place.centre, axis=-1) / place.radius
    return turns, along, away


def draw(
    axes: Axes, it: Recording, limb: str, peaks: Floats, numbers: Mapping[str, int], highest: float
) -> None:
    """Draw one limb; `peaks` (n,) are of all taxels, `numbers` those of the pressed places."""
    mine = it.skin.of(limb)
    points = it.skin.points[mine]
    sheet = Sheet(points, float(cylindrical(points)[2].mean()), seam(_pressed(it, limb, numbers)))
    order = np.argsort(peaks[mine])
    across, along = sheet.flat(points[order]).T
    axes.scatter(
        across,
        along,
        s=_dot(axes, it, limb),
        c=pressure(peaks[mine][order], highest),
        edgecolors=RIM,
        linewidths=0.4,
        zorder=2,
    )
    for place in _pressed(it, limb, numbers):
        _field(axes, sheet, place, numbers[place.name])
    _frame(axes, sheet, vertical(it, limb), limb)


@dataclass(frozen=True, slots=True, eq=False)
class Sheet:
    """The skin with taxels at `points` (n, 3), unrolled at its mean `radius`."""

    points: Floats
    radius: float
    cut: float

    def flat(self, points: Floats) -> Floats:
        """Points (n, 3) in mm on the map, (n, 2)."""
        return unrolled(points, self.radius, self.cut)


def extent(it: Recording, limb: str) -> tuple[float, float]:
    """Width and height of a limb's map, in mm."""
    points = it.skin.points[it.skin.of(limb)]
    low, high = vertical(it, limb)
    return 2000 * math.pi * float(cylindrical(points)[2].mean()), high - low


def vertical(it: Recording, limb: str) -> tuple[float, float]:
    """Range of the map along the limb, in mm: it contains all taxels and fields."""
    fields = [(place.centre[0], place.radius) for place in it.places if place.limb == limb]
    taxels = it.skin.points[it.skin.of(limb), 0]
    ends = [*taxels, *(x - r for x, r in fields), *(x + r for x, r in fields)]
    return 1000 * min(ends) - _MARGIN, 1000 * max(ends) + _MARGIN


def _pressed(it: Recording, limb: str, numbers: Mapping[str, int]) -> list[Place]:
    return [place for place in it.places if place.limb == limb and place.name in numbers]


def _dot(axes: Axes, it: Recording, limb: str) -> float:
    """Area of a dot in square points, so that it is as large as a taxel."""
    wide, _ = extent(it, limb)
    figure = axes.get_figure(root=True)
    inches = figure.get_size_inches()[0] * axes.get_position().width if figure else 0.0
    return float((2 * _TAXEL * 72 * inches / wide) ** 2)


def _field(axes: Axes, sheet: Sheet, place: Place, number: int) -> None:
    turns, along, away = outline(sheet.points, place, sheet.cut)
    across = 1000 * sheet.radius * turns
    axes.contour(across, 1000 * along, away, [1.0], colors=FIELD, linewidths=1.1, zorder=3)
    (at,) = sheet.flat(place.centre[None])
    axes.plot(*at, marker="+", color=INK, markersize=7, markeredgewidth=1.2, zorder=5)
    axes.text(
        at[0],
        1.02,
        f"{number}  {place.name.rpartition('_')[2]}",
        transform=axes.get_xaxis_transform(),
        color=INK,
        size=7.5,
        weight="bold",
        ha="center",
        va="bottom",
    )


def _frame(axes: Axes, sheet: Sheet, ends: tuple[float, float], limb: str) -> None:
    axes.set(xlim=(0, 2000 * math.pi * sheet.radius), ylim=ends, aspect="equal")
    degrees = np.array([-90, 0, 90, 180])
    across = 1000 * sheet.radius * around(np.radians(degrees), sheet.cut)
    axes.set_xticks(across, [f"{degree}°" for degree in degrees])
    axes.set_ylabel(f"along the {limb.rpartition('/')[2].replace('_', ' ')} [mm]", color=SOFT)
    axes.tick_params(length=2, colors=SOFT)
    for side in axes.spines.values():
        side.set(color=SOFT, linewidth=0.6)
