"""The joint angles of the generic arm over time, with the touches.

In: recordings and outcomes. Out: curves on the panel of the picture.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from colours import FAINT, INK, JOINTS, SOFT, TOUCH
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator, MultipleLocator
from panel import COLUMN, LEFT, Column, Sheet
from recording import Floats

HIGH = 1.75
_JOINTS = ("shoulder pitch", "shoulder roll", "shoulder yaw", "elbow pitch", "elbow yaw")
_SILENCE = 0.1  # s


def draw(sheet: Sheet, column: Column, left: float, top: float, span: tuple[float, float]) -> None:
    """Draw the angles of one robot over time, between `span` [degrees]."""
    it = column.recording
    axes = sheet.axes(left, top, COLUMN, HIGH)
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
    """Mark the start of each touch with its number."""
    above = axes.get_xaxis_transform()
    for touch in column.outcomes:
        if not np.isnan(touch.contact):
            when, number = touch.contact - start, str(column.numbers[touch.place])
            axes.axvline(when, color=TOUCH, linewidth=3.5, zorder=0)
            axes.text(when, 1.03, number, transform=above, color=INK, weight="bold", ha="center")


def _with_gaps(times: Floats, angles: Floats) -> tuple[Floats, Floats]:
    """The same with NaN in long gaps, so that no line is drawn across them."""
    after = np.flatnonzero(np.diff(times) > _SILENCE) + 1
    return np.insert(times, after, np.nan), np.insert(angles, after, np.nan, axis=0)


def span(columns: Sequence[Column]) -> tuple[float, float]:
    """A range of angles that contains all robots' curves."""
    every = np.degrees(np.concatenate([column.recording.arm.ravel() for column in columns]))
    return float(every.min()) - 6.0, float(every.max()) + 6.0


def names(sheet: Sheet, top: float) -> None:
    """Legend of the joints."""
    sheet.text(LEFT, top, "joint angles of the generic arm [°]", size=8, color=SOFT)
    for i, (name, colour) in enumerate(zip(_JOINTS, JOINTS, strict=True)):
        sheet.text(LEFT + 2.3 + i * 1.3, top, f"\u2014 {name}", size=8, color=colour, weight="bold")
