"""Handles of joints, as `InnerModel.getJoint` returns them.

A handle refers to its joint by id: it reads and sets the joint of the model, with the lock of the
model.
"""

# ruff: noqa: N802  names as in RoboComp

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from robocomp_dsl.innermodel.shared_state import Floats
from robocomp_dsl.model import innermodel

Read: TypeAlias = Callable[[str], float]
Write: TypeAlias = Callable[[str, float, bool], float]


class InnerModelJoint:
    """A hinge about `axis` (`x`, `y` or `z`); `min`, `max` and `home` are in rad."""

    def __init__(self, node: innermodel.Joint, read: Read, write: Write) -> None:
        self._read, self._write = read, write
        self.id, self.axis = node.id, node.axis
        self.min, self.max, self.home = node.min, node.max, node.home or 0.0

    def getAngle(self) -> float:
        """The angle in rad."""
        return self._read(self.id)

    def setAngle(self, angle: float, force: bool = False) -> float:
        """Set the angle in rad, within the limits unless `force`; returns what was set."""
        return self._write(self.id, angle, force)

    def unitaryAxis(self) -> Floats:
        """The axis in the frame of the joint; shape (3,)."""
        return np.array([float(self.axis == name) for name in "xyz"])


class InnerModelPrismaticJoint:
    """A slide along `axis`; `min`, `max`, `home` and `offset` are in mm."""

    def __init__(self, node: innermodel.PrismaticJoint, read: Read, write: Write) -> None:
        self._read, self._write = read, write
        self.id, self.axis, self.offset = node.id, node.axis, node.offset
        self.min, self.max, self.home = node.min, node.max, node.home or 0.0

    def getPosition(self) -> float:
        """The position in mm; the frame is `position` + `offset` from its parent."""
        return self._read(self.id)

    def setPosition(self, position: float, force: bool = False) -> float:
        """Set the position in mm, within the limits unless `force`; returns what was set."""
        return self._write(self.id, position, force)

    def unitaryAxis(self) -> Floats:
        """The axis in the frame of the joint; shape (3,)."""
        return np.array([float(self.axis == name) for name in "xyz"])
