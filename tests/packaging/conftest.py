"""A wheel of this checkout, and environments to install it into."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.packaging.installation import ROOT, Installation, bare_environment, build, install


@pytest.fixture(scope="session")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel, built once."""
    return build("wheel", ROOT, tmp_path_factory.mktemp("wheel"))


@pytest.fixture(scope="session")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Installation:
    """An environment outside the checkout that has the wheel."""
    return install(wheel, tmp_path_factory.mktemp("installed"))


@pytest.fixture(scope="session")
def bare(tmp_path_factory: pytest.TempPathFactory) -> Installation:
    """An environment without the package."""
    return bare_environment(tmp_path_factory.mktemp("bare"))
