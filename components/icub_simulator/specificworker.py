"""icub_simulator: a running world. Written once by rcgen; from now on this file is yours."""

from __future__ import annotations

from generated.simulator import Simulator


class SpecificWorker(Simulator):
    """The simulator as it comes; methods that stand here win over those of `Simulator`.

    `self.simulation` is the world: touch it under `with self.simulation.turns:`.
    """
