"""The picture of the demo: for each robot what it looked like, what it felt and what it did.

In: recordings, outcomes, photographs if there are any. Out: a PNG file, 1600 pixels wide.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path
from textwrap import wrap
from typing import Any

import matplotlib as mpl
import numpy as np
import skin_map
from colours import FAINT, INK, JOINTS, PAPER, SOFT, TOUCH, pressures, scale
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator, MultipleLocator
from outcome import Outcome, words
from photograph import Pixels
from recording import Floats, Recording

WIDE, DOTS = 10.0, 160
PHOTO = (2.17, 1.9)
"""Width and height of a photograph, in inches; all lengths here are, from the upper left corner."""
PHOTO_PIXELS = (694, 608)
"""The same shape, twice as many pixels as it has dots."""
_JOINTS = ("shoulder pitch", "shoulder roll", "shoulder yaw", "elbow pitch", "elbow yaw")
_LEFT, _COLUMN, _ROOM = 0.62, 4.40, 0.36
_MM = 4.40 / 252
"""Inches per mm of skin."""
_LINE = 0.165
_ANGLES = 1.75
_CAPTION = (
    "The skin unrolled, across: the angle around the limb. Colours: largest force on each taxel."
    " Circles: receptive fields."
)
_SILENCE = 0.1  # s
_BETWEEN = 0.46
"""From one map to the next."""


@dataclass(frozen=True, slots=True, eq=False)
class Column:
    """One robot. `photos` are before and after the touch `shown`, or `why_not` tells of them."""

    recording: Recording
    outcomes: Sequence[Outcome]
    shown: Outcome
    photos: tuple[Pixels, Pixels] | None
    why_not: str = ""

    @property
    def limbs(self) -> list[str]:
        """The limbs that were pressed, in the order of their places."""
        places = (self.recording.place(one.place) for one in self.outcomes)
        return list(dict.fromkeys(one.limb for one in places))

    @property
    def numbers(self) -> dict[str, int]:
        """The touches' numbers by their places."""
        return {one.place: i for i, one in enumerate(self.outcomes, 1)}


class Sheet:
    """A figure in inches from its upper left corner."""

    def __init__(self, high: float) -> None:
        self.figure = Figure(figsize=(WIDE, high), dpi=DOTS, facecolor=PAPER)
        self._high = high

    def text(self, left: float, top: float, said: str, **style: Any) -> None:
        """Words with their left end (or as `ha` says) and their middle there."""
        place = left / WIDE, 1 - top / self._high
        self.figure.text(*place, said, **{"color": INK, "va": "center", **style})

    def axes(self, left: float, top: float, wide: float, high: float) -> Axes:
        """Axes whose upper left corner is there."""
        place = left / WIDE, 1 - (top + high) / self._high, wide / WIDE, high / self._high
        return self.figure.add_axes(place)


def draw(columns: Sequence[Column], title: str, facts: str, highest: float, file: Path) -> None:
    """Write the picture to `file`; `highest` [N] is the end of the colours."""
    rows = max(len(one.outcomes) for one in columns)
    maps, span = _map_rows(columns), _span(columns)
    below_photos = 1.30 + PHOTO[1] + 0.36
    below_table = below_photos + (rows + 1) * _LINE + 0.14
    below_maps = below_table + sum(maps) + _BETWEEN * len(maps) + 0.55
    with mpl.rc_context({"font.family": "DejaVu Sans", "font.size": 7.5, "axes.labelsize": 7.5}):
        sheet = Sheet(below_maps + _ANGLES + 0.50)
        sheet.text(0.25, 0.36, title, size=16, weight="bold")
        sheet.text(0.25, 0.68, facts, size=9.5, color=SOFT)
        for i, column in enumerate(columns):
            left = _LEFT + i * (_COLUMN + _ROOM)
            sheet.text(left, 1.06, column.recording.robot, size=12, weight="bold")
            _photos(sheet, column, left, 1.30)
            _table(sheet, column, left, below_photos)
            _maps(sheet, column, left, below_table + 0.16, maps, highest)
            _angles(sheet, column, left, below_maps, span)
        sheet.text(_LEFT, below_table, _CAPTION, size=8, color=SOFT)
        _names(sheet, below_maps - 0.34)
        _bar(sheet, highest)
        sheet.figure.savefig(file, facecolor=PAPER)


def _map_rows(columns: Sequence[Column]) -> list[float]:
    """Heights of the rows of maps."""
    heights = [
        [skin_map.extent(one.recording, limb)[1] * _MM for limb in one.limbs] for one in columns
    ]
    return [max(row) for row in zip_longest(*heights, fillvalue=0.0)]


def _photos(sheet: Sheet, column: Column, left: float, top: float) -> None:
    touch = column.shown
    told = (
        f"touch {column.numbers[touch.place]}, {words(touch.place)}",
        f"{1000 * (touch.farthest - touch.contact):.0f} ms later, {touch.withdrawn:.0f} mm away",
    )
    wide, high = PHOTO
    if column.photos is None:
        axes = sheet.axes(left, top, _COLUMN, high)
        axes.set(xticks=[], yticks=[], facecolor=FAINT)
        said = "\n".join(wrap("no photographs: " + column.why_not, 60))
        axes.text(0.5, 0.5, said, color=SOFT, ha="center", va="center")
        return
    for i, (pixels, said) in enumerate(zip(column.photos, told, strict=True)):
        axes = sheet.axes(left + i * (_COLUMN - wide), top, wide, high)
        axes.imshow(pixels, interpolation="antialiased", aspect="auto")
        axes.axis("off")
        sheet.text(left + i * (_COLUMN - wide), top + high + 0.11, said, size=7.5, color=SOFT)


