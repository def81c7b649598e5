from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

from network import Network

MIDDLEWARES = ("inproc", "zenoh")


@pytest.fixture(params=MIDDLEWARES)
def network(request: pytest.FixtureRequest) -> Iterator[Network]:
    made = Network(request.param)
    yield made
    made.close()
