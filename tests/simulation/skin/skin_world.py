"""A simulated table with skin and a cube on it."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from robocomp_dsl.hardware.devices.skin import SkinSettings
from tests.simulation.served_worlds import Served

TABLE = """\
<innerModel>
  <transform id="table">
    <plane id="top" ny="1" py="-25" size="400,400,50" collide="1"/>
    <skin id="touch" rate="50">
      <patch id="fine" firstid="100" gain="0.05" floor="2" saturation="240">
{taxels}
      </patch>
    </skin>
  </transform>
  <transform id="weight" tx="{x}" ty="29.9" tz="{z}" engine="bullet" mass="{mass}">
    <plane id="cube" size="60,60,60" ny="1" collide="1"/>
  </transform>
</innerModel>
"""
PITCH = 8.0


def table(x: float = 0.0, z: float = 0.0, mass: float = 0.1, side: int = 12) -> str:
    """A square of taxels on a table, and a cube of `mass` kg on it at (x, z) mm."""
    at = [(i - (side - 1) / 2) * PITCH for i in range(side)]
    rows = [f'        <taxel x="{a:g}" z="{b:g}" ny="1"/>' for a in at for b in at]
    return TABLE.format(taxels="\n".join(rows), x=x, z=z, mass=mass)


TWO_PATCHES = """\
        <taxel x="300" z="0" ny="1"/>
      </patch>
      <patch id="coarse" firstid="500" gain="0.1" ty="0 mm" tx="10" rz="180 deg">
        <taxel x="-300" ny="-1"/>
      </patch>"""


class SkinWorld(Served):
    """A table with skin and a cube on it, with the published frames and touches."""

    def __init__(self, served: Served) -> None:
        super().__init__(served.simulation, served.ports, served.types)
        object.__setattr__(self, "frames", [])
        object.__setattr__(self, "touches", [])
        frames = SimpleNamespace(frame=self.frames.append, has_subscribers=lambda: True)
        touches = SimpleNamespace(contacts=self.touches.append, has_subscribers=lambda: True)
        served.ports["Skin"].publish(frames, touches)

    frames: list[Any]
    touches: list[Any]

    def go(self, seconds: float) -> Any:
        """Advance time. Returns the last published frame."""
        self.simulation.advance(seconds)
        self.simulation.dispatch_events()
        return self.frames[-1]

    def set_up(self, **values: Any) -> None:
        with self.simulation.lock:
            self.simulation.set_skin(SkinSettings(**values))
