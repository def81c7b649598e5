"""A middleware of another distribution is one entry point; the whole project knows it then.

`third_party/` is the distribution. pip installs it into a folder, which the processes of these
tests have in their search path; this project is not changed.
"""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.deploy.rcdeploy_process import rcdeploy, runtime_folder, start_rcdeploy
from tests.language_server.raw_client import RawClient

ROOT = Path(__file__).parents[2]
DISTRIBUTION = Path(__file__).parent / "third_party"
RCGEN = "from robocomp_dsl.cli.rcgen.main import main; main()"
IDSL = """
module Sums
{
    interface Sum { int add(int a, int b); };
    interface Ticks { void tick(int number); };
};
"""
SERVER = """
import "Sums.idsl";
Component adder
{
    Communications { implements Sum(pipe); publishes Ticks(pipe); };
    language Python;
    middleware pipe;
};
"""
CLIENT = """
import "Sums.idsl";
Component asker
{
    Communications { requires Sum; subscribesTo Ticks; };
    language Python;
    middleware pipe;
};
"""
WORKERS = {
    "adder": """
from adder_generated.genericworker import GenericWorker
class SpecificWorker(GenericWorker):
    number = 0
    def Sum_add(self, a, b):
        return a + b
    def compute(self):
        self.number += 1
        self.ticks_proxy.tick(self.number)
""",
    "asker": """
from asker_generated.genericworker import GenericWorker
class SpecificWorker(GenericWorker):
    ticks = 0
    def Ticks_tick(self, number):
        self.ticks += 1
        if number < 0:
            print("tick", number, flush=True)
    def compute(self):
        if self.ticks:
            print("sum over pipe:", self.sum_proxy.add(20, 22), flush=True)
""",
}
APP = """
import "adder/adder.cdsl";
import "asker/asker.cdsl";
Deployment sums
{
    component adder { ready within 200 s; };
    component asker { after adder; ready within 200 s; };
};
"""
BROKEN = "[robocomp_dsl.middleware]\nbroken = robocomp_dsl_nowhere:MIDDLEWARE\n"


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder into which pip has installed the distribution."""
    folder = tmp_path_factory.mktemp("site")
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    options = ["--no-deps", "--no-build-isolation", "--no-index", "--target", str(folder)]
    subprocess.run([*pip, *options, str(DISTRIBUTION)], check=True, timeout=300)
    return folder


@pytest.fixture
def search_path(installed: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Processes that the test starts find the distribution."""
    monkeypatch.setenv("PYTHONPATH", str(installed), prepend=os.pathsep)


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Two components and a deployment that name the middleware, in the working folder."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "Sums.idsl").write_text(IDSL)
    for name, text in (("adder", SERVER), ("asker", CLIENT)):
        folder = tmp_path / name
        folder.mkdir()
        (folder / f"{name}.cdsl").write_text(text)
        (folder / "Sums.idsl").write_text(IDSL)
    (tmp_path / "app.ddsl").write_text(APP)
    with runtime_folder(monkeypatch) as path:
        monkeypatch.setenv("XDG_STATE_HOME", str(path.parent / "state"))
        yield tmp_path


def rcgen(*arguments: str) -> subprocess.CompletedProcess[str]:
    """Run `rcgen` in a process."""
    command = [sys.executable, "-c", RCGEN, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)


def test_check_refuses_middleware_that_is_not_installed(project: Path) -> None:
    result = rcgen("check", "adder/adder.cdsl")
    assert result.returncode == 1
    assert "pipe" in result.stdout + result.stderr


@pytest.mark.usefixtures("search_path")
def test_check_accepts_middleware_of_component_interface_and_connection(project: Path) -> None:
    app = project / "app.ddsl"
    connection = "    connect asker.Sum -> adder.Sum over pipe;\n};\n"
    app.write_text(app.read_text().rpartition("};")[0] + connection)
    result = rcgen("check", "--static", "adder/adder.cdsl", "asker/asker.cdsl", "app.ddsl")
    assert result.returncode == 0, result.stdout + result.stderr


