"""A drawing as data: boxes, lines and words at places, in pixels, y down.

`templates/doc/drawing.svg.jinja` writes it; what a link leads to is a page, as in the text.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from robocomp_dsl.generate.doc.words import Target

CHARACTER = 7.3
"""Width of a character of the labels: a fixed-width font of 12 px, a little more than it needs."""
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
    """A path of SVG; `arrow` where it ends in one."""

    path: str
    kind: str
    about: str = ""
    arrow: bool = True


@dataclass(frozen=True, slots=True)
class Drawing:
    """Painted in this order: frames, lines, boxes. `about` is what it shows, in a sentence."""

    width: float
    height: float
    title: str
    about: str
    frames: tuple[Box, ...]
    lines: tuple[Line, ...]
    boxes: tuple[Box, ...]


def text_width(text: str) -> float:
    """Width of a label; characters beyond Latin and Greek are taken as wide."""
    return CHARACTER * sum(1 if ord(c) < 0x1100 else 2 for c in text)