_COLUMNS = ((0.0, "left", ""), (0.18, "left", "place"), (2.0, "right", "force"),
            (2.85, "right", "withdrawn"), (3.66, "right", "first motion"),
            (_COLUMN, "right", "free again"))  # fmt: skip


def _table(sheet: Sheet, column: Column, left: float, top: float) -> None:
    rows = [tuple(name for _, _, name in _COLUMNS)] + [
        (
            str(column.numbers[one.place]),
            words(one.place),
            f"{one.force:.1f} N",
            _with(one.withdrawn, "mm"),
            _with(one.moved_after, "ms"),
            _with(one.cleared_after, "ms"),
        )
        for one in column.outcomes
    ]
    for line, row in enumerate(rows):
        colour = INK if line else SOFT
        for (at, side, _), said in zip(_COLUMNS, row, strict=True):
            weight = "bold" if line and not at else "normal"
            sheet.text(
                left + at, top + line * _LINE, said, ha=side, size=8, color=colour, weight=weight
            )


def _with(value: float, unit: str) -> str:
    return "never" if np.isnan(value) else f"{value:.0f} {unit}"


def _maps(
    sheet: Sheet, column: Column, left: float, top: float, rows: Sequence[float], highest: float
) -> None:
    it = column.recording
    peaks = it.force.max(axis=0, initial=0.0)
    for limb, room in zip(column.limbs, rows, strict=False):
        wide, high = (one * _MM for one in skin_map.extent(it, limb))
        axes = sheet.axes(left, top + 0.22, wide, high)
        skin_map.draw(axes, it, limb, peaks, column.numbers, highest)
        top += room + _BETWEEN


def _angles(
    sheet: Sheet, column: Column, left: float, top: float, span: tuple[float, float]
) -> None:
    it = column.recording
    axes = sheet.axes(left, top, _COLUMN, _ANGLES)
    start = it.presses[0].began - 1.0 if it.presses else 0.0
    _touches(axes, column, start)
    times, angles = _with_gaps(it.arm_time - start, it.arm)
    for joint, colour in enumerate(JOINTS):
        axes.plot(times, np.degrees(angles[:, joint]), color=colour, linewidth=1.3)
    axes.set_xlabel("simulated time [s]", color=SOFT)
    axes.set(xlim=(0, float(it.arm_time[-1]) - start), ylim=span)
    axes.xaxis.set_major_locator(MaxNLocator(8, integer=True))
    axes.yaxis.set_major_locator(MultipleLocator(30))
    axes.grid(axis="y", color=FAINT, linewidth=0.8)
    axes.set_axisbelow(True)
    axes.tick_params(length=2, colors=SOFT)
    for side in axes.spines.values():
        side.set(color=SOFT, linewidth=0.6)


def _touches(axes: Axes, column: Column, start: float) -> None:
    """When each touch began, with its number."""
    above = axes.get_xaxis_transform()
    for touch in column.outcomes:
        if not np.isnan(touch.contact):
            when, number = touch.contact - start, str(column.numbers[touch.place])
            axes.axvline(when, color=TOUCH, linewidth=3.5, zorder=0)
            axes.text(when, 1.03, number, transform=above, color=INK, weight="bold", ha="center")


def _with_gaps(times: Floats, angles: Floats) -> tuple[Floats, Floats]:
    """The same with NaN where nothing was heard for long, so that no line is drawn over it."""
    after = np.flatnonzero(np.diff(times) > _SILENCE) + 1
    return np.insert(times, after, np.nan), np.insert(angles, after, np.nan, axis=0)


def _span(columns: Sequence[Column]) -> tuple[float, float]:
    """Angles that all robots' curves fit between."""
    every = np.degrees(np.concatenate([one.recording.arm.ravel() for one in columns]))
    return float(every.min()) - 6.0, float(every.max()) + 6.0


def _names(sheet: Sheet, top: float) -> None:
    """Which curve is which joint."""
    sheet.text(_LEFT, top, "joint angles of the generic arm [°]", size=8, color=SOFT)
    for i, (name, colour) in enumerate(zip(_JOINTS, JOINTS, strict=True)):
        sheet.text(
            _LEFT + 2.3 + i * 1.3, top, f"\u2014 {name}", size=8, color=colour, weight="bold"
        )


def _bar(sheet: Sheet, highest: float) -> None:
    """The scale of the pressure colours, beside the facts."""
    axes = sheet.axes(WIDE - 2.35, 0.86, 2.1, 0.09)
    colours = ScalarMappable(scale(highest), pressures())
    bar = sheet.figure.colorbar(colours, cax=axes, orientation="horizontal")
    bar.outline.set_visible(False)
    ticks = [one for one in (0.0, 0.1, 0.5, 1.0, 2.0, 4.0) if one <= highest]
    bar.set_ticks(ticks, labels=[f"{one:g}" for one in ticks])
    axes.tick_params(length=2, labelsize=7, colors=SOFT, pad=2)
    sheet.text(WIDE - 2.42, 0.90, "force of a taxel [N]", ha="right", size=7.5, color=SOFT)
