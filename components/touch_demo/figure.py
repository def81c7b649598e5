"""The picture of the demo: photographs, skin maps and joint angles of each robot.

In: recordings, outcomes, photographs if available. Out: a PNG file, 1600 pixels wide.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import zip_longest
from pathlib import Path
from textwrap import wrap

import curves
import matplotlib as mpl
import numpy as np
import skin_map
from colours import FAINT, INK, PAPER, SOFT, pressures, scale
from matplotlib.cm import ScalarMappable
from metrics import words
from panel import COLUMN, LEFT, ROOM, WIDE, Column, Sheet

PHOTO = (2.17, 1.9)
"""Width and height of a photograph in inches, as all lengths here, from the upper left corner."""
PHOTO_PIXELS = (694, 608)
"""Its size in pixels: the same shape, twice the resolution of the picture."""
_MM = COLUMN / 252
"""Inches per mm of skin."""
_LINE = 0.165
_CAPTION = (
    "The skin unrolled, across: the angle around the limb. Colours: largest force on each taxel."
    " Circles: receptive fields."
)
_BETWEEN = 0.46
"""Distance of two maps."""


def draw(columns: Sequence[Column], title: str, facts: str, highest: float, file: Path) -> None:
    """Write the picture to `file`; `highest` [N] is the end of the colour scale."""
    rows = max(len(panel.outcomes) for panel in columns)
    maps, span = _map_rows(columns), curves.span(columns)
    below_photos = 1.30 + PHOTO[1] + 0.36
    below_table = below_photos + (rows + 1) * _LINE + 0.14
    below_maps = below_table + sum(maps) + _BETWEEN * len(maps) + 0.55
    with mpl.rc_context({"font.family": "DejaVu Sans", "font.size": 7.5, "axes.labelsize": 7.5}):
        sheet = Sheet(below_maps + curves.HIGH + 0.50)
        sheet.text(0.25, 0.36, title, size=16, weight="bold")
        sheet.text(0.25, 0.68, facts, size=9.5, color=SOFT)
        for i, column in enumerate(columns):
            left = LEFT + i * (COLUMN + ROOM)
            sheet.text(left, 1.06, column.recording.robot, size=12, weight="bold")
            _photos(sheet, column, left, 1.30)
            _table(sheet, column, left, below_photos)
            _maps(sheet, column, left, below_table + 0.16, maps, highest)
            curves.draw(sheet, column, left, below_maps, span)
        sheet.text(LEFT, below_table, _CAPTION, size=8, color=SOFT)
        curves.names(sheet, below_maps - 0.34)
        _bar(sheet, highest)
        sheet.figure.savefig(file, facecolor=PAPER)


def _map_rows(columns: Sequence[Column]) -> list[float]:
    """Heights of the rows of maps."""
    heights = [
        [skin_map.extent(column.recording, limb)[1] * _MM for limb in column.limbs]
        for column in columns
    ]
    return [max(row) for row in zip_longest(*heights, fillvalue=0.0)]


def _photos(sheet: Sheet, column: Column, left: float, top: float) -> None:
    touch = column.shown
    captions = (
        f"touch {column.numbers[touch.place]}, {words(touch.place)}",
        f"{1000 * (touch.farthest - touch.contact):.0f} ms later, {touch.withdrawn:.0f} mm away",
    )
    wide, high = PHOTO
    if column.photos is None:
        axes = sheet.axes(left, top, COLUMN, high)
        axes.set(xticks=[], yticks=[], facecolor=FAINT)
        caption = "\n".join(wrap("no photographs: " + column.why_not, 60))
        axes.text(0.5, 0.5, caption, color=SOFT, ha="center", va="center")
        return
    for i, (pixels, caption) in enumerate(zip(column.photos, captions, strict=True)):
        axes = sheet.axes(left + i * (COLUMN - wide), top, wide, high)
        axes.imshow(pixels, interpolation="antialiased", aspect="auto")
        axes.axis("off")
        sheet.text(left + i * (COLUMN - wide), top + high + 0.11, caption, size=7.5, color=SOFT)


_COLUMNS = ((0.0, "left", ""), (0.18, "left", "place"), (2.0, "right", "force"),
            (2.85, "right", "withdrawn"), (3.66, "right", "first motion"),
            (COLUMN, "right", "free again"))  # fmt: skip


def _table(sheet: Sheet, column: Column, left: float, top: float) -> None:
    rows = [tuple(name for _, _, name in _COLUMNS)] + [
        (
            str(column.numbers[outcome.place]),
            words(outcome.place),
            f"{outcome.force:.1f} N",
            _with(outcome.withdrawn, "mm"),
            _with(outcome.moved_after, "ms"),
            _with(outcome.cleared_after, "ms"),
        )
        for outcome in column.outcomes
    ]
    for line, row in enumerate(rows):
        colour = INK if line else SOFT
        for (at, side, _), text in zip(_COLUMNS, row, strict=True):
            weight = "bold" if line and not at else "normal"
            sheet.text(
                left + at, top + line * _LINE, text, ha=side, size=8, color=colour, weight=weight
            )


def _with(value: float, unit: str) -> str:
    return "never" if np.isnan(value) else f"{value:.0f} {unit}"


def _maps(
    sheet: Sheet, column: Column, left: float, top: float, rows: Sequence[float], highest: float
) -> None:
    it = column.recording
    peaks = it.force.max(axis=0, initial=0.0)
    for limb, room in zip(column.limbs, rows, strict=False):
        wide, high = (length * _MM for length in skin_map.extent(it, limb))
        axes = sheet.axes(left, top + 0.22, wide, high)
        skin_map.draw(axes, it, limb, peaks, column.numbers, highest)
        top += room + _BETWEEN


def _bar(sheet: Sheet, highest: float) -> None:
    """Draw the scale of the pressure colours, beside the facts."""
    axes = sheet.axes(WIDE - 2.35, 0.86, 2.1, 0.09)
    colours = ScalarMappable(scale(highest), pressures())
    bar = sheet.figure.colorbar(colours, cax=axes, orientation="horizontal")
    bar.outline.set_visible(False)
    ticks = [force for force in (0.0, 0.1, 0.5, 1.0, 2.0, 4.0) if force <= highest]
    bar.set_ticks(ticks, labels=[f"{tick:g}" for tick in ticks])
    axes.tick_params(length=2, labelsize=7, colors=SOFT, pad=2)
    sheet.text(WIDE - 2.42, 0.90, "force of a taxel [N]", ha="right", size=7.5, color=SOFT)