@pytest.mark.usefixtures("search_path")
@pytest.mark.asyncio
async def test_language_server_completes_middleware(project: Path) -> None:
    path = project / "adder" / "adder.cdsl"
    client = await RawClient.start()
    try:
        await client.initialize()
        document = {"uri": path.as_uri(), "languageId": "cdsl", "version": 1, "text": SERVER}
        client.notify("textDocument/didOpen", {"textDocument": document})
        line = next(n for n, text in enumerate(SERVER.splitlines()) if "middleware" in text)
        position = {"line": line, "character": len("    middleware ")}
        at = {"textDocument": {"uri": path.as_uri()}, "position": position}
        reply = await client.request("textDocument/completion", at)
        found = reply["result"]
        items = found["items"] if isinstance(found, dict) else found
        assert {"pipe", "zenoh"} <= {item["label"] for item in items}
    finally:
        await client.end()


@pytest.mark.usefixtures("search_path")
def test_documentation_names_middleware(project: Path) -> None:
    result = rcgen("doc", "adder/adder.cdsl", "--format", "markdown", "-o", "page")
    assert result.returncode == 0, result.stdout + result.stderr
    pages = [path.read_text() for path in Path("page").rglob("*.md")]
    assert any("pipe" in page for page in pages)


@pytest.mark.usefixtures("search_path")
def test_generated_components_run_over_middleware(project: Path) -> None:
    for name, worker in WORKERS.items():
        result = rcgen("component", f"{name}/{name}.cdsl")
        assert result.returncode == 0, result.stdout + result.stderr
        (project / name / "specificworker.py").write_text(worker)
    with start_rcdeploy("app.ddsl") as running:
        running.until("all 2 components are ready", "sum over pipe: 42")
        called = rcdeploy("call", "adder.Sum.add", "1", "2")
        assert (called.returncode, called.stdout) == (0, "3\n"), called.stderr
        echoed = rcdeploy("echo", "adder.Ticks", "-n", "2")
        assert echoed.returncode == 0, echoed.stderr
        assert echoed.stdout.count("---") == 2
        rate = rcdeploy("hz", "adder.Ticks", "--once")
        assert rate.returncode == 0, rate.stderr
        published = rcdeploy("pub", "asker.Ticks", "-7")
        assert published.returncode == 0, published.stderr
        running.until("tick -7")
        running.process.send_signal(signal.SIGINT)
        assert running.end() == 0


@pytest.mark.usefixtures("search_path")
def test_conformance_suite_passes_with_middleware() -> None:
    """A worker of xdist must not take this run for its own."""
    environment = {k: v for k, v in os.environ.items() if not k.startswith("PYTEST_")}
    suite = ["tests/middleware/conformance", "--middleware", "pipe", "-p", "no:cacheprovider"]
    result = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", *suite],
        cwd=ROOT,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=500,
    )
    assert result.returncode == 0, result.stdout[-5000:]
    passed = re.search(r"(\d+) passed", result.stdout)
    assert passed
    assert int(passed[1]) > 200


def test_broken_middleware_is_reported_and_hinders_no_other(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    metadata = tmp_path / "robocomp_dsl_nowhere-1.0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: robocomp-dsl-nowhere\n")
    (metadata / "entry_points.txt").write_text(BROKEN)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path), prepend=os.pathsep)
    program = """
from robocomp_dsl.runtime.middleware import registry
assert "broken" in registry.middleware_names()
assert registry.known_capabilities("broken") is None
assert registry.known_capabilities("zenoh")
try:
    registry.capabilities_of("broken")
except registry.UnknownMiddleware as error:
    print(error)
"""
    command = [sys.executable, "-c", program]
    result = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    assert "`broken` of robocomp-dsl-nowhere cannot be loaded: ModuleNotFoundError" in result.stdout
    assert "pip uninstall robocomp-dsl-nowhere" in result.stdout
    assert not result.stderr
    (tmp_path / "c.cdsl").write_text(CLIENT.replace("requires Sum", "requires Sum(broken)"))
    (tmp_path / "Sums.idsl").write_text(IDSL)
    checked = rcgen("check", str(tmp_path / "c.cdsl"), "--format", "concise")
    assert checked.returncode == 1
    assert "RC214" in checked.stdout
    assert "`broken` of robocomp-dsl-nowhere cannot be loaded: ModuleNotF" in checked.stdout
