"""`rcgen hardware`: the component of a device, from a world or a model file."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.hardware_component.driver_programs import BUS, CLIENT, SIMULATED_DRIVER
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
      <touchsensor id="bump" type="bumper">
        <plane id="bump_plate" py="30" pz="210" size="300,40,10" collide="1"/>
      </touchsensor>
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
        [str(argument) for argument in command],
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
    user_files = [
        folder / name for name in ("driver.py", "test_bumper.py", "bumper.pdsl", "bumper.cdsl")
    ]
    for path in user_files:
        path.write_text(f"{path.read_text()}\n")
    before = [path.read_bytes() for path in user_files]
    done = run(RCGEN, "hardware", "bumper", "--like", "world.xml#bump", cwd=home)
    assert "0 of" in done.stdout
    assert [path.read_bytes() for path in user_files] == before


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
