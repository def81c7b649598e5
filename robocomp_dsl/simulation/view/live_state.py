"""Fetches the model and the state of a running simulation.

In: a proxy of `Simulation`, served by any component. Out: its model and its visual state.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mujoco

from robocomp_dsl.simulation.simulation_interface import Sight, SimulationProxy
from robocomp_dsl.simulation.world.visual_state import VERSION, VisualState, from_mjb


class UnsupportedSimulation(Exception):
    """The simulation cannot be shown here; the message gives the reason."""


@dataclass(slots=True)
class LiveState:
    """A model and its latest visual state."""

    revision: int
    model: Any
    sight: Sight

    def data(self) -> Any:
        """An `MjData` with the received joint positions."""
        data = mujoco.MjData(self.model)
        data.qpos[:] = self.sight.positions
        mujoco.mj_forward(self.model, data)
        return data

    def visual_state(self) -> VisualState:
        """The visual state."""
        it = self.sight
        return VisualState(it.positions, it.poses.reshape(-1, 7), it.contacts.reshape(-1, 6))


def fetch_live_state(simulation: SimulationProxy) -> LiveState:
    """Model and state of one revision. Raises `UnsupportedSimulation`, `MiddlewareError`."""
    while True:
        model, sight = simulation.getModel(), simulation.getSight()
        if model.version != VERSION:
            raise UnsupportedSimulation(
                f"the simulation runs MuJoCo {model.version}, this machine has {VERSION}:"
                " the versions must be equal"
            )
        if model.revision == sight.revision:
            return LiveState(model.revision, from_mjb(model.data), sight)
