"""Programs that lack the package, or one of its extras, say what to install."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.packaging.installation import ROOT, Installation

COMPONENTS = ROOT / "components"
PROGRAMS = sorted([*COMPONENTS.glob("*/main.py"), *COMPONENTS.glob("*/demo.py")])
RCGEN = "import sys; from robocomp_dsl.cli.rcgen.main import main; main()"
WORLD = '<innerModel><transform id="a"/></innerModel>'
NAO = COMPONENTS / "nao_simulator"


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda p: f"{p.parent.name}-{p.stem}")
def test_program_without_the_package(bare: Installation, program: Path, tmp_path: Path) -> None:
    run = bare.run("python3", program.name, cwd=program.parent, path=str(tmp_path))
    assert (run.returncode, run.stdout) == (1, "")
    first, install, other = run.stderr.splitlines()
    assert first.startswith(f"{program.name} cannot run with {bare.python}, which lacks the module")
    assert install.startswith(f"Install the package: {bare.python} -m pip install ")
    assert other == "or use the Python of the environment that has rcgen."


def test_program_without_the_package_names_the_python_of_rcgen(
    bare: Installation, installed: Installation
) -> None:
    run = bare.run("python3", "main.py", cwd=NAO, path=str(installed.commands))
    assert run.stderr.splitlines()[-1] == (
        f"or use the Python of the environment that has rcgen, {installed.python}."
    )


def test_main_shows_errors_of_user_code_with_their_trace(
    installed: Installation, tmp_path: Path
) -> None:
    (tmp_path / "main.py").write_bytes((NAO / "main.py").read_bytes())
    (tmp_path / "specificworker.py").write_text("import no_such_module\n")
    run = installed.run("python3", "main.py", cwd=tmp_path)
    assert run.returncode == 1
    assert "specificworker.py" in run.stderr
    assert "ModuleNotFoundError: No module named 'no_such_module'" in run.stderr


@pytest.mark.parametrize(
    ("module", "extra", "arguments"),
    [
        ("mujoco", "view", ("view", "nao_h25")),
        ("mujoco", "view", ("view", "--live")),
        ("viser", "view", ("view", "nao_h25", "--port", "0")),
        ("mujoco", "simulation", ("simulator", "world.xml")),
        ("mujoco", "simulation", ("hardware", "arm", "--like", "world.xml#a")),
        ("pygls", "editor", ("lsp",)),
        ("cattrs", "editor", ("lsp",)),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else "",
)
def test_rcgen_names_the_missing_extra(
    installed: Installation, tmp_path: Path, module: str, extra: str, arguments: tuple[str, ...]
) -> None:
    (tmp_path / "world.xml").write_text(WORLD)
    lacking = f"import sys; sys.modules[{module!r}] = None; {RCGEN}"
    run = installed.run("python3", "-c", lacking, *arguments, cwd=tmp_path)
    assert run.returncode == 1
    assert f"needs the module `{module}`, which {installed.python} does not have" in run.stderr
    assert f"-m pip install 'robocomp_dsl[{extra}]'" in run.stderr
    assert "Traceback" not in run.stderr
    assert [p.name for p in tmp_path.iterdir()] == ["world.xml"]


@pytest.mark.parametrize("component", ["nao_simulator", "mobile_base"])
def test_simulator_names_the_missing_extra(installed: Installation, component: str) -> None:
    lacking = "import runpy, sys; sys.modules['mujoco'] = None; sys.path.insert(0, '.')"
    program = f"{lacking}; runpy.run_path('main.py', run_name='__main__')"
    run = installed.run("python3", "-c", program, cwd=COMPONENTS / component)
    assert run.returncode == 1
    assert run.stderr == (
        f"main.py: the simulation of devices needs the module `mujoco`, which {installed.python} "
        f"does not have; install it: {installed.python} -m pip install 'robocomp_dsl[simulation]'\n"
    )
