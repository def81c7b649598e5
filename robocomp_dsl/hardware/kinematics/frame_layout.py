"""The matrices of a tree of frames, arranged so that an update needs few calls of numpy.

In: the frames, level by level. Out: arrays of matrices in the parents (`local`) and in the root
(`world`). Frames of one depth are neighbours, so that a level is one product of two slices.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from robocomp_dsl.hardware.kinematics.rotations import Matrix, pose_rows


class FrameLayout:
    """`rows` maps an id to its row in `local` and `world`, both of shape (n, 4, 4).

    `levels` lists (id, id of the parent, pose); the first level is the root alone.
    """

    def __init__(self, levels: Sequence[Sequence[tuple[str, str, Sequence[float]]]]) -> None:
        everything = [node for level in levels for node in level]
        self.rows = {node[0]: row for row, node in enumerate(everything)}
        self.local = np.zeros((len(everything), 4, 4))
        self.local[:, 3, 3] = 1.0
        self.local[:, :3] = [pose_rows(pose) for _, _, pose in everything]
        self.world = self.local.copy()
        room = np.empty_like(self.local)
        self._steps: list[tuple[Matrix, Matrix, NDArray[np.intp], Matrix]] = []
        start = 1
        for level in levels[1:]:
            end = start + len(level)
            parents = np.array([self.rows[parent] for _, parent, _ in level])
            here = slice(start, end)
            self._steps.append((self.local[here], self.world[here], parents, room[here]))
            start = end

    def set_pose(self, frame: str, pose: Sequence[float]) -> None:
        """Set the pose of a frame in its parent; takes effect with `refresh`."""
        self.local[self.rows[frame], :3] = pose_rows(pose)

    def refresh(self) -> None:
        """Compute `world` from `local`."""
        take, multiply = self.world.take, np.matmul
        for local, world, parents, room in self._steps:
            multiply(take(parents, 0, out=room, mode="clip"), local, world)
