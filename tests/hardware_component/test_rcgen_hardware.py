"""`rcgen hardware`: the twin of each device is clean, typed and tested; code runs on both alike."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support import waiting
from tests.support.generated_package import package_in, with_package

RCGEN = Path(sys.executable).with_name("rcgen")
MYPY = [sys.executable, "-m", "mypy", "--strict", "--config-file=", "--no-error-summary"]
WORLD = """\
<innerModel>
  <transform id="floor">
    <plane id="wall" nz="-1" pz="3000" py="500" size="6000,1000,50" collide="1"/>
    <differentialrobot id="robot">
      <translation id="pose" ty="140" tz="200">
        <laser id="laser" measures="101" min="100" max="30000" angle="1"/>
        <camera id="eye" width="64" height="48" focal="60"/>
        <rgbd id="depth" width="64" height="48" focal="60"/>
        <ultrasound id="sonar" min="20" max="3000" angle="0.3"/>
      </translation>
      <imu id="inertia"/>
      <gps id="sat" latitude="39" longitude="-6"/>
      <battery id="cell"/>
      <touchsensor id="bump" type="bumper"/>
      <joint id="neck" axis="y" min="-1" max="1">
        <joint id="nod" axis="x" min="-0.5" max="0.5"/>
      </joint>
    </differentialrobot>
    <omnirobot id="platform" tx="-2000"/>
  </transform>
</innerModel>
"""
DEVICES = ("laser", "eye", "depth", "sonar", "robot", "inertia", "sat", "cell", "bump",
           "nod,neck", "platform")  # fmt: skip
TYPED = ("laser", "nod,neck", "robot")
"""Those whose types are checked; it takes seconds each."""


def run(*command: str | Path, cwd: Path, **env: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [str(item) for item in command],
        cwd=cwd,
        capture_output=True,
        text=True,
        env={**os.environ, **env},
        timeout=300,
        check=False,
    )


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    result = tmp_path_factory.mktemp("home")
    (result / "world.xml").write_text(WORLD)
    return result


def twin(home: Path, ids: str, name: str) -> Path:
    done = run(RCGEN, "hardware", name, "--like", f"world.xml#{ids}", cwd=home)
    assert (done.returncode, done.stderr) == (0, "")
    return home / name


@pytest.mark.parametrize("ids", DEVICES)
def test_hardware_component_is_clean_typed_and_tested(home: Path, ids: str) -> None:
    folder = twin(home, ids, f"real_{ids.partition(',')[0]}")
    ruff = str(shutil.which("ruff"))
    commands = [
        [ruff, "check", "--isolated", "--no-cache", "."],
        [ruff, "format", "--diff", "--isolated", "--no-cache", "."],
    ]
    if ids in TYPED:
        commands.append([*MYPY, "driver.py", "main.py"])
    for command in commands:
        done = run(*command, cwd=folder)
        assert done.returncode == 0, done.stdout
    options = ("-q", "-p", "no:cacheprovider", "-p", "no:xdist", "-rs", "--rootdir=.")
    done = run(sys.executable, "-m", "pytest", *options, cwd=folder, PYTEST_ADDOPTS="")
    passed, skipped = (int(n) for n in done.stdout.splitlines()[-1].split() if n.isdecimal())
    assert passed == skipped > 0, done.stdout
    assert "`open` of driver.py is not implemented yet" in done.stdout


SIMULATED_DRIVER = '''
    def open(self) -> None:
        """Another process' worth of physics stands for the device."""
        if Path(self.params.address).exists():
            raise OSError("the cable is out")
        self.world = Simulation.read(Path(__file__).parent / "PACKAGE" / "scene.json")
        self.world.start()

    def close(self) -> None:
        """Let go of it."""
        if hasattr(self, "world"):
            self.world.stop()
            del self.world

    @property
    def settings(self) -> LaserSettings:
        """How the laser scans."""
        return LaserSettings(101, 57.2958, 100.0, 30000.0)

    def scan(self) -> Scan:
        """The latest scan."""
        if Path(self.params.address).exists():
            raise OSError("the cable is out")
        with self.world.lock:
            return self.world.devices["laser"].scan()
