"""Wheels of installed packages."""

from __future__ import annotations

import subprocess
import sys
from importlib.metadata import Distribution, PathDistribution
from pathlib import Path

import pytest

from robocomp_dsl.deploy.content.package_files import write_wheel
from robocomp_dsl.deploy.content.repack import installed_tags, repack
from tests.deploy.content.workspace_files import write_files

UV = Path(sys.executable).with_name("uv")
INFO = "two_parts-1.5.dist-info"


def build_wheel(folder: Path) -> Path:
    """A wheel with a module, a data file, a script and an entry point."""
    path = folder / "two_parts-1.5-py2.py3-none-any.whl"
    members = {
        "two_parts/__init__.py": "VALUE = 7\ndef main(): print(VALUE)\n",
        "two_parts/a,b.txt": "comma",
        "two_parts-1.5.data/scripts/two-script": "#!python\nimport two_parts; two_parts.main()\n",
        "two_parts-1.5.data/data/share/two/x.txt": "data",
        f"{INFO}/METADATA": "Metadata-Version: 2.1\nName: two_parts\nVersion: 1.5\n",
        f"{INFO}/WHEEL": "Wheel-Version: 1.0\nRoot-Is-Purelib: true\n"
        "Tag: py2-none-any\nTag: py3-none-any\n",
        f"{INFO}/entry_points.txt": "[console_scripts]\ntwo-entry = two_parts:main\n",
    }
    return write_wheel(path, INFO, [(name, text.encode()) for name, text in members.items()])


def install(wheel: Path, environment: Path) -> Distribution:
    """The distribution in a new environment, which uv makes."""
    run = [str(UV), "--offline", "--no-config", "--no-cache"]
    subprocess.run([*run, "venv", "-q", "-p", sys.executable, environment], check=True)
    subprocess.run(
        [*run, "pip", "install", "-q", "--no-deps", "-p", environment / "bin/python", wheel],
        check=True,
    )
    (info,) = environment.glob("lib/python*/site-packages/*.dist-info")
    return PathDistribution(info)


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Distribution:
    folder = tmp_path_factory.mktemp("repack")
    return install(build_wheel(folder), folder / "environment")


def output(environment: Path, *command: str) -> str:
    program = environment / "bin" / command[0]
    result = subprocess.run(
        [program, *command[1:]], capture_output=True, text=True, check=True, cwd=environment
    )
    return result.stdout.strip()


def test_repack_gives_a_wheel_that_installs_the_same(
    installed: Distribution, tmp_path: Path
) -> None:
    assert installed_tags(installed) == {"py2-none-any", "py3-none-any"}
    wheel = repack(installed, tmp_path)
    assert wheel is not None
    assert wheel.name == "two_parts-1.5-py2.py3-none-any.whl"
    again = tmp_path / "environment"
    copy = install(wheel, again)
    assert copy.version == "1.5"
    assert output(again, "two-script") == output(again, "two-entry") == "7"
    assert (again / "share/two/x.txt").read_text() == "data"
    assert Path(str(copy.locate_file("two_parts/a,b.txt"))).read_text() == "comma"
    first = wheel.read_bytes()
    assert repack(copy, tmp_path) == wheel
    assert wheel.read_bytes() == first


def test_repack_refuses_changed_installation(installed: Distribution, tmp_path: Path) -> None:
    module = Path(str(installed.locate_file("two_parts/__init__.py")))
    text = module.read_text()
    try:
        module.unlink()  # it may be a hard link
        assert repack(installed, tmp_path) is None
        module.write_text(text + "VALUE = 8\n")
        assert repack(installed, tmp_path) is None
    finally:
        module.write_text(text)
    assert repack(installed, tmp_path) is not None


def test_repack_needs_a_record(tmp_path: Path) -> None:
    write_files(
        tmp_path, {"x-1.dist-info/METADATA": "Metadata-Version: 2.1\nName: x\nVersion: 1\n"}
    )
    assert repack(PathDistribution(tmp_path / "x-1.dist-info"), tmp_path) is None
