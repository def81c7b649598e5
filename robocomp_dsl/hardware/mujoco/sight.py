"""A world as those see it who only look: the model once, then where everything is.

In: a model and its state; on the other side the bytes and numbers that came over. Out: the same.
Numbers are MuJoCo's: m, z up, quaternions w x y z.
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
"""Another MuJoCo reads no models of this one."""

MOST_CONTACTS = 500


@dataclass(frozen=True, slots=True, eq=False)
class Seen:
    """`positions` (nq,), `poses` (nbody, 7), `contacts` (n, 6): point and normal."""

    positions: Floats
    poses: Floats
    contacts: Floats


def seen(model: Any, data: Any) -> Seen:
    """What is to be seen of a state; copies."""
    poses = np.empty((model.nbody, 7))
    poses[:, :3], poses[:, 3:] = data.xpos, data.xquat
    contacts = np.empty((min(data.ncon, MOST_CONTACTS), 6))
    if len(contacts):
        contacts[:, :3] = data.contact.pos[:MOST_CONTACTS]
        contacts[:, 3:] = data.contact.frame[:MOST_CONTACTS, :3]
    return Seen(data.qpos.copy(), poses, contacts)


def written(model: Any) -> NDArray[np.uint8]:
    """The model as MuJoCo's own format (MJB) has it."""
    made = np.empty(mujoco.mj_sizeModel(model), np.uint8)
    mujoco.mj_saveModel(model, None, made)
    return made


def read(data: NDArray[np.uint8]) -> Any:
    """The model in an MJB file. Raises `ValueError` for anything else."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "model.mjb")
        path.write_bytes(data.tobytes())
        return mujoco.MjModel.from_binary_path(str(path))
