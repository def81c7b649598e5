"""A wheel, installed outside the checkout, has everything that the commands need."""

from __future__ import annotations

import subprocess
import tarfile
import zipfile
from pathlib import Path

import pytest

from robocomp_dsl import __version__
from tests.packaging.installation import ROOT, Installation, build

COMPONENT = """\
import "Laser.idsl";
Component watcher
{
    Communications { requires Laser; };
    language Python;
};
"""
SHARED = ("grammars", "templates", "interfaces", "components")


def _names(wheel: Path) -> set[str]:
    return set(zipfile.ZipFile(wheel).namelist())


def test_wheel_holds_every_shared_file(wheel: Path) -> None:
    listed = subprocess.run(
        ["git", "ls-files", "-z", *SHARED], cwd=ROOT, check=True, capture_output=True, text=True
    )
    shared = [name for name in listed.stdout.split("\0") if name]
    assert {name.partition("/")[0] for name in shared} == set(SHARED)
    assert {f"robocomp_dsl/share/{name}" for name in shared} <= _names(wheel)


def test_wheel_holds_no_build_products(wheel: Path) -> None:
    assert not [n for n in _names(wheel) if "__pycache__" in n or "/build/" in n]


def test_sdist_builds_the_same_wheel(wheel: Path, tmp_path: Path) -> None:
    archive = build("sdist", ROOT, tmp_path / "sdist")
    with tarfile.open(archive) as opened:
        opened.extractall(
            tmp_path, **({"filter": "data"} if hasattr(tarfile, "data_filter") else {})
        )
    (source,) = tmp_path.glob("robocomp_dsl-*")
    assert _names(build("wheel", source, tmp_path / "again")) == _names(wheel)


def test_wheel_metadata(wheel: Path) -> None:
    (metadata,) = (n for n in _names(wheel) if n.endswith(".dist-info/METADATA"))
    text = zipfile.ZipFile(wheel).read(metadata).decode()
    assert f"\nVersion: {__version__}\n" in text
    assert "\nLicense-Expression: Apache-2.0\n" in text
    for extra in ("simulation", "view", "editor", "all"):
        assert f"\nProvides-Extra: {extra}\n" in text


def test_installed_package_is_that_of_the_wheel(installed: Installation, tmp_path: Path) -> None:
    run = installed.run(
        "python3", "-c", "import robocomp_dsl as r; print(r.__file__)", cwd=tmp_path
    )
    assert run.stdout.startswith(str(installed.folder))


@pytest.mark.parametrize("command", ["rcgen", "rcdeploy"])
def test_installed_version(installed: Installation, tmp_path: Path, command: str) -> None:
    assert installed.run(command, "--version", cwd=tmp_path).stdout == (
        f"{command}, version {__version__}\n"
    )


def test_installed_rcgen_component(installed: Installation, tmp_path: Path) -> None:
    (tmp_path / "watcher.cdsl").write_text(COMPONENT)
    run = installed.run("rcgen", "component", "watcher.cdsl", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    (interfaces,) = tmp_path.glob("*/interfaces.py")
    assert "getLaserData" in interfaces.read_text()
    help_ = installed.run("python3", "main.py", "--help", cwd=tmp_path)
    assert "Run the component watcher." in help_.stdout


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
        (("examples",), "touch "),
        (("explain", "RC204"), "Wrong:"),
        (("lsp",), '"hoverProvider": true'),
    ],
    ids=lambda value: value[0] if isinstance(value, tuple) else "",
)
def test_installed_rcgen_command(
    installed: Installation, tmp_path: Path, command: tuple[str, ...], shown: str
) -> None:
    (tmp_path / "watcher.cdsl").write_text(COMPONENT.replace("import", "  import"))
    (tmp_path / "Laser.idsl").write_bytes((ROOT / "interfaces/Laser.idsl").read_bytes())
    sent = b"".join(b"Content-Length: %d\r\n\r\n%b" % (len(m), m) for m in (INITIALIZE, EXIT))
    run = installed.run("rcgen", *command, cwd=tmp_path, stdin=sent)
    assert shown in run.stdout
    assert "internal error" not in run.stderr
    assert run.returncode in ((0, 1) if command == ("lsp",) else (0,))
