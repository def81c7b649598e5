"""A world for `rcgen view --live`, and the ports of its simulator in this process."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from robocomp_dsl.runtime.errors import NoServer
from tests.simulation.served_worlds import Served

WORLD = """\
<innerModel>
 <transform id="floor"/>
 <plane id="ground" ny="1" size="4000,4000,50" py="-25" texture="#606060"/>
 <differentialrobot id="robot" tx="-1000">
  <plane id="hull" nz="-1" py="500" size="900,900,900" texture="#ff0000"/>
  <joint id="neck" axis="y" min="-1" max="1" ty="900"/>
 </differentialrobot>
</innerModel>
"""


class SimulationPort:
    """The proxy of a port of a world in this process; `gone` while it has no server."""

    def __init__(self, world: Served, port: str = "Simulation") -> None:
        self.world, self.gone, self.port = world, False, port
        self.set_timeout: Callable[[float], None] = lambda seconds: None

    def __getattr__(self, operation: str) -> Any:
        if self.gone:
            raise NoServer("nobody is there")
        return getattr(self.world.ports[self.port], operation)
