"""Random InnerModel worlds: every tag, every default, and unusual values.

In: a number. Out: files of one InnerModel world, well formed, by their names; `world.xml` is first.
The same number gives the same files.
"""

from __future__ import annotations

import random
from collections.abc import Mapping

from robocomp_dsl.check.innermodel.tags import (
    ANGLE,
    ANGLE_LIMIT,
    EXTENT,
    FLAG,
    LENGTH,
    LENGTH_LIMIT,
    LENGTHS,
    LIMIT,
    MASS,
    NUMBER,
    SCALE,
    TAGS,
    TEXT,
    WHOLE,
    Kind,
)

_USUAL = ("0", "1", "-1", "0.5", "-250", "1e3", "3.14159265", "1570", "0.0001", ".5", "-.1", "+2")
_HUGE = ("1e300", "-1e300", "1e-300", "-1e9", "9999999999")
_NUMBERS = (*_USUAL, *_USUAL, *_HUGE)
_ODD_NUMBERS = ("", "0,5", "abc", "1e999", "nan", "1 2", "--3", "0x10", "1.2.3")
_VALUES: Mapping[Kind, tuple[str, ...]] = {
    NUMBER: _NUMBERS,
    LENGTH: (*_NUMBERS, "0.5 m", "1e7"),
    ANGLE: (*_NUMBERS, "90 deg"),
    MASS: ("0", "1", "0.001", "-3", "1000", "200 g"),
    LIMIT: (*_NUMBERS, "inf", "-inf"),
    ANGLE_LIMIT: (*_NUMBERS, "inf"),
    LENGTH_LIMIT: (*_NUMBERS, "-inf"),
    WHOLE: ("0", "1", "10004", "-1", "640", "2147483647"),
    EXTENT: (
        *("1", "0", "100,200,300", "0,0,0", "2000,1000", "-5,5,5", "1e6,1e6,1e-6", "10, 20, 30"),
        *("1e300", "1e-300,1,1", "inf", "2500,1e9,10"),
    ),
    SCALE: (
        *("1", "1,1,1", "0.01", "1000,1000,1000", "0,1,1", "-1,1,1", "2,3"),
        *("1e300", "1e-300", "inf", "1e9,1e-9,1"),
    ),
    LENGTHS: ("1,2", "33 mm, 60 mm"),
    FLAG: ("0", "1", "true", ""),
    TEXT: (
        "",
        "a",
        "wall texture.jpg",
        "#00ff00",
        "#zzz",
        "/opt/files/osgModels/x.3ds",
    ),
}
_FILES = (
    "gone.obj", "gone.ive", "gone.osg", "gone.3ds", "", "/opt/robocomp/x.osg", "folder",
    "damaged.obj", "cube.obj", "flat.obj", "points.osg", "letters.stl",
)  # fmt: skip
_IDS = (
    *("a", "b", "c", "world", "root", "robot", "räder", "a b", "x/y", "f#2", "100", "A"),
    *(
        "import",
        "self",
        "None",
        "int32",
        "list",
        "_x",
        "x&quot;y",
        "a\\b",
        "`q`",
        "a&#10;b",
        "L" * 300,
    ),
    *("simulation", "Simulation", "JointMotor", "clock", "component", "compute", "params", "a.b"),
)


def random_world(seed: int) -> dict[str, str]:
    """The files of one world."""
    rng = random.Random(seed)
    maker = _Maker(rng)
    inside = maker.many(0, rng.choice((0, 3, 10, 40)))
    files = {"world.xml": maker.file(inside)}
    for name in maker.included:
        child = _Maker(random.Random(f"{seed}{name}"))
        files[name] = child.file(child.many(0, 4))
    return files


class _Maker:
    def __init__(self, rng: random.Random) -> None:
        self.rng = rng
        self.odd = rng.random() < 0.3
        self.count = 0
        self.included: set[str] = set()

    def file(self, inside: str) -> str:
        root = self.rng.choice(("innerModel", "innermodel", "InnerModel"))
        head = self.rng.choice(("", '<?xml version="1.0" encoding="UTF-8" ?>\n', "\ufeff"))
        return f"{head}<{root}>\n{inside}</{root}>\n"

    def many(self, depth: int, count: int) -> str:
        return "".join(self.element(depth) for _ in range(count))

    def element(self, depth: int) -> str:
        if self.rng.random() < 0.05:
            return self.include()
        if self.rng.random() < 0.05:
            return "<!-- - a comment & <such> -->\n"
        name = self.rng.choice(tuple(TAGS))
        if self.rng.random() < 0.4:
            name = self.rng.choice(("transform", "plane", "mesh", "joint"))
        written = self.rng.choice((name, name, name, name.upper(), name.capitalize()))
        attributes = "".join(self.attributes(name))
        deep = 60 if self.rng.random() < 0.02 else 6
        inside = ""
        if TAGS[name].holds and depth < deep:
            inside = self.many(depth + 1, self.rng.choice((0, 0, 1, 2) if depth > 1 else (1, 2, 3)))
        if TAGS[name] is TAGS["touchsensor"]:
            inside += '<plane collide="1"/>\n'  # without a shape that collides it is an error
        if self.odd and self.rng.random() < 0.1:
            inside += "stray text &amp; such"
        return (
            f"<{written}{attributes}>{inside}</{written}>\n"
            if inside
            else f"<{written}{attributes}/>\n"
        )

    def include(self) -> str:
        name = self.rng.choice(("part.xml", "world.xml", "gone.xml", "other.xml"))
        if name in ("part.xml", "other.xml"):
            self.included.add(name)
        folder = self.rng.choice(("", "./", "/home/somebody/else/"))
        return f'<include path="{folder}{name}"/>\n'

    def attributes(self, name: str) -> list[str]:
        result = []
        known = TAGS[name].attributes
        for attribute, kind in known.items():
            likely = 0.9 if attribute in {"id", "file"} else 0.35
            if self.rng.random() < likely:
                result.append(f' {attribute}="{self.value(attribute, kind)}"')
        if self.odd and self.rng.random() < 0.1:
            result.append(' x="3"')
        self.rng.shuffle(result)
        return result

    def value(self, attribute: str, kind: Kind) -> str:
        if attribute == "id":
            self.count += 1
            unique = self.rng.random() < 0.8
            return f"node{self.count}" if unique else self.rng.choice(_IDS)
        if attribute == "file":
            return self.rng.choice(_FILES)
        if self.odd and self.rng.random() < 0.05:
            return self.rng.choice(_ODD_NUMBERS)
        if isinstance(kind, tuple):
            return self.rng.choice((*kind, kind[0].upper()))
        return self.rng.choice(_VALUES[kind])
