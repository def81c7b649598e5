"""Fixtures of the tests of skin."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.simulation.served_worlds import served
from tests.simulation.skin.skin_world import TWO_PATCHES, SkinWorld, table


@pytest.fixture
def skin_world(tmp_path: Path) -> SkinWorld:
    return SkinWorld(served(tmp_path, table().replace("      </patch>", TWO_PATCHES, 1)))
