"""The metrics of each touch, and their table.

In: a recording and the robot's body. Out: one `TouchMetrics` per press, and lines for the terminal.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from body import Body
from recording import Floats, Ints, Press, Recording

MOVED = 0.01
"""rad: a joint that turned further has started to move."""
LEAST = 10.0
"""mm: a touched place that moved further has withdrawn."""
_THERE = 0.98
"""Share of the whole distance at which a place counts as arrived."""


@dataclass(frozen=True, slots=True)
class TouchMetrics:
    """`force` [N] is the maximum force on the arm, `withdrawn` [mm] the distance of the place.

    `field` is the field with the strongest response, `gain`; times [ms] count from `contact` [s],
    the first frame with a force; `farthest` [s] is the time when the place arrived. A value without
    an event is NaN.
    """

    robot: str
    place: str
    force: float
    field: str
    gain: float
    withdrawn: float
    contact: float
    farthest: float
    moved_after: float
    cleared_after: float

    @property
    def trouble(self) -> str:
        """The reason why this is no withdrawal; empty if it is one."""
        where = f"{self.robot}, {words(self.place)}"
        if np.isnan(self.contact):
            return f"{where}: the skin felt nothing"
        if not self.field:
            return f"{where}: no field of the reflex answered {self.force:.1f} N"
        if not self.withdrawn >= LEAST:
            return f"{where}: the arm went away by {self.withdrawn:.0f} mm only"
        if np.isnan(self.cleared_after):
            return f"{where}: the arm did not come free of the finger"
        return ""


def outcomes(it: Recording, body: Body) -> list[TouchMetrics]:
    """The metrics of each press, in order."""
    return [_outcome(it, body, press) for press in it.presses]


def _outcome(it: Recording, body: Body, press: Press) -> TouchMetrics:
    felt = arm_force(it)
    during = _within(it.frame_time, press)
    touched = during[felt[during] > 0.0]
    if not len(touched):
        nothing = float("nan")
        return TouchMetrics(it.robot, press.place, 0.0, "", *[nothing] * 6)
    contact = float(it.frame_time[touched[0]])
    free = during[during > touched[-1]]
    answers = [answer for answer in it.answers if contact <= answer.time <= press.ended]
    strongest = max(answers, key=lambda response: response.gain, default=None)
    way, farthest = _withdrawn(it, body, press, contact)
    return TouchMetrics(
        robot=it.robot,
        place=press.place,
        force=float(felt[touched].max()),
        field=strongest.field if strongest else "",
        gain=strongest.gain if strongest else float("nan"),
        withdrawn=way,
        contact=contact,
        farthest=farthest,
        moved_after=1000 * (_first_motion(it, press, contact) - contact),
        cleared_after=1000 * (float(it.frame_time[free[0]]) - contact)
        if len(free)
        else float("nan"),
    )


def arm_force(it: Recording) -> Floats:
    """Force on the whole arm, (frames,) in N."""
    limbs = [i for i, name in enumerate(it.skin.limbs) if name.startswith(f"{it.part}/")]
    total: Floats = it.force[:, np.isin(it.skin.limb, limbs)].sum(axis=1)
    return total


def arm_at(it: Recording, time: float) -> Floats:
    """The arm's angles (5,) in the last state up to `time`."""
    found: Floats = it.arm[max(int(np.searchsorted(it.arm_time, time, side="right")) - 1, 0)]
    return found


def _within(times: Floats, press: Press) -> Ints:
    return np.flatnonzero((times > press.began) & (times <= press.ended))


def _first_motion(it: Recording, press: Press, contact: float) -> float:
    during = _within(it.arm_time, press)
    turned = np.abs(it.arm[during] - arm_at(it, press.began)).max(axis=1)
    moved = during[(turned > MOVED) & (it.arm_time[during] >= contact)]
    return float(it.arm_time[moved[0]]) if len(moved) else float("nan")


def _withdrawn(it: Recording, body: Body, press: Press, contact: float) -> tuple[float, float]:
    """Distance of the place [mm], and when it arrived."""
    place = it.place(press.place)
    body.pose(it.rest, arm_at(it, contact))
    before = body.centre(place)
    times, ways = [contact], [0.0]
    for i in _within(it.arm_time, press):
        if it.arm_time[i] >= contact:
            body.pose(arm=it.arm[i])
            times.append(float(it.arm_time[i]))
            ways.append(1000 * float(np.linalg.norm(body.centre(place) - before)))
    there = int(np.argmax(np.array(ways) >= _THERE * max(ways)))
    return max(ways), times[there]


def words(name: str) -> str:
    """The name of a place in plain words."""
    return name.replace("_", " ")


_HEAD = (
    ("robot", "place", "force", "field", "withdrawn", "to motion", "cleared"),
    ("", "", "N", "", "mm", "ms", "ms"),
)


def table(rows: Sequence[TouchMetrics]) -> Iterator[str]:
    """Two header lines, then one line per touch; times count from the contact."""
    cells = [
        (
            touch.robot,
            words(touch.place),
            f"{touch.force:.1f}",
            words(touch.field) or "none",
            *(
                _number(value)
                for value in (touch.withdrawn, touch.moved_after, touch.cleared_after)
            ),
        )
        for touch in rows
    ]
    wide = [max(len(row[i]) for row in (*_HEAD, *cells)) for i in range(len(_HEAD[0]))]
    for row in (*_HEAD, *cells):
        texts = (
            text.ljust(width) if i in (0, 1, 3) else text.rjust(width)
            for i, (text, width) in enumerate(zip(row, wide, strict=True))
        )
        yield "  ".join(texts).rstrip()


def _number(value: float) -> str:
    return "never" if np.isnan(value) else f"{value:.0f}"
