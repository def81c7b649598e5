"""A drawing as data: boxes, lines and words at places, in pixels, y down.

`templates/doc/drawing.svg.jinja` writes it; what a link leads to is a page, as in the text.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import hypot
from typing import TYPE_CHECKING, ClassVar

from robocomp_dsl.generate.doc.layered import Point

if TYPE_CHECKING:
    from robocomp_dsl.generate.doc.words import Target

CHARACTER = 7.3
"""Width of a character of the labels: a fixed-width font of 12 px, a little more than it needs."""
FIRST_WIDE = 0x1100
HEAD = 9.0
"""Length of the head of an arrow."""
LINE = 17.0
"""Height of a line of such a label."""


@dataclass(frozen=True, slots=True)
class Label:
    """Words centred around (x, y); `kind` is their style."""

    x: float
    y: float
    text: str
    kind: str = ""
    target: Target | None = None


@dataclass(frozen=True, slots=True)
class Box:
    """A rectangle with its words; `kind` is its style, `corner` the radius of its corners."""

    sort: ClassVar[str] = "box"
    x: float
    y: float
    width: float
    height: float
    kind: str
    about: str = ""
    corner: float = 8.0
    labels: tuple[Label, ...] = ()
    target: Target | None = None


@dataclass(frozen=True, slots=True)
class Line:
    """A path of SVG, and that of the head of its arrow, which may be empty."""

    sort: ClassVar[str] = "line"
    path: str
    head: str
    kind: str
    about: str = ""


@dataclass(frozen=True, slots=True)
class Drawing:
    """Parts, painted in this order. `title` and `about` say what it shows to those who see none."""

    width: float
    height: float
    title: str
    about: str
    parts: tuple[Box | Line, ...]


def text_width(text: str) -> float:
    """Width of a label; characters beyond Latin, Greek and the like are taken as wide."""
    return CHARACTER * sum(1 if ord(c) < FIRST_WIDE else 2 for c in text)


def line(points: Sequence[Point], kind: str, about: str = "", *, arrow: bool = True) -> Line:
    """A line along Bézier curves, which has an arrow at its end."""
    x, y = points[-1]
    bx, by = next((one for one in reversed(points) if one != points[-1]), (x - 1, y))
    length = hypot(x - bx, y - by) or 1.0
    dx, dy = (x - bx) / length, (y - by) / length
    end = (x - dx * HEAD * 0.8, y - dy * HEAD * 0.8) if arrow else (x, y)
    first, *rest = (*points[:-1], end)
    path = f"M{_at(first)}" + "".join(
        f"C{_at(a)} {_at(b)} {_at(c)}" for a, b, c in zip(*[iter(rest)] * 3, strict=True)
    )
    back, side = (x - dx * HEAD, y - dy * HEAD), HEAD * 0.42
    left, right = (
        (back[0] - dy * side, back[1] + dx * side),
        (back[0] + dy * side, back[1] - dx * side),
    )
    return Line(path, f"M{_at((x, y))}L{_at(left)}L{_at(right)}Z" if arrow else "", kind, about)


def _at(point: Point) -> str:
    return f"{number(point[0])},{number(point[1])}"


def number(value: float) -> str:
    """A length with one decimal, as short as it can be; the same on every machine."""
    return f"{round(value, 1) + 0.0:g}"


def shifted(points: Iterable[Point], dx: float, dy: float) -> tuple[Point, ...]:
    """Points somewhere else."""
    return tuple((x + dx, y + dy) for x, y in points)
