"""Worlds for the tests, and the programs that run on what is generated from them."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import types
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from robocomp_dsl.check.passes import check_cdsl, check_innermodel
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli.rcgen.simulation.simulator_model import model_world
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.names import package_of
from robocomp_dsl.generate.scene.scene import lower_body
from robocomp_dsl.generate.simulator.simulator import (
    Simulator,
    descriptions,
    files,
    serving_also,
    simulator,
)
from robocomp_dsl.hardware.description.scene import Scene
from robocomp_dsl.hardware.servants.serving import DevicePort
from robocomp_dsl.runtime import ServedPort
from robocomp_dsl.simulation.world.simulation import Simulation, SimulationOptions
from tests.support import waiting
from tests.support.generated_package import with_package

MYPY = [sys.executable, "-m", "mypy", "--strict", "--config-file=", "--no-error-summary"]
RUFF = str(shutil.which("ruff"))
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
      <imu id="inertia"/>
      <touchsensor id="bump" type="bumper">
        <plane id="bump_plate" py="30" pz="210" size="300,40,10" collide="1"/>
      </touchsensor>
      <joint id="neck" axis="y" min="-1" max="1"/>
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
    assert [finding.message for finding in report] == []
    assert body is not None
    return Scene.of_data(lower_body(body))


OPEN: list[Simulation] = []
"""Simulations of the running test; `conftest` stops them after it."""


def opened(simulation: Simulation) -> Simulation:
    """The simulation, which is stopped after the test."""
    OPEN.append(simulation)
    return simulation


def simulated(folder: Path, text: str, options: SimulationOptions | None = None) -> Simulation:
    """A simulation that does not run: the test advances it."""
    scene = scene_of(folder / "world.xml", text)
    return opened(Simulation(scene, options or SimulationOptions()))


def rcgen(*arguments: str | Path, cwd: Path) -> subprocess.CompletedProcess[str]:
    """Run the command."""
    return subprocess.run(
        [RCGEN, *arguments], cwd=cwd, capture_output=True, text=True, timeout=300, check=False
    )


CLIENT = """
import os, sys, time, traceback
sys.path.append("SUPPORT")
from waiting import wait_until
from types import SimpleNamespace
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.connection.component_ports import open_ports
from robocomp_dsl.runtime.connection.endpoint import Endpoint
from robocomp_dsl.runtime.connection.ports import ComponentContext
from robocomp_dsl.runtime.component.statistics import Statistics
from PACKAGE import interfaces as i

host = ComponentContext("client", sys.argv[2], CallbackGroup(), Statistics())
middleware = open_ports(sys.argv[1], host)

def proxy(interface, port):
    link = middleware.proxy(Endpoint(interface, "client", "x", (sys.argv[3] + "." + port,)))
    assert link.wait(100), port
    return SimpleNamespace(**{o.name: link.bind(o) for o in interface.operations})

def refusal_of(kind, call, *arguments):
    try:
        call(*arguments)
    except kind as error:
        return error
    raise AssertionError(f"{arguments} were accepted")
""".replace("SUPPORT", str(Path(waiting.__file__).parent))


def run(folder: Path, code: str, *arguments: str) -> str:
    """A Python program in the folder of a generated component; what it prints."""
    done = subprocess.run(
        [sys.executable, "-c", with_package(folder, code), *arguments],
        cwd=folder,
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": ""},
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


INPROC = """
import threading
from specificworker import SpecificWorker
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings
runner = Runner(
    SpecificWorker,
    SpecificWorker.SPEC.parameters.load("etc/config.yaml"),
    RunSettings(domain=sys.argv[2], middleware="inproc"),
)
runner.start()
"""
ZENOH = """
import subprocess
process = subprocess.Popen([sys.executable, "main.py", "--domain", sys.argv[2]])
"""
ENDS = {
    "inproc": "\nrunner.stop()\nassert runner.wait()\n",
    "zenoh": "\nprocess.terminate()\nassert process.wait(60) == 0\n",
}
STARTS = {"inproc": INPROC, "zenoh": ZENOH}


def with_simulator(middleware: str, body: str) -> str:
    """A program that starts the simulator, uses it, and ends it whatever happens."""
    inner = "".join(f"    {line}\n" for line in body.splitlines())
    failed = "except BaseException:\n    traceback.print_exc()\n    KILL\n    os._exit(1)\n"
    kill = {"inproc": "pass", "zenoh": "process.kill()"}[middleware]
    received = failed.replace("KILL", kill)
    return (
        f"{CLIENT}{STARTS[middleware]}try:\n{inner}{received}{ENDS[middleware]}middleware.close()\n"
    )


def assert_clean(folder: Path) -> None:
    """Check a generated component with the linter, the formatter and the type checker."""
    for command in (
        [RUFF, "check", "--isolated", "--no-cache", "."],
        [RUFF, "format", "--diff", "--isolated", "--no-cache", "."],
        [*MYPY, "."],
    ):
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout


@dataclass(frozen=True)
class Served:
    """A simulation that does not run, the ports of its component, and the types of these."""

    simulation: Simulation
    ports: dict[str, DevicePort]
    types: Any

    def advance_until(self, condition: Callable[[], object], limit: float = 20.0) -> None:
        """Advance simulated time until the condition is true."""
        while not condition():
            assert self.simulation.world.time < limit, f"not reached within {limit} s: {condition}"
            self.simulation.advance(0.02)


def served(
    folder: Path, text: str, options: SimulationOptions | None = None, also: tuple[str, ...] = ()
) -> Served:
    """What `rcgen simulator` generates for a world, without a process and without a thread."""
    path = folder / "world.xml"
    path.write_text(text)
    report = Report()
    body = check_innermodel(path, Workspace(environ={}), report)
    assert body is not None
    assert [finding.message for finding in report] == []
    return _served(folder, serving_also(simulator(body), also), options)


def served_model(folder: Path, text: str, name: str = "robot.xml") -> Served:
    """The same of a model in URDF or MJCF."""
    path = folder / name
    path.write_text(text)
    report = Report()
    simulator = model_world(path, (), report, lambda simulator: simulator)
    assert [finding.message for finding in report] == []
    assert simulator is not None
    return _served(folder, simulator, SimulationOptions(step=simulator.step / 1000))


def _served(folder: Path, simulator: Simulator, options: SimulationOptions | None) -> Served:
    report = Report()
    workspace = Workspace(environ={})
    for description in descriptions(simulator):
        workspace.sources.set_overlay(folder / description.path, description.text)
    component = check_cdsl(folder / f"{simulator.name}.cdsl", workspace, report)
    assert [finding.message for finding in report] == []
    assert component is not None
    written = {file.path: file.text for file in files(simulator, component)}
    package = folder / package_of(component.name)
    data = json.loads(written[f"{package.name}/scene.json"])
    module = types.ModuleType("interfaces")
    # Without the `from __future__` of this module, which `compile` would apply.
    source = written[f"{package.name}/interfaces.py"]
    exec(compile(source, "interfaces.py", "exec", dont_inherit=True), module.__dict__)
    if simulator.model:
        package.mkdir()
        (package / simulator.scene["model"]["file"]).write_text(simulator.model)
    scene = Scene.of_data(data["scene"], package)
    simulation = opened(Simulation(scene, options or SimulationOptions()))
    ports = [ServedPort(p.port, getattr(module, p.interface.upper())) for p in simulator.ports]
    return Served(simulation, simulation.serve(ports, data["ports"]), module)
