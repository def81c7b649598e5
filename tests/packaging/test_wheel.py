"""A wheel, installed elsewhere, carries grammars, templates and interfaces, and generates."""

from __future__ import annotations

import subprocess
import sys
import sysconfig
import venv
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
COMPONENT = """\
import "Laser.idsl";
Component watcher
{
    Communications { requires Laser; };
    language Python;
};
"""


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    subprocess.run(command, cwd=ROOT, check=True, capture_output=True)
    (built,) = folder.glob("*.whl")
    return built


@pytest.fixture(scope="module")
def elsewhere(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A fresh venv with the wheel in it; its dependencies are borrowed: no network is needed."""
    folder = tmp_path_factory.mktemp("venv")
    venv.create(folder, with_pip=False)
    (site,) = folder.glob("lib/python*/site-packages")
    (site / "borrowed.pth").write_text(sysconfig.get_path("purelib") + "\n")
    pip = [sys.executable, "-m", "pip", "--python", str(folder / "bin/python")]
    subprocess.run(
        [*pip, "install", "--no-deps", "--no-index", "-q", str(wheel)],
        check=True,
        capture_output=True,
    )
    return folder


def test_the_wheel_holds_what_is_shipped(wheel: Path) -> None:
    names = set(zipfile.ZipFile(wheel).namelist())
    for folder in ("grammars", "templates", "interfaces"):
        shipped = [p for p in (ROOT / folder).rglob("*") if p.is_file()]
        assert shipped
        for path in shipped:
            assert f"robocomp_dsl/share/{path.relative_to(ROOT)}" in names


def test_an_installed_rcgen_generates(elsewhere: Path, tmp_path: Path) -> None:
    (tmp_path / "watcher.cdsl").write_text(COMPONENT)
    python = str(elsewhere / "bin/python")
    where = subprocess.run(
        [python, "-c", "import robocomp_dsl; print(robocomp_dsl.__file__)"],
        cwd=tmp_path,
        check=True,
        capture_output=True,
        text=True,
    )
    assert where.stdout.startswith(str(elsewhere))
    subprocess.run(
        [str(elsewhere / "bin/rcgen"), "component", "watcher.cdsl"],
        cwd=tmp_path,
        check=True,
        capture_output=True,
    )
    assert "getLaserData" in (tmp_path / "generated/interfaces.py").read_text()


INITIALIZE = b'{"jsonrpc":"2.0","id":1,"method":"initialize","params":{"capabilities":{}}}'
EXIT = b'{"jsonrpc":"2.0","method":"exit"}'


@pytest.mark.parametrize(
    ("command", "shown"),
    [
        (("check", "--format", "sarif", "."), '"name": "rcgen"'),
        (("fmt", "--diff", "watcher.cdsl"), "+import"),
        (("doc", ".", "-o", "html"), "html/index.html: "),
        (("doc", ".", "-o", "md", "--format", "markdown"), "md/index.md: "),
        (("interface", "Laser.idsl", "--to", "slice", "--alone"), "interface Laser"),
        (("interface", "Laser.idsl", "--to", "json-schema"), "TLaserData"),
        (("interface", "Laser.idsl", "--to", "ros2", "-o", "ros2"), "ros2: "),
        (("new", "other"), "wrote "),
        (("explain", "RC204"), "Wrong:"),
        (("lsp",), '"hoverProvider": true'),
    ],
    ids=lambda one: one[0] if isinstance(one, tuple) else "",
)
def test_every_command_of_an_installed_rcgen(
    elsewhere: Path, tmp_path: Path, command: tuple[str, ...], shown: str
) -> None:
    (tmp_path / "watcher.cdsl").write_text(COMPONENT.replace("import", "  import"))
    (tmp_path / "Laser.idsl").write_bytes((ROOT / "interfaces/Laser.idsl").read_bytes())
    sent = b"".join(b"Content-Length: %d\r\n\r\n%b" % (len(m), m) for m in (INITIALIZE, EXIT))
    done = subprocess.run(
        [str(elsewhere / "bin/rcgen"), *command],
        cwd=tmp_path,
        input=sent,
        capture_output=True,
        check=False,
        timeout=60,
    )
    assert shown in done.stdout.decode()
    assert b"internal error" not in done.stderr
    assert done.returncode in ((0, 1) if command == ("lsp",) else (0,))
