"""`rcgen check app.ddsl` and `rcdeploy check app.ddsl` find the same."""

from __future__ import annotations

import socket
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from robocomp_dsl.cli import program
from robocomp_dsl.cli.rcdeploy.main import normalise_arguments
from robocomp_dsl.cli.rcdeploy.main import program as rcdeploy
from tests.cli.rcgen_run import Rcgen, Run
from tests.deploy.rcdeploy_process import runtime_folder

ROOT = Path(__file__).parents[2]
DEPLOYMENTS = sorted(
    path.relative_to(ROOT)
    for folder in ("components", "tests/cases")
    for path in (ROOT / folder).rglob("*.ddsl")
)


class Rcdeploy(Rcgen):
    """`rcdeploy` in this process."""

    def __call__(self, *arguments: object) -> Run:
        self.monkeypatch.setattr(sys, "argv", ["rcdeploy", *map(str, arguments)])
        sys.argv[1:] = normalise_arguments(sys.argv[1:])
        try:
            code = program._exit_code(rcdeploy, "rcdeploy")
        except SystemExit as leaving:
            code = leaving.code  # type: ignore[assignment]
        shown = self.capsys.readouterr()
        return Run(code, shown.out, shown.err)


@pytest.fixture
def deploy(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Iterator[Rcdeploy]:
    monkeypatch.setenv("NO_COLOR", "1")
    with runtime_folder(monkeypatch):
        yield Rcdeploy(monkeypatch, capsys)


@pytest.mark.parametrize("path", DEPLOYMENTS, ids=str)
def test_check_of_both_commands_finds_the_same(
    rcgen: Rcgen, deploy: Rcdeploy, monkeypatch: pytest.MonkeyPatch, path: Path
) -> None:
    monkeypatch.chdir(ROOT)
    first = rcgen("check", path, "--format", "json")
    second = deploy("check", path, "--format", "json")
    assert (first.code, first.out) == (second.code, second.out)


ARM = 'Component arm { Communications { }; language Python; parameters "arm.pdsl"; period 10; };\n'
PDSL = "ComponentParams arm { serial string; weights[2] float 1.0; };\n"


def write(folder: Path, body: str) -> Path:
    (folder / "arm.cdsl").write_text(ARM)
    (folder / "arm.pdsl").write_text(PDSL)
    file = folder / "app.ddsl"
    file.write_text(f'import "arm.cdsl";\nDeployment app {{ component arm {{ {body} }}; }};\n')
    return file


def test_check_finds_what_prevents_the_start(rcgen: Rcgen, deploy: Rcdeploy, here: Path) -> None:
    file = write(here, "")
    found = rcgen("check", file, "--format", "concise")
    assert found.code == 1
    assert "component not generated: no main.py" in found.out
    assert rcgen("component", "arm.cdsl").code == 0
    missing = rcgen("check", file, "--format", "concise")
    assert missing.code == 1
    assert "`serial` has no value" in missing.out
    assert missing.out == deploy("check", file, "--format", "concise").out
    write(here, 'set serial = "x"; set weights[1] = 2;')
    assert rcgen("check", file, "--format", "concise") == Run(0, "", "")
    (here / "arm.pdsl").write_text(PDSL.replace("2]", "2:9]"))
    outdated = rcgen("check", file, "--format", "concise")
    assert outdated.code == 0
    assert "the generated code of `arm` is outdated" in outdated.out
    assert outdated == deploy("check", file, "--format", "concise")


def test_check_of_both_commands_probes_ports(rcgen: Rcgen, deploy: Rcdeploy, here: Path) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        file = write(here, f'set serial = "x"; port {taken.getsockname()[1]};')
        assert rcgen("component", "arm.cdsl").code == 0
        found = rcgen("check", file, "--format", "concise")
        assert (found.code, "cannot be used" in found.out) == (1, True)
        assert found.out == deploy("check", file, "--format", "concise").out
    assert rcgen("check", file, "--format", "concise") == Run(0, "", "")


def test_check_static_ignores_this_machine(rcgen: Rcgen, here: Path) -> None:
    file = write(here, "")
    assert rcgen("check", "--static", file, "-q") == Run(0, "", "")
    assert rcgen("check", "--syntax", file, "-q") == Run(0, "", "")
    assert rcgen("check", ".", "-q") == Run(0, "", ""), "a folder is checked so, too"
    assert rcgen("check", ".", file.name, "-q").code == 1
    write(here, "set weights[2] = 1;")
    assert rcgen("check", "--static", file, "-q").code == 1
