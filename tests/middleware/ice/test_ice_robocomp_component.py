"""A generated component and existing RoboComp components talk with their old etc/config files."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from click.testing import CliRunner

from robocomp_dsl.resources import INTERFACES
from tests.deploy.rcdeploy_process import (
    RunningProcess,
    rcdeploy,
    runtime_folder,
    start_rcdeploy,
)
from tests.middleware.ice.peers import free_port

pytestmark = pytest.mark.peers
PROGRAMS = Path(__file__).parent / "robocomp"
CDSL = """\
import "DifferentialRobot.idsl";
import "Laser.idsl";
Component base
{
    Communications { implements DifferentialRobot; requires Laser; };
    language Python;
};
"""
WORKER = """\
from base_generated.genericworker import GenericWorker
from base_generated.interfaces import HardwareFailedException, TBaseState

class SpecificWorker(GenericWorker):
    def initialize(self):
        self.advance = 0.0

    def compute(self):
        scan, state = self.laser_proxy.getLaserAndBStateData()
        driver = self.laser_proxy.getLaserConfData().driver
        self.log.info("%s measures %s at x %g", driver, scan.dist.tolist(), state.x)

    def DifferentialRobot_setSpeedBase(self, adv, rot):
        if adv < 0:
            raise HardwareFailedException(f"cannot drive at {adv:g}")
        self.advance = adv

    def DifferentialRobot_getBaseState(self):
        return TBaseState(advVz=self.advance)

    def DifferentialRobot_getBasePose(self):
        return 3, 4, 0.5

    def _unused(self, *_):
        raise NotImplementedError

    DifferentialRobot_stopBase = DifferentialRobot_resetOdometer = _unused
    DifferentialRobot_setOdometer = DifferentialRobot_setOdometerPose = _unused
    DifferentialRobot_correctOdometer = _unused
"""
OWN_CONFIG = """\
# as RoboComp generates it
DifferentialRobot.Endpoints=tcp -p {base}
CommonBehavior.Endpoints=tcp -p 11999
LaserProxy = laser:tcp -h localhost -p {laser}   # the C++ component
Ice.Warn.Connections=0
Ice.MessageSizeMax=20004800
"""
PEER_CONFIG = """\
Laser.Endpoints=tcp -p {laser}
DifferentialRobotProxy = differentialrobot:tcp -h localhost -p {base}
Ice.Warn.Connections=0
"""


def run(*arguments: str) -> None:
    from robocomp_dsl.cli.rcgen.main import program  # noqa: PLC0415

    result = CliRunner().invoke(program, list(arguments))
    assert result.exit_code == 0, result.output


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The generated component, its peer's Slice files, and an old configuration for each."""
    (tmp_path / "base").mkdir()
    (tmp_path / "base/base.cdsl").write_text(CDSL)
    run("component", str(tmp_path / "base/base.cdsl"))
    (tmp_path / "base/specificworker.py").write_text(WORKER)
    for name in ("Laser", "DifferentialRobot"):
        run("interface", str(INTERFACES / f"{name}.idsl"), "--to", "slice", "-o", str(tmp_path))
    ports = {"base": free_port(), "laser": free_port()}
    (tmp_path / "base/etc/config").write_text(OWN_CONFIG.format(**ports))
    (tmp_path / "config").write_text(PEER_CONFIG.format(**ports))
    with runtime_folder(monkeypatch):
        yield tmp_path


def python_program(folder: Path) -> list[str]:
    program = PROGRAMS / "lasercomp.py"
    return [sys.executable, str(program), "--Ice.Config=config", str(folder)]


def cpp_program(folder: Path) -> list[str]:
    """Compile the C++ component as one unit, as Ice's headers take most of the time."""
    if not shutil.which("g++") or not Path("/usr/include/Ice/Ice.h").exists():
        pytest.skip("needs g++ and libzeroc-ice-dev: `make test-peers` installs them")
    files = [str(folder / f"{name}.ice") for name in ("GenericBase", "DifferentialRobot", "Laser")]
    slice2cpp = ["slice2cpp", "--underscore", f"-I{folder}", "--output-dir", str(folder)]
    subprocess.run([*slice2cpp, *files], check=True)
    program = str(folder / "lasercomp")
    subprocess.run(
        ["g++", "-O0", f"-I{folder}", "-o", program, str(PROGRAMS / "lasercomp.cpp"), "-lIce"],
        check=True,
    )
    return [program, "--Ice.Config=config"]


@pytest.mark.parametrize("program", [python_program, cpp_program])
def test_generated_component_and_robocomp_component_use_old_configurations(
    folder: Path, program: object
) -> None:
    command = program(folder)  # type: ignore[operator]
    own = [sys.executable, "main.py", "--config", "etc/config", "--middleware", "ice"]
    with (
        RunningProcess(*command, where=folder) as peer,
        RunningProcess(*own, "--domain", folder.name, where=folder / "base") as base,
    ):
        base.until("running every 100 ms (ice, domain", "hokuyo measures [1000.0, 1001.0, 1002.0] ")
        peer.until("base drives at 150 from 3 4", "base failed: cannot drive at -1")
        base.process.terminate()
        assert base.end() == 0
        assert not base.has("Traceback")
        peer.until("no base: ::Ice::Conn")


DEPLOYMENTS = {
    "config": """\
import "base/base.cdsl";
Deployment lab
{
    component base { middleware ice; config "base/etc/config"; };
};
""",
    "extern": """\
import "base/base.cdsl";
Deployment lab
{
    component base { port DifferentialRobot over ice at "tcp -p {base}"; };
    extern laser over ice at "laser:tcp -h localhost -p {laser}" implements Laser;
    extern driver over ice requires DifferentialRobot;
    connect base.Laser -> laser.Laser;
    connect driver.DifferentialRobot -> base.DifferentialRobot;
};
""",
}


@pytest.mark.parametrize("how", DEPLOYMENTS)
def test_deployed_component_and_plain_program_talk(
    folder: Path, monkeypatch: pytest.MonkeyPatch, how: str
) -> None:
    monkeypatch.chdir(folder)
    config = (folder / "base/etc/config").read_text()
    ports = {
        "base": config.partition("tcp -p ")[2].split()[0],
        "laser": config.partition("localhost -p ")[2].split()[0],
    }
    text = DEPLOYMENTS[how]
    for name, port in ports.items():
        text = text.replace(f"{{{name}}}", port)
    (folder / "lab.ddsl").write_text(text)
    with (
        RunningProcess(*python_program(folder), where=folder) as peer,
        start_rcdeploy("up", "lab.ddsl", "--domain", folder.name) as deployed,
    ):
        deployed.until("hokuyo measures [1000.0, 1001.0, 1002.0] at x 12.5")
        peer.until("base drives at 150 from 3 4", "base failed: cannot drive at -1")
        call = rcdeploy("call", "base.DifferentialRobot.getBaseState", "--domain", folder.name)
        assert "advVz: 150" in call.stdout, call.stdout + call.stderr
        deployed.process.terminate()
        assert deployed.end() == 0
        assert not deployed.has("Traceback")
