"""What the tests of regeneration share."""

from __future__ import annotations

from pathlib import Path

import pytest
from regenerated import Talker


@pytest.fixture
def talker(tmp_path: Path) -> Talker:
    """A component with one operation, generated once."""
    made = Talker(tmp_path / "talker")
    made.folder.mkdir()
    made.describe("int say(Word w);")
    assert made.generate() == []
    return made
