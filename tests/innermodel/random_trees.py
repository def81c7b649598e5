"""Random valid InnerModel files, and their poses computed another way.

In: a number. Out: the text of a file, and `Poses`, which multiplies matrices of its own, read by
another XML library.
"""

from __future__ import annotations

import random
from xml.etree import ElementTree as ET

import numpy as np
from numpy.typing import NDArray

Matrix = NDArray[np.float64]
FRAMES = ("transform", "translation", "rotation", "joint", "prismaticjoint", "omnirobot")
LEAVES = ("laser", "camera", "plane", "mesh", "imu")
_POSES = {
    "transform": ("tx", "ty", "tz", "rx", "ry", "rz"),
    "translation": ("tx", "ty", "tz"),
    "rotation": ("rx", "ry", "rz"),
    "joint": ("tx", "ty", "tz", "rx", "ry", "rz"),
    "omnirobot": ("tx", "ty", "tz", "rx", "ry", "rz"),
}


def random_tree(
    seed: int,
    size: int = 25,
    frames: tuple[str, ...] = FRAMES,
    leaves: tuple[str, ...] = LEAVES,
) -> str:
    """A file with `size` frames, about half as many leaves, comments, and mixed layout."""
    rng = random.Random(seed)
    parents: dict[str, str] = {}
    tags: dict[str, str] = {}
    for number in range(size):
        parents[f"f{number}"] = rng.choice([*(["root"] if not number else parents), *parents])
        tags[f"f{number}"] = rng.choice(frames)
    for number in range(size // 2):
        parents[f"leaf{number}"] = f"f{rng.randrange(size)}"
        tags[f"leaf{number}"] = rng.choice(leaves)

    def element(name: str, depth: int) -> str:
        indent = rng.choice(("    ", "\t", "  ")) * depth
        quoted = rng.choice(QUOTES).format(name)
        head = f"{indent}<{tags[name]} id={quoted}{_attributes(tags[name], rng)}"
        inside = "".join(element(child, depth + 1) for child in parents if parents[child] == name)
        note = rng.choice(("", "", f"{indent}<!-- {name} & <such> -->\n"))
        if not inside:
            return f"{note}{head}{rng.choice(('/>', ' />', f'></{tags[name]}>'))}\n"
        return f"{note}{head}>\n{inside}{indent}</{tags[name]}>\n"

    roots = "".join(element(name, 1) for name in parents if parents[name] == "root")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n<innerModel>\n{roots}</innerModel>\n'


QUOTES = ('"{}"', "'{}'")


def _attributes(tag: str, rng: random.Random) -> str:
    texts: list[str] = []
    for name in _POSES.get(tag, ()):
        if rng.random() < 0.7:
            size = 3.0 if name.startswith("r") else 800.0
            texts.append(f'{name}="{rng.uniform(-size, size):.{rng.randint(0, 12)}f}"')
    if tag == "joint":
        texts += [f'axis="{rng.choice("xyz")}"', 'min="-4"', 'max="4"']
    if tag == "prismaticjoint":
        texts += [f'axis="{rng.choice("xyz")}"', f'position="{rng.uniform(-300, 300):.3f}"']
        texts += [f'offset="{rng.randint(-50, 50)}"', 'min="-900"', 'max="900"']
    if tag == "mesh":
        texts += ['file="part.stl"', 'tx="100"']
    if tag == "camera":
        texts += ['width="640"', 'height="480"', 'focal="500"']
    rng.shuffle(texts)
    return "".join(rng.choice((" ", "  ", "\n      ")) + text for text in texts)


class Poses:
    """The matrices of a file; `local` may be changed."""

    def __init__(self, text: str) -> None:
        self.parent: dict[str, str] = {"root": ""}
        self.local: dict[str, Matrix] = {"root": np.eye(4)}
        self.attributes: dict[str, dict[str, str]] = {}
        self.tags: dict[str, str] = {}
        self._read(ET.fromstring(text), "root")

    def _read(self, element: ET.Element, parent: str) -> None:
        for child in element:
            node = child.attrib["id"]
            self.parent[node], self.tags[node] = parent, child.tag
            self.attributes[node] = dict(child.attrib)
            values = {
                k: float(v) for k, v in child.attrib.items() if k[0] in "tr" and k[1:] in "xyz"
            }
            if child.tag == "mesh":  # RoboComp: seen at the frame that holds it
                values = {}
            if child.tag == "prismaticjoint":
                shift = float(child.attrib["position"]) + float(child.attrib["offset"])
                values = {f"t{child.attrib['axis']}": shift}
            self.local[node] = pose_matrix(*(values.get(n, 0.0) for n in _POSES["transform"]))
            self._read(child, node)

    def in_root(self, name: str) -> Matrix:
        """The pose of a node in the root."""
        matrix = np.eye(4)
        while name:
            matrix, name = self.local[name] @ matrix, self.parent[name]
        return matrix

    def between(self, to: str, start: str) -> Matrix:
        """The transform of points from `start` to `to`."""
        return np.linalg.inv(self.in_root(to)) @ self.in_root(start)


def pose_matrix(tx: float, ty: float, tz: float, rx: float, ry: float, rz: float) -> Matrix:
    """T(t) · Rx · Ry · Rz, one matrix each."""
    x, y, z = (np.eye(4) for _ in range(3))
    x[1:3, 1:3] = [[np.cos(rx), -np.sin(rx)], [np.sin(rx), np.cos(rx)]]
    y[0, [0, 2]] = np.cos(ry), np.sin(ry)
    y[2, [0, 2]] = -np.sin(ry), np.cos(ry)
    z[:2, :2] = [[np.cos(rz), -np.sin(rz)], [np.sin(rz), np.cos(rz)]]
    shift = np.eye(4)
    shift[:3, 3] = tx, ty, tz
    return shift @ x @ y @ z
