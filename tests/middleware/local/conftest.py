from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from robocomp_dsl.runtime.presence.stale_sockets import sweep_sockets
from tests.middleware.local.direct import Side
from tests.support.waiting import wait_until


@pytest.fixture
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a short path, as sockets need it."""
    return tmp_path_factory.mktemp("l")


@pytest.fixture
def side(folder: Path) -> Iterator[Callable[[str], Side]]:
    opened: list[Side] = []

    def open_side(name: str) -> Side:
        opened.append(Side(folder, name))
        return opened[-1]

    yield open_side
    for each in opened:
        each.transport.close()
    assert not [failure for each in opened for failure in each.failures]

    def is_empty() -> bool:
        sweep_sockets(folder)  # of processes that the test has killed
        return not list(folder.iterdir())

    wait_until(is_empty, lambda: str(list(folder.iterdir())))
