"""An environment that has the package from a wheel, and nothing of the checkout.

The libraries that the package depends on come from the environment that runs the tests: a `.pth`
file adds its `site-packages`. Python reads no `.pth` files of a folder that is added that way, so
the editable installation of the checkout stays invisible. No network is needed.
"""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
import venv
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
_SYSTEM = "/usr/bin:/bin"


@dataclass(frozen=True)
class Installation:
    """A virtual environment in `folder`."""

    folder: Path

    @property
    def commands(self) -> Path:
        """The folder of `python`, and of `rcgen` and `rcdeploy` if they are installed."""
        return self.folder / "bin"

    @property
    def python(self) -> str:
        """Path of the interpreter."""
        return str(self.commands / "python3")

    def run(
        self, *command: str, cwd: Path, path: str = "", stdin: bytes = b"", timeout: float = 60.0
    ) -> subprocess.CompletedProcess[str]:
        """Run a command of this environment, found in it and then in `path`."""
        environment = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON")}
        environment |= {"PATH": f"{self.commands}:{path or _SYSTEM}", "NO_COLOR": "1"}
        program = self.commands / command[0]
        process = subprocess.run(
            [str(program), *command[1:]],
            cwd=cwd,
            env=environment,
            input=stdin,
            capture_output=True,
            timeout=timeout,
            check=False,
        )
        output, errors = process.stdout.decode(), process.stderr.decode()
        return subprocess.CompletedProcess(process.args, process.returncode, output, errors)


def bare_environment(folder: Path) -> Installation:
    """An environment with the standard library alone."""
    venv.create(folder, with_pip=False)
    return Installation(folder)


def install(wheel: Path, folder: Path) -> Installation:
    """An environment with `wheel`, and the libraries of the environment that runs the tests."""
    installation = bare_environment(folder)
    (site,) = folder.glob("lib/python*/site-packages")
    (site / "libraries.pth").write_text(sysconfig.get_path("purelib") + "\n")
    pip = [sys.executable, "-m", "pip", "--python", installation.python]
    subprocess.run(
        [*pip, "install", "--no-deps", "--no-index", "-q", str(wheel)],
        check=True,
        capture_output=True,
    )
    return installation


def build(kind: str, source: Path, target: Path) -> Path:
    """Build a `wheel` or an `sdist` of the project in `source`."""
    command = [sys.executable, "-m", "hatchling", "build", "-t", kind, "-d", str(target)]
    subprocess.run(command, cwd=source, check=True, capture_output=True)
    (built,) = target.iterdir()
    return built
