"""The table that maps the interfaces of a simulated world to their servant classes."""

from __future__ import annotations

from collections.abc import Mapping

from robocomp_dsl.hardware.servants.servant import Servant
from robocomp_dsl.simulation.servants.inner_model import InnerModelServant
from robocomp_dsl.simulation.servants.simulation import SimulationServant

__all__ = ["WORLD_SERVANTS"]

WORLD_SERVANTS: Mapping[str, type[Servant]] = {
    "RoboCompInnerModelManager::InnerModelManager": InnerModelServant,
    "RoboCompSimulation::Simulation": SimulationServant,
}
"""Interface name to servant class, for operations that only a simulation can perform."""
