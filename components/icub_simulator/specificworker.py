"""icub_simulator: a running world. Generated once by rcgen; this file is yours."""

from __future__ import annotations

from icub_simulator_generated.simulator import Simulator


class SpecificWorker(Simulator):
    """The generated simulator; methods defined here override those of `Simulator`.

    `self.simulation` is the world: access it under `with self.simulation.lock:`.
    """