'''
WAITING = f"""
import sys
from functools import partial
sys.path.append({str(Path(waiting.__file__).parent)!r})
from waiting import wait_until
"""
CLIENT = (
    WAITING
    + """
wait_until = partial(wait_until, ignoring=Exception)
from robocomp_dsl.runtime.component.component_interface import COMPONENT, LifeState
from robocomp_dsl.runtime.component.callback_group import CallbackGroup
from robocomp_dsl.runtime.middleware.registry import open_middleware
from robocomp_dsl.runtime.middleware.base import Endpoint, MiddlewareContext
from robocomp_dsl.runtime.component.statistics import Statistics
from PACKAGE.interfaces import LASER
from pathlib import Path

name, domain, cable = sys.argv[1:]
context = MiddlewareContext("client", domain, CallbackGroup(), Statistics())
middleware = open_middleware("zenoh", context)

def bound(interface, port, operation):
    link = middleware.proxy(Endpoint(interface, "client", "x", (f"{name}.{port}",)))
    assert link.wait(100), port
    return link.bind(next(o for o in interface.operations if o.name == operation))

def work():
    scan = bound(LASER, "laser", "getLaserData")
    wait_until(lambda: abs(float(scan().dist[50]) - 2775) < 2)
    assert bound(LASER, "laser", "getLaserConfData")().maxMeasures == 101
    if cable:
        info = bound(COMPONENT, "Component", "getInfo")
        Path(cable).touch()
        wait_until(lambda: info().state == LifeState.Emergency)
        try:
            scan()
            raise SystemExit("a scan without a cable")
        except Exception as error:
            assert "the cable is out" in str(getattr(error, "what", error)), error
        Path(cable).unlink()
        wait_until(lambda: info().state == LifeState.Compute)
        wait_until(lambda: abs(float(scan().dist[50]) - 2775) < 2)

try:
    work()
finally:
    middleware.close()
"""
)


BUS = (
    WAITING
    + """
import time
import numpy as np
from driver import Driver
from PACKAGE import interfaces as i
from PACKAGE.hardware import IDS, PORTS
from PACKAGE.params import ArmParams
from robocomp_dsl.hardware.drivers.driver_host import DriverHost
from robocomp_dsl.hardware.devices.errors import HardwareError
from robocomp_dsl.runtime import ServedPort

class FreeArm(Driver):
    "Joints without load."
    torque = np.zeros(6)
    at, speed, last = np.array([1.2, 0.2, 0, -0.5, 0, 0.5]), np.zeros(6), time.perf_counter()

    def open(self):
        self.last = time.perf_counter()

    def read(self):
        now = time.perf_counter()
        for _ in range(min(round((now - self.last) / 5e-4), 100)):
            self.speed = self.speed + (self.torque - 0.02 * self.speed) / 5e-3 * 5e-4
            self.at = self.at + self.speed * 5e-4
        self.last = now
        return self.at.copy(), self.speed.copy()

    def write(self, torque):
        self.torque = torque

hardware = DriverHost(FreeArm(ArmParams()), IDS, motors=True)
served = [ServedPort("LArm", i.CONTROLBOARD), ServedPort("JointMotor", i.JOINTMOTOR)]
ports = hardware.serve(served, PORTS)
try:
    ports["LArm"].getState()
    raise SystemExit("a state of motors that are not there")
except HardwareError as error:
    assert "has not been opened yet" in str(error), error
hardware.open()
assert [joint.name for joint in ports["LArm"].getJoints()] == IDS
ports["LArm"].setControlMode([], i.ControlMode.Position)
ports["LArm"].setReferenceSpeed(["LShoulderPitch"], np.array([1.0]))
ports["LArm"].positionMove(["LShoulderPitch"], np.array([0.9]))
wait_until(
    lambda: abs(ports["LArm"].getState().position[0] - 0.9) < 0.02,
    lambda: str(ports["LArm"].getState().position),
)
assert abs(ports["JointMotor"].getMotorState("LShoulderPitch").pos - 0.9) < 0.05
hardware.close()
"""
)


def run_client(folder: Path, name: str, domain: str, cable: str) -> None:
    """The client against the component in `folder`, which ends in order."""
    options = ("--name", name, "--domain", domain, "--middleware", "zenoh")
    extra = ("--set", f"address={cable}") if cable else ()
    component = subprocess.Popen([sys.executable, "main.py", *options, *extra], cwd=folder)
    try:
        done = run(
            sys.executable, "-c", with_package(folder, CLIENT), name, domain, cable, cwd=folder
        )
        assert done.returncode == 0, done.stderr
    finally:
        component.terminate()
    assert component.wait(timeout=60) == 0


def test_hardware_component_runs_user_code_of_simulated_laser(home: Path, tmp_path: Path) -> None:
    """The same client; and when the cable is out the component is in Emergency until it is back."""
    assert run(RCGEN, "simulator", "world.xml", cwd=home).returncode == 0
    domain = f"twin-{os.getpid()}"
    run_client(home / "world_simulator", "laser_here", domain, "")
    folder = twin(home, "laser", "front")
    driver = folder / "driver.py"
    head, _, _ = driver.read_text().partition("    def open(self)")
    needed = (
        "from pathlib import Path\n\n"
        "from robocomp_dsl.simulation.world.simulation import Simulation\n"
    )
    head = head.replace("from robocomp", f"{needed}from robocomp", 1)
    driver.write_text(head + with_package(folder, SIMULATED_DRIVER))
    run_client(folder, "laser_there", domain, str(tmp_path / "cable"))


def test_rcgen_hardware_keeps_user_files(home: Path) -> None:
    folder = twin(home, "bump", "bumper")
    mine = [folder / item for item in ("driver.py", "test_bumper.py", "bumper.pdsl", "bumper.cdsl")]
    for item in mine:
        item.write_text(f"{item.read_text()}\n")
    before = [item.read_bytes() for item in mine]
    done = run(RCGEN, "hardware", "bumper", "--like", "world.xml#bump", cwd=home)
    assert "0 of" in done.stdout
    assert [item.read_bytes() for item in mine] == before


def test_hardware_component_motors_keep_configured_order(home: Path) -> None:
    folder = twin(home, "nod,neck", "head")
    driver = (folder / "driver.py").read_text()
    assert driver.index('name="nod"') < driver.index('name="neck"')
    ports = json.loads((package_in(folder) / "scene.json").read_text())["ports"]
    assert sorted(ports) == ["ControlBoard", "JointMotor"]


def test_board_of_model_file_has_hardware_component(home: Path) -> None:
    """Its motors are known from the file; the rules are held against them alone."""
    model = Path(__file__).parents[2] / "components" / "nao_simulator" / "nao.xml"
    done = run(RCGEN, "hardware", "arm", "--like", f"{model}#LArm", cwd=home)
    assert done.returncode == 0, done.stderr
    driver = (home / "arm" / "driver.py").read_text()
    assert 'name="LShoulderPitch",\n                    low=-2.08567,' in driver
    assert "RArm" not in driver
    options = ("-q", "-p", "no:cacheprovider", "-p", "no:xdist", "--rootdir=.")
    done = run(sys.executable, "-m", "pytest", *options, cwd=home / "arm", PYTEST_ADDOPTS="")
    assert "4 passed, 4 skipped" in done.stdout, done.stdout
    done = run(sys.executable, "-c", with_package(home / "arm", BUS), cwd=home / "arm")
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    ("like", "message"),
    [
        ("world.xml", "`--like world.xml` names no device: write WORLD.xml#ID"),
        ("world.xml#", "names no device"),
        ("world.xml#lasr", "there is no device `lasr`: did you mean `laser`?"),
        ("world.xml#xyz", "there is no device `xyz`: there are bump, cell, depth"),
        ("world.xml#laser,sonar", "a driver is for one `laser`; only motors share one"),
        ("world.xml#laser,neck", "motors and other devices have drivers of their own"),
        ("nowhere.xml#laser", "cannot read `nowhere.xml`"),
    ],
)
def test_rcgen_hardware_reports_invalid_arguments(home: Path, like: str, message: str) -> None:
    done = run(RCGEN, "hardware", "any", "--like", like, cwd=home)
    assert done.returncode in (1, 2)
    assert message in done.stderr
    assert "Traceback" not in done.stderr
    assert not (home / "any").exists()


def test_rcgen_hardware_reports_invalid_name(home: Path) -> None:
    done = run(RCGEN, "hardware", "my-laser", "--like", "world.xml#laser", cwd=home)
    assert done.returncode == 2
    assert "`my-laser` cannot name a component" in done.stderr
