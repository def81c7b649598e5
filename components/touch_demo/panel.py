"""The canvas of the picture: inches from its upper left corner, and the data of one robot."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from colours import INK, PAPER
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from metrics import TouchMetrics
from photograph import Pixels
from recording import Recording

WIDE, DOTS = 10.0, 160
LEFT, COLUMN, ROOM = 0.62, 4.40, 0.36
"""Start of the first robot's column, its width, and the gap between two."""


@dataclass(frozen=True, slots=True, eq=False)
class Column:
    """One robot. `photos` are before and after the touch `shown`, or `why_not` says why not."""

    recording: Recording
    outcomes: Sequence[TouchMetrics]
    shown: TouchMetrics
    photos: tuple[Pixels, Pixels] | None
    why_not: str = ""

    @property
    def limbs(self) -> list[str]:
        """The limbs that were pressed, in the order of their places."""
        places = (self.recording.place(outcome.place) for outcome in self.outcomes)
        return list(dict.fromkeys(place.limb for place in places))

    @property
    def numbers(self) -> dict[str, int]:
        """The numbers of the touches by place."""
        return {outcome.place: i for i, outcome in enumerate(self.outcomes, 1)}


class Sheet:
    """A figure in inches from its upper left corner."""

    def __init__(self, high: float) -> None:
        self.figure = Figure(figsize=(WIDE, high), dpi=DOTS, facecolor=PAPER)
        self._high = high

    def text(self, left: float, top: float, text: str, **style: Any) -> None:
        """Text at this left end (or as `ha` says) and vertical centre."""
        place = left / WIDE, 1 - top / self._high
        self.figure.text(*place, text, **{"color": INK, "va": "center", **style})

    def axes(self, left: float, top: float, wide: float, high: float) -> Axes:
        """Axes with this upper left corner."""
        place = left / WIDE, 1 - (top + high) / self._high, wide / WIDE, high / self._high
        return self.figure.add_axes(place)
