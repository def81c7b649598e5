"""Debian's package of ZeroC Ice in a virtual environment; without the package itself."""

from __future__ import annotations

import sysconfig
from pathlib import Path

import pytest

from robocomp_dsl.runtime.middleware.ice.link_debian import link_packages


@pytest.fixture
def system(tmp_path: Path) -> Path:
    """A folder as Debian's package fills it."""
    for name in ("system/Ice", "system/IceStorm", "system/numpy", "site"):
        (tmp_path / name).mkdir(parents=True)
    return tmp_path / "system"


def test_link_debian_links_ice_and_nothing_else(system: Path, tmp_path: Path) -> None:
    library = f"IcePy{sysconfig.get_config_var('EXT_SUFFIX')}"
    (system / library).touch()
    site = tmp_path / "site"
    (site / "Ice").symlink_to(tmp_path / "gone")
    for _ in range(2):
        assert link_packages(system, site) == ["Ice", "IceStorm"]
        assert sorted(path.name for path in site.iterdir()) == sorted(["Ice", library, "IceStorm"])
    assert (site / "Ice").resolve() == (system / "Ice").resolve()


def test_link_debian_names_another_python_version(system: Path, tmp_path: Path) -> None:
    (system / "IcePy.cpython-30-other.so").touch()
    with pytest.raises(FileNotFoundError, match=r"another Python: IcePy\.cpython-30"):
        link_packages(system, tmp_path / "site")


def test_link_debian_names_missing_package(system: Path, tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="apt-get install python3-zeroc-ice"):
        link_packages(system, tmp_path / "site")
