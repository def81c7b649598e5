"""The components of the campaign, generated once for the tests of faults."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.campaign.components import build, environment


@pytest.fixture(scope="session")
def generated() -> Iterator[Path]:
    """The folder with the generated components; its path is short enough for sockets."""
    with tempfile.TemporaryDirectory(prefix="rc-") as name, pytest.MonkeyPatch.context() as patch:
        folder = Path(name, "campaign")
        folder.mkdir()
        patch.setenv("ROBOCOMP_INTERFACES", str(folder))
        build(folder)
        yield folder


@pytest.fixture
def folder(generated: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The same folder, with sockets, state and journals of this test only."""
    with tempfile.TemporaryDirectory(prefix="rc-") as runtime:
        for name, value in environment(generated, Path(runtime)).items():
            monkeypatch.setenv(name, value)
        monkeypatch.setenv("XDG_STATE_HOME", f"{runtime}/state")
        for path in (generated / "journals").iterdir():
            path.unlink()
        yield generated
