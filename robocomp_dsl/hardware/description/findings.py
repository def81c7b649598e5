"""Findings in a model file, and the error for a file that cannot be loaded."""

from __future__ import annotations

from typing import Literal, TypeAlias

from robocomp_dsl.finding import Finding, Location, SourceText
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
    "unlikely",  # a value that is probably a mistake
    "range",  # limits of a joint that are probably a mistake
]

MODEL_TEXT = SourceText("")
"""The text of a model file: its reader knows the path; findings contain only the line."""


def model_finding(kind: Kind, subject: str, message: str, line: int = 0) -> Finding:
    """A finding about the node or link `subject`; `line` counts from 1, 0: unknown."""
    return Finding(Location(MODEL_TEXT, line), message, kind=kind, subject=subject)


class ModelFileError(SceneError):
    """A model file that cannot be used; `findings` are all reasons, `line` 0: unknown."""

    def __init__(self, message: str, line: int = 0, findings: tuple[Finding, ...] = ()) -> None:
        super().__init__(f"line {line}: {message}" if line else message)
        self.findings = findings or (model_finding("file", "", message, line),)
