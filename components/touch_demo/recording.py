"""The data of one robot's touches, stored in a file.

In: data published while a finger presses. Out: a `Recording`, written to and read from one `.npz`
file. Times are simulated time stamps of the components in s; lengths in m, forces in N, angles in
rad.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Skin:
    """Positions of the n taxels: `points` and `normals` (n, 3) in the frames of their limbs.

    `limb` (n,) is an index into the limbs; limb i has the frame `origins[i]` (3,) and `axes[i]`
    (3, 3) on the body `bodies[i]`.
    """

    points: Floats
    normals: Floats
    limb: Ints
    limbs: tuple[str, ...]
    bodies: tuple[str, ...]
    origins: Floats
    axes: Floats

    def of(self, limb: str) -> Ints:
        """The taxels of one limb."""
        return np.flatnonzero(self.limb == self.limbs.index(limb))

    def placed(self, limb: str, points: Floats) -> Floats:
        """Points (..., 3) of a limb's frame in the frame of its body."""
        i = self.limbs.index(limb)
        carried: Floats = points @ self.axes[i].T + self.origins[i]
        return carried


@dataclass(frozen=True, slots=True, eq=False)
class Place:
    """A receptive field: `centre` (3,) and `radius` in the frame of `limb` (part and limb)."""

    name: str
    limb: str
    centre: Floats
    radius: float


@dataclass(frozen=True, slots=True)
class Press:
    """The finger was moved to the place between two times; before `began` it was out of reach."""

    place: str
    began: float
    ended: float


@dataclass(frozen=True, slots=True)
class Answer:
    """The response of a field to a touch at `time`."""

    time: float
    field: str
    gain: float
    force: float


@dataclass(frozen=True, slots=True, eq=False)
class Recording:
    """One robot, one arm. `force` (frames, n), `arm` (states, 5), `finger` (samples, 3).

    `rest` are the angles of all joints of the robot before the first touch, by name.
    """

    robot: str
    part: str
    skin: Skin
    places: tuple[Place, ...]
    presses: tuple[Press, ...]
    answers: tuple[Answer, ...]
    frame_time: Floats
    force: Floats
    arm_time: Floats
    arm: Floats
    finger_time: Floats
    finger: Floats
    rest: Mapping[str, float]

    def place(self, name: str) -> Place:
        """The place of that name; raises `KeyError` if there is none."""
        return {place.name: place for place in self.places}[name]


_ARRAYS = ("frame_time", "force", "arm_time", "arm", "finger_time", "finger")
_SKIN_ARRAYS = ("points", "normals", "limb", "origins", "axes")


def save(it: Recording, file: Path) -> None:
    """Write the file; missing folders are created."""
    words = {
        "robot": it.robot,
        "part": it.part,
        "limbs": it.skin.limbs,
        "bodies": it.skin.bodies,
        "places": [{**_plain(place), "centre": place.centre.tolist()} for place in it.places],
        "presses": [asdict(press) for press in it.presses],
        "answers": [asdict(answer) for answer in it.answers],
        "rest": dict(it.rest),
    }
    arrays = {name: getattr(it, name) for name in _ARRAYS}
    arrays |= {f"skin_{name}": getattr(it.skin, name) for name in _SKIN_ARRAYS}
    file.parent.mkdir(parents=True, exist_ok=True)
    with file.open("wb") as out:
        np.savez_compressed(out, words=np.array(json.dumps(words)), **arrays)


def load(file: Path) -> Recording:
    """Read a file written by `save`."""
    with np.load(file, allow_pickle=False) as found:
        words: dict[str, Any] = json.loads(str(found["words"]))
        skin = Skin(
            limbs=tuple(words["limbs"]),
            bodies=tuple(words["bodies"]),
            **{name: found[f"skin_{name}"] for name in _SKIN_ARRAYS},
        )
        places = (
            Place(**{**entry, "centre": np.array(entry["centre"])}) for entry in words["places"]
        )
        return Recording(
            robot=words["robot"],
            part=words["part"],
            skin=skin,
            places=tuple(places),
            presses=tuple(Press(**entry) for entry in words["presses"]),
            answers=tuple(Answer(**entry) for entry in words["answers"]),
            rest=words["rest"],
            **{name: found[name] for name in _ARRAYS},
        )


def _plain(place: Place) -> dict[str, Any]:
    return {field.name: getattr(place, field.name) for field in fields(place)}
