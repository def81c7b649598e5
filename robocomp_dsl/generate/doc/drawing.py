"""A drawing as data: rectangles, curves and labels, in pixels, y down.

`templates/doc/drawing.svg.jinja` writes it; links lead to pages, as in the text.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import hypot
from typing import ClassVar

from robocomp_dsl.generate.doc.layered.layout import Point
from robocomp_dsl.generate.doc.target import Target

CHARACTER_WIDTH = 7.3
"""Width of a character of the labels, a fixed-width font of 12 px, with some reserve."""
FIRST_WIDE_CHARACTER = 0x1100
ARROW_LENGTH = 9.0
"""Length of the head of an arrow."""
LINE_HEIGHT = 17.0
"""Height of a line of such a label."""


@dataclass(frozen=True, slots=True)
class Label:
    """Text centred at (x, y); `kind` is its style."""

    x: float
    y: float
    text: str
    kind: str = ""
    target: Target | None = None


@dataclass(frozen=True, slots=True)
class Rectangle:
    """A rectangle with labels; `kind` is its style, `corner` the radius of its corners."""

    shape: ClassVar[str] = "rectangle"
    x: float
    y: float
    width: float
    height: float
    kind: str
    tooltip: str = ""
    corner: float = 8.0
    labels: tuple[Label, ...] = ()
    target: Target | None = None


@dataclass(frozen=True, slots=True)
class Curve:
    """An SVG path, and the path of its arrow head, which may be empty."""

    shape: ClassVar[str] = "curve"
    path: str
    arrow_head: str
    kind: str
    tooltip: str = ""


@dataclass(frozen=True, slots=True)
class Drawing:
    """Parts in painting order. `title` and `description` describe it to screen readers."""

    width: float
    height: float
    title: str
    description: str
    parts: tuple[Rectangle | Curve, ...]


def text_width(text: str) -> float:
    """Width of a label; characters above `FIRST_WIDE_CHARACTER` count double."""
    return CHARACTER_WIDTH * sum(1 if ord(c) < FIRST_WIDE_CHARACTER else 2 for c in text)


def draw_curve(
    points: Sequence[Point], kind: str, tooltip: str = "", *, arrow: bool = True
) -> Curve:
    """A path along Bézier curves, with an arrow at its end if `arrow` is set."""
    x, y = points[-1]
    bx, by = next((point for point in reversed(points) if point != points[-1]), (x - 1, y))
    length = hypot(x - bx, y - by) or 1.0
    dx, dy = (x - bx) / length, (y - by) / length
    end = (x - dx * ARROW_LENGTH * 0.8, y - dy * ARROW_LENGTH * 0.8) if arrow else (x, y)
    first, *rest = (*points[:-1], end)
    path = f"M{_format_point(first)}" + "".join(
        f"C{_format_point(a)} {_format_point(b)} {_format_point(c)}"
        for a, b, c in zip(*[iter(rest)] * 3, strict=True)
    )
    back, side = (x - dx * ARROW_LENGTH, y - dy * ARROW_LENGTH), ARROW_LENGTH * 0.42
    left, right = (
        (back[0] - dy * side, back[1] + dx * side),
        (back[0] + dy * side, back[1] - dx * side),
    )
    return Curve(
        path,
        f"M{_format_point((x, y))}L{_format_point(left)}L{_format_point(right)}Z" if arrow else "",
        kind,
        tooltip,
    )


def _format_point(point: Point) -> str:
    return f"{format_length(point[0])},{format_length(point[1])}"


def format_length(value: float) -> str:
    """A length with at most one decimal; the same on every machine."""
    return f"{round(value, 1) + 0.0:g}"


def translate(points: Iterable[Point], dx: float, dy: float) -> tuple[Point, ...]:
    """Points moved by (dx, dy)."""
    return tuple((x + dx, y + dy) for x, y in points)
