"""Findings in a model file, and the error for a file that cannot be loaded."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from robocomp_dsl.hardware.devices.errors import SceneError

Kind: TypeAlias = Literal[
    "file",  # the file contains something invalid
    "tree",  # parts that do not form one tree
    "joint",
    "mass",  # a moving part without mass
    "mesh",  # a mesh replaced by its bounding box
    "texture",
    "size",
    "overlap",  # bodies that collide in the initial pose
]


@dataclass(frozen=True, slots=True)
class ModelFinding:
    """`subject` is the node or link, `line` counts from 1, 0: unknown."""

    kind: Kind
    subject: str
    message: str
    line: int = 0

    def __str__(self) -> str:
        return f"line {self.line}: {self.message}" if self.line else self.message


class ModelFileError(SceneError):
    """A model file that cannot be used: the first reason, its line (0: unknown), all reasons."""

    def __init__(self, message: str, line: int = 0, faults: tuple[ModelFinding, ...] = ()) -> None:
        super().__init__(f"line {line}: {message}" if line else message)
        self.faults = faults or (ModelFinding("file", "", message, line),)
