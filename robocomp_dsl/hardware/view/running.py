"""A simulation that runs elsewhere, as it is seen from here.

In: a proxy of `Simulation`, whoever serves it. Out: its model, and what was seen of its state.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mujoco

from robocomp_dsl.hardware.mujoco.sight import VERSION, Seen, read
from robocomp_dsl.hardware.simulation_interface import Sight, SimulationProxy


class CannotFollow(Exception):
    """The simulation is one that cannot be shown here; says why."""


@dataclass(slots=True)
class View:
    """A model and the latest that was seen of it."""

    revision: int
    model: Any
    sight: Sight

    def data(self) -> Any:
        """A state of MuJoCo with the joints as they were seen."""
        data = mujoco.MjData(self.model)
        data.qpos[:] = self.sight.positions
        mujoco.mj_forward(self.model, data)
        return data

    def seen(self) -> Seen:
        """What is to be seen."""
        it = self.sight
        return Seen(it.positions, it.poses.reshape(-1, 7), it.contacts.reshape(-1, 6))


def look_at(hand: SimulationProxy) -> View:
    """Model and state that belong together. Raises `CannotFollow`, `MiddlewareError`."""
    while True:
        told, sight = hand.getModel(), hand.getSight()
        if told.version != VERSION:
            raise CannotFollow(
                f"the simulation runs MuJoCo {told.version}, here is {VERSION}:"
                " both must be the same"
            )
        if told.revision == sight.revision:
            return View(told.revision, read(told.data), sight)
