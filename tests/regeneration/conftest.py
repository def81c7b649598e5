"""What the tests of regeneration share."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.regeneration.talker_component import TalkerComponent


@pytest.fixture
def talker(tmp_path: Path) -> TalkerComponent:
    """A component with one operation, generated once."""
    component = TalkerComponent(tmp_path / "talker")
    component.folder.mkdir()
    component.describe("int say(Word w);")
    assert component.generate() == []
    return component
