"""A project folder with mistakes in it, and a server of its own for the editor that opens it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.real_editor import Project


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Project]:
    """The folder; at the end no server that was started in it may be left."""
    project = Project(tmp_path_factory.mktemp("project"))
    yield project
    project.assert_no_server_left()


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The home folder of the editors, so that the user's own settings play no part."""
    return tmp_path_factory.mktemp("home")
