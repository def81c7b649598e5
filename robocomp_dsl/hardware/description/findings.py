"""What is not as described in a model, and the error for one that cannot be loaded."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from robocomp_dsl.hardware.devices.errors import SceneError

Kind: TypeAlias = Literal[
    "file",  # the file says something that cannot be understood
    "tree",  # parts that do not make one tree
    "joint",
    "mass",  # something moves and weighs nothing
    "mesh",  # a mesh that is shown as a box
    "texture",
    "size",
    "overlap",  # bodies that collide before anything has moved
]


@dataclass(frozen=True, slots=True)
class ModelFinding:
    """`said` is for the user; `subject` is the node or link, `line` counts from 1, 0: unknown."""

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
