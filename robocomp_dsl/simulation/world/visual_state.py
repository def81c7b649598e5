"""The visual state of a world for remote viewers: the model once, then all poses.

In: a model and its state; in the viewer the received bytes and numbers. Out: the same. Values are
in MuJoCo's units: m, z up, quaternions w x y z.
"""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

VERSION: str = mujoco.mj_versionString()
"""MuJoCo version; only the same version can read a model."""

MOST_CONTACTS = 500


@dataclass(frozen=True, slots=True, eq=False)
class VisualState:
    """`positions` (nq,), `poses` (nbody, 7), `contacts` (n, 6): point and normal."""

    positions: Floats
    poses: Floats
    contacts: Floats


def capture(model: Any, data: Any) -> VisualState:
    """A copy of the visual state of `data`."""
    poses = np.empty((model.nbody, 7))
    poses[:, :3], poses[:, 3:] = data.xpos, data.xquat
    contacts = np.empty((min(data.ncon, MOST_CONTACTS), 6))
    if len(contacts):
        contacts[:, :3] = data.contact.pos[:MOST_CONTACTS]
        contacts[:, 3:] = data.contact.frame[:MOST_CONTACTS, :3]
    return VisualState(data.qpos.copy(), poses, contacts)


def to_mjb(model: Any) -> NDArray[np.uint8]:
    """The model in MuJoCo's binary format (MJB)."""
    buffer = np.empty(mujoco.mj_sizeModel(model), np.uint8)
    mujoco.mj_saveModel(model, None, buffer)
    return buffer


def from_mjb(data: NDArray[np.uint8]) -> Any:
    """The model in an MJB file. Raises `ValueError` for other data."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "model.mjb")
        path.write_bytes(data.tobytes())
        return mujoco.MjModel.from_binary_path(str(path))
