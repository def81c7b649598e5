"""Worlds for the tests, and the programs that run on what is generated from them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from robocomp_dsl.check import check_innermodel
from robocomp_dsl.check.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.scene import lower
from robocomp_dsl.hardware.mujoco.simulation import Options, Simulation
from robocomp_dsl.hardware.scene import Scene

RCGEN = Path(sys.executable).with_name("rcgen")

WALL_Z = 3000.0
"""Where the front of the wall is, seen from the middle of the room, in mm."""

ROOM = f"""\
<innerModel>
  <transform id="floor">
    <plane id="ground" ny="1" size="10000,10000,50" py="-25" texture="#886644" repeat="1"/>
    <plane id="wall" nz="-1" pz="{WALL_Z + 25}" py="500" size="6000,1000,50" collide="1"/>
    <differentialrobot id="robot" tx="500" tz="-300">
      <translation id="laser_pose" ty="140" tz="200">
        <laser id="laser" measures="101" min="100" max="30000" angle="1"/>
      </translation>
      <plane id="hull" nz="-1" py="100" size="400,190,400"/>
    </differentialrobot>
    <omnirobot id="platform" tx="-2000"/>
  </transform>
</innerModel>
"""


def scene_of(path: Path, text: str) -> Scene:
    """The scene of a world without findings."""
    path.write_text(text)
    report = Report()
    body = check_innermodel(path, Workspace(environ={}), report)
    assert [one.message for one in report] == []
    assert body is not None
    return Scene.of_data(lower(body))


def simulated(folder: Path, text: str, options: Options = Options()) -> Simulation:
    """A simulation that does not run: the test advances it."""
    return Simulation(scene_of(folder / "world.xml", text), options)


def rcgen(*arguments: str | Path, cwd: Path) -> subprocess.CompletedProcess[str]:
    """Run the command."""
    return subprocess.run(
        [RCGEN, *arguments], cwd=cwd, capture_output=True, text=True, timeout=120, check=False
    )


CLIENT = """
import os, sys, time, traceback
from types import SimpleNamespace
from robocomp_dsl.runtime.execution import Execution
from robocomp_dsl.runtime.middleware import open_middleware
from robocomp_dsl.runtime.middleware.base import Endpoint, Host
from robocomp_dsl.runtime.statistics import Statistics
from generated import interfaces as i

middleware = open_middleware(sys.argv[1], Host("client", sys.argv[2], Execution(), Statistics()))

def proxy(interface, port):
    link = middleware.proxy(Endpoint(interface, "client", "x", (sys.argv[3] + "." + port,)))
    assert link.wait(30), port
    return SimpleNamespace(**{one.name: link.bind(one) for one in interface.operations})

def until(what):
    end = time.monotonic() + 30
    while not what():
        assert time.monotonic() < end, "it did not come true in time"
        time.sleep(0.01)

def refused(kind, call, *given):
    try:
        call(*given)
    except kind as error:
        return error
    raise AssertionError(f"{given} were taken")
"""


def run(folder: Path, code: str, *arguments: str) -> str:
    """A Python program in the folder of a generated component; what it prints."""
    done = subprocess.run(
        [sys.executable, "-c", code, *arguments],
        cwd=folder,
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": ""},
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout
